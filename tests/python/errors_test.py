"""Bad input: one clear line each, of restlab.Error."""

import pickle

import numpy as np
import pytest
import restlab

SMALL = dict(width=8, height=8, threads=1)
GREY = np.full((8, 8, 3), 0.5, np.float32)


def error(call, *arguments, **keywords):
    with pytest.raises(restlab.Error) as caught:
        call(*arguments, **keywords)
    line = str(caught.value)
    assert line and "\n" not in line
    return caught.value.exit_code, line


@pytest.mark.parametrize(
    "keywords, code, words",
    [
        (dict(integrator="restir_gy"), 2, ["restir_gy", "did you mean 'restir_gi'?"]),
        (dict(integrator="restir_gi", mode="unbised"), 2, ["unbised", "unbiased"]),
        (dict(widht=3), 2, ["'widht'", "did you mean 'width'?"]),
        (dict(confidence_cap=3), 2, ["'confidence_cap'", "no parameter of integrator path"]),
        (dict(width="wide"), 2, ["width", "an integer"]),
        (dict(width=2**70), 2, ["width", "64 bits"]),
        (dict(height=0), 2, ["height"]),
        (dict(threads=[1]), 2, ["threads", "list"]),
        (dict(max_bounces=-1), 2, ["max_bounces"]),
        (dict(camera="left"), 2, ["camera 'left'"]),
        (dict(camera=True), 2, ["camera", "bool"]),
        (dict(width=np.array([8, 8])), 2, ["width", "ndarray"]),
        (dict(environment="none.exr"), 3, ["none.exr", "not found"]),
        (dict(backend="gpu"), 2, ["backend 'gpu'", "cpu, vulkan"]),
        (dict(device="x"), 2, ["device 'x'"]),
        (dict(kernels="fast"), 2, ["kernels", "fast"]),
    ],
)
def test_settings(keywords, code, words):
    its, line = error(restlab.Session, "cornell-box", **{**SMALL, **keywords})
    assert its == code
    for word in words:
        assert word in line


def test_errors_of_a_script_have_a_code():
    assert restlab.Error("x").exit_code == 3
    with pytest.raises(restlab.Error) as caught:
        restlab.metric("none", GREY, GREY)
    assert pickle.loads(pickle.dumps(caught.value)).exit_code == 2


def test_scenes():
    assert "cornel-box" in error(restlab.Session, "cornel-box", **SMALL)[1]
    assert error(restlab.Session, "cornel-box", **SMALL)[0] == 3
    assert "scene" in error(restlab.Session, 3, **SMALL)[1]


def test_calls_of_a_session():
    session = restlab.Session("cornell-box", **SMALL)
    for call in (session.radiance, lambda: session.aov("depth"), lambda: session.probe(0, 0)):
        assert "no frame yet" in error(call)[1]
    session.frame()
    assert "'dept'" in error(session.aov, "dept")[1]
    assert "8x8" in error(session.probe, 8, 0)[1]
    assert "confidence_cap" in error(session.set_parameters, confidence_cap=1)[1]
    assert "1 to" in error(session.resize, 0, 8)[1]
    assert "target" in error(session.set_camera, target=(0, 1))[1]
    assert "up" in error(session.set_camera, direction=(0, 1, 0), up=(0, 2, 0))[1]
    assert "'fov'" in error(session.set_camera, fov=3)[1]
    assert "yfov" in error(session.set_camera, yfov=180)[1]
    with pytest.raises(TypeError):
        session.frames("three")
    session.frame()  # none of these has harmed it


@pytest.mark.parametrize(
    "image, words",
    [
        (GREY[:, :, 0], ["(8, 8)", "(height, width, 3)"]),
        ((GREY * 255).astype(np.uint8), ["uint8"]),
        (GREY.astype(np.complex64), ["complex64"]),
        (GREY[:0], ["(0, 8, 3)"]),
        (np.concatenate([GREY, GREY[:, :, :1]], 2), ["(8, 8, 4)"]),
        (GREY[:4], ["8x4", "8x8"]),
        ([[1.0]], ["list"]),
        (None, ["NoneType"]),
    ],
)
def test_arrays(image, words):
    code, line = error(restlab.metric, "mse", image, GREY)
    assert code == 2
    for word in words:
        assert word in line


def test_other_arguments():
    assert "did you mean 'mse'?" in error(restlab.metric, "mze", GREY, GREY)[1]
    assert "(8, 8) of bool" in error(restlab.metric, "mse", GREY, GREY, mask=GREY)[1]
    for part in (GREY[:, :4], GREY[:4]):
        line = error(restlab.metric, "mse", GREY, GREY, mask=part[..., 0] > 0)[1]
        assert "(8, 8) of bool" in line
    assert "two images" in error(restlab.metric, "bias_rms", GREY, GREY)[1]
    assert "half0 and half1" in error(restlab.Reference, GREY, GREY)[1]
    assert "one of spp" in error(restlab.reference, "furnace")[1]
    assert "a reference has none" in error(restlab.reference, "furnace", spp=2, mode="x")[1]
    assert "run.json" in error(restlab.load_results, "no-such-folder")[1]
    assert "runs 3" in error(restlab.bias, "furnace", runs=3)[1]
    assert error(restlab.read_exr, "no-such.exr")[0] == 3
    assert "verbosity" in error(restlab.set_verbosity, 5)[1]
