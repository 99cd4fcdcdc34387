"""docs/python/compare.py, with small images."""

import pathlib

import pytest

EXAMPLE = pathlib.Path(__file__).parents[2] / "docs" / "python" / "compare.py"


def test_the_example_prints_a_table_and_writes_its_figure(script, tmp_path):
    pytest.importorskip("matplotlib")
    text = EXAMPLE.read_text()
    for large, small in [
        ("width=192, height=108", "width=16, height=9, threads=1"),
        ("spp=512", "spp=8"),
        ("FRAMES, SEEDS = 32, (1, 2, 3)", "FRAMES, SEEDS = 2, (1, 2)"),
    ]:
        assert large in text
        text = text.replace(large, small)
    lines = script(text).splitlines()
    assert lines[0] == "door-ajar, 16x9, 2 seeds, reference 8 spp"
    assert len(lines) == 6 and all("nan" not in line for line in lines)
    assert (tmp_path / "compare.png").stat().st_size > 10000
