"""Code of the documents, with small images."""

import pathlib
import re

import pytest

DOCUMENTS = pathlib.Path(__file__).parents[2] / "docs"


def smaller(text):
    """The code with small images and a noisy reference."""
    for large, small in [
        ("width=192, height=108", "width=16, height=9, threads=1"),
        ("spp=512", "spp=8"),
    ]:
        assert large in text
        text = text.replace(large, small)
    return text


def test_the_page_has_code_that_runs(script):
    blocks = re.findall("```python\n(.*?)```", (DOCUMENTS / "python.md").read_text(), re.DOTALL)
    lines = script(smaller("".join(blocks))).splitlines()
    assert len(lines) == 2 and all(line.startswith("{'mse': ") for line in lines)


def test_the_example_prints_a_table_and_writes_its_figure(script, tmp_path):
    pytest.importorskip("matplotlib")
    text = smaller((DOCUMENTS / "python" / "compare.py").read_text())
    lines = script(text.replace("SEEDS = 32, (1, 2, 3)", "SEEDS = 2, (1, 2)")).splitlines()
    assert lines[0] == "door-ajar, 16x9, 2 seeds, reference 8 spp"
    assert len(lines) == 6 and all("nan" not in line for line in lines)
    assert (tmp_path / "compare.png").stat().st_size > 10000
