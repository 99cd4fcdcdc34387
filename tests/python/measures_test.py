"""Metrics, references, results and certificates: the numbers of the program."""

import csv
import json
import math

import numpy as np
import pytest
import restlab

SIZE = ["--width", 24, "--height", 16]
SMALL = dict(width=24, height=16, threads=1)


def same(a, b):
    return a == b or (math.isnan(a) and math.isnan(b))


def number(value):
    return float(value)


def test_metrics_are_those_of_compare(program, tmp_path):
    program("render", "cornell-box", "-o", "a.exr", "--seed", 3, *SIZE)
    program("render", "cornell-box", "-o", "b.exr", "--seed", 4, *SIZE)
    program("reference", "cornell-box", "-o", "ref.exr", "--spp", 8, *SIZE)
    compared = json.loads(
        program("compare", "--ref", "ref.exr", "a.exr", "b.exr", "--metrics",
                ",".join(restlab.metric_names()), "--json")
    )  # fmt: skip
    reference = restlab.read_reference(tmp_path / "ref.exr")
    images = [restlab.read_exr(tmp_path / name)[""] for name in ("a.exr", "b.exr")]
    for image, its in zip(images, compared["images"]):
        own = restlab.metrics(image, reference, "all")
        assert len(own) == len(restlab.metric_names()) - 1
        for name, value in own.items():
            assert same(value, number(its["metrics"][name])), name
    usual = restlab.metrics(images[0], reference)
    assert list(usual) == ["mse", "relmse_e1e-2", "mape_e1e-2", "energy_ratio"]
    assert usual["mse"] != restlab.metric("mse", images[0], reference.mean)  # without the halves
    bias = restlab.metric("bias_rms", images, reference)
    assert same(bias, number(compared["runs"]["metrics"]["bias_rms"]))
    # A mask chooses pixels; float64 and other orders of memory are the same image.
    mask = np.zeros((16, 24), bool)
    mask[:8] = True
    half = restlab.metric("mse", images[0], reference, mask=mask)
    halves = [restlab.metric("mse", images[0], reference, mask=m) for m in (mask, ~mask)]
    assert half == halves[0] and sum(halves) / 2 == pytest.approx(usual["mse"])
    turned = np.asfortranarray(images[0].astype(np.float64))
    assert restlab.metric("mse", turned, reference) == usual["mse"]


def test_a_filter_of_numpy_is_measured(tmp_path):
    """A box filter of 3x3 pixels after the path tracer lowers the error."""
    session = restlab.Session("cornell-box", **SMALL)
    reference = session.reference(spp=64)
    session.frame()
    noisy = session.radiance()
    padded = np.pad(noisy, ((1, 1), (1, 1), (0, 0)), mode="edge")
    filtered = sum(padded[y : y + 16, x : x + 24] for y in range(3) for x in range(3)) / 9
    assert restlab.metric("mse", filtered, reference) < restlab.metric("mse", noisy, reference)


def test_a_reference_is_that_of_the_program(program, tmp_path):
    program("reference", "cornell-box", "-o", "its.exr", "--spp", 6, "--seed", 9, "--anew", *SIZE)
    its = restlab.read_reference(tmp_path / "its.exr")
    own = restlab.reference("cornell-box", spp=6, seed=9, anew=True, file=tmp_path / "own.exr", **SMALL)
    again = restlab.Session("cornell-box", seed=9, **SMALL).reference(spp=6, anew=True)
    for other in (own, again, restlab.read_reference(tmp_path / "own.exr")):
        assert other.spp == its.spp == 6
        for name in ("mean", "half0", "half1", "variance"):
            assert np.array_equal(getattr(other, name), getattr(its, name)), name
    assert own.metadata["reference_key"] == its.metadata["reference_key"]
    moved = restlab.Session("cornell-box", seed=9, **SMALL)
    moved.set_camera(position=(0.0, 1.0, 2.0))
    assert not np.array_equal(moved.reference(spp=6, anew=True).mean, its.mean)


SUITE = """
name = "small"
scenes = ["cornell-box"]
[settings]
width = 12
height = 8
warmup_frames = 1
frames = 1
runs = 2
[reference]
spp = 8
[[method]]
name = "path, traced"
integrator = "path"
[[method]]
name = "gi"
integrator = "restir_gi"
"""


def test_results_are_those_of_the_summary(program, tmp_path):
    (tmp_path / "small.toml").write_text(SUITE)
    program("run", "small.toml", "-o", "out", "--threads", 1)
    rows = restlab.load_results(tmp_path / "out", as_dicts=True)
    with open(tmp_path / "out" / "summary.csv", newline="") as file:
        table = list(csv.DictReader(file))
    assert [row["method"] for row in rows] == ["path, traced", "gi"]
    assert [list(row) for row in rows] == [list(row) for row in table]
    for row, its in zip(rows, table):
        for name, value in row.items():
            if isinstance(value, float):
                assert same(float(f"{value:.9g}"), float(its[name])), name
            else:
                assert str(value) == its[name], name
    pandas = pytest.importorskip("pandas")
    frame = restlab.load_results(tmp_path / "out")
    assert isinstance(frame, pandas.DataFrame)
    assert frame["mse"].tolist() == [row["mse"] for row in rows]


def test_a_certificate_is_that_of_the_program(program, tmp_path):
    size = ["--width", 8, "--height", 8, "--threads", 1]
    its = json.loads(
        program("bias", "furnace", "--runs", 32, "--frames", 2, "-j", 1, "-o", "its", "--json",
                *size)
    )  # fmt: skip
    own = restlab.bias(
        "furnace", runs=32, frames=2, jobs=1, out=tmp_path / "own", width=8, height=8, threads=1
    )
    assert own["verdict"] == its["verdict"]
    assert json.dumps(own["image"]) == json.dumps(its["image"])
    assert (tmp_path / "own" / "report.html").exists()
