"""Sessions: the same bits as the program, and arrays that stay."""

import fractions
import gc

import numpy as np
import pytest
import restlab

SMALL = dict(width=24, height=16, threads=1)


def bits(array):
    return np.ascontiguousarray(array).view(np.uint32)


def test_frames_have_the_bits_of_render(program, tmp_path):
    program(
        "render", "door-ajar", "-o", "x.exr", "--integrator", "restir_gi", "--frames", 3, "--seed", 7,
        "--width", 24, "--height", 16, "--set", "spatial_radius=4", "--aov", "normalW,age",
        "--no-multiscatter", "--denoiser", "accumulate",
    )  # fmt: skip
    layers = restlab.read_exr(tmp_path / "x.exr")
    session = restlab.Session(
        "door-ajar", integrator="restir_gi", seed=7, spatial_radius=4, denoiser="accumulate",
        multiscatter=False, **SMALL,
    )  # fmt: skip
    session.frames(2)
    assert not np.array_equal(bits(session.radiance()), bits(layers[""]))
    session.frame()
    assert np.array_equal(bits(session.radiance()), bits(layers[""]))
    assert np.array_equal(bits(session.aov("normalW")), bits(layers["normalW"]))
    assert np.array_equal(bits(session.aov("age")), bits(layers["age"]))
    assert session.frame_count == 3


def test_an_array_is_no_copy_and_stays(tmp_path):
    session = restlab.Session("cornell-box", **SMALL)
    session.frame()
    first = session.radiance()
    assert first.dtype == np.float32 and first.shape == (16, 24, 3)
    assert np.shares_memory(first, session.radiance())
    assert first.base is not None and not first.flags.writeable
    with pytest.raises(ValueError):
        first[0, 0] = 0.0
    copy = first.copy()
    session.frame()
    second = session.radiance()
    assert np.array_equal(first, copy) and not np.array_equal(first, second)
    # A history of one array needs no second image.
    place = second.ctypes.data
    del first, second
    gc.collect()
    session.frame()
    third = session.radiance()
    assert third.ctypes.data == place
    copy = third.copy()
    session.resize(8, 8)
    session.frame()
    fourth = session.radiance()
    kept = fourth.copy()
    del session
    gc.collect()
    assert np.array_equal(third, copy) and np.array_equal(fourth, kept)
    assert fourth.shape == (8, 8, 3)


def test_reset_and_parameters_begin_histories():
    session = restlab.Session("cornell-box", integrator="restir_gi", **SMALL)
    session.frames(2)
    image = session.radiance()
    session.reset(5)
    assert session.frame_count == 0 and session.settings["seed"] == 5
    session.frames(2)
    assert not np.array_equal(image, session.radiance())
    session.reset(1)
    session.frames(2)
    assert np.array_equal(image, session.radiance())
    assert session.parameters["confidence_cap"] == session.parameters["confidence_cap"]
    assert not session.set_parameters(spatial_radius=np.float32(3.0))
    assert session.parameters["spatial_radius"] == 3.0
    session.reset()
    session.frames(2)
    other = restlab.Session("cornell-box", integrator="restir_gi", spatial_radius=3.0, **SMALL)
    other.frames(2)
    assert np.array_equal(other.radiance(), session.radiance())


def test_cameras_are_kept_and_set():
    session = restlab.Session("cornell-box", **SMALL)
    own = session.camera
    session.frame()
    image = session.radiance()
    session.set_camera(position=(0.0, 1.0, 3.0), target=(0.0, 1.0, 0.0), yfov=50)
    assert session.camera["position"] == (0.0, 1.0, 3.0)
    assert session.camera["direction"] == pytest.approx((0.0, 0.0, -1.0))
    assert session.camera["yfov"] == pytest.approx(50.0)
    session.reset()
    session.frame()
    moved = session.radiance()
    assert not np.array_equal(image, moved)
    session.resize(24, 16)  # keeps the camera
    session.frame()
    assert np.array_equal(moved, session.radiance())
    session.set_camera(session.cameras[0])
    assert session.camera == own
    session.reset()
    session.frame()
    assert np.array_equal(image, session.radiance())


def test_probe_times_and_health():
    session = restlab.Session("door-ajar", integrator="restir_gi", **SMALL)
    stats = session.frames(3)[-1]
    assert stats.time_ms == pytest.approx(sum(p["time_ms"] for p in stats.passes if not p["once"]))
    assert stats.rays_path == sum(p["rays_path"] for p in stats.passes) > 0
    assert stats.health["nonfinite"] == session.health["nonfinite"] == 0
    assert session.time_ms >= stats.time_ms > 0.0
    probe = session.probe(10, 5)
    shown = session.radiance()[5, 10]
    assert probe["values"][0]["value"] == pytest.approx(shown.tolist(), rel=1e-5)
    assert {layer["name"] for layer in session.layers} <= set(session.aov_names)


def test_files_are_those_of_the_program(program, tmp_path):
    session = restlab.Session("cornell-box", **SMALL)
    session.frame()
    file = tmp_path / "own.exr"
    depth = session.aov("depth")
    restlab.write_exr(file, session.radiance(), layers={"depth": depth}, metadata=session.metadata)
    read = restlab.read_exr(file)
    assert np.array_equal(read[""], session.radiance()) and np.array_equal(read["depth"], depth)
    program("render", "cornell-box", "-o", "its.exr", "--width", 24, "--height", 16)
    its, own = restlab.read_metadata(tmp_path / "its.exr"), restlab.read_metadata(file)
    for word in ("scene", "scene_hash", "camera", "camera_to_world", "seed", "integrator", "width"):
        assert its[word] == own[word]


def test_metadata_are_of_the_image_that_is_shown():
    session = restlab.Session("cornell-box", integrator="restir_gi", **SMALL)
    session.frame()
    shown = session.metadata
    assert not session.set_parameters(confidence_cap=3)
    session.set_camera(position=(0.0, 1.0, 3.0))
    present = session.metadata
    for words in (present, shown):
        words.pop("peak_resident_mib")  # of the process
    assert present == shown
    session.frame()
    later = session.metadata
    assert later["parameter.confidence_cap"] == "3" != shown["parameter.confidence_cap"]
    assert later["camera_to_world"] != shown["camera_to_world"]
    assert (shown["frame"], later["frame"]) == ("0", "1")
    traced = restlab.Session("cornell-box", **SMALL)
    traced.reset(first_frame=5)
    traced.frames(2)
    assert traced.metadata["frame"] == "6"


def test_numbers_of_any_kind_are_numbers(tmp_path):
    size = dict(width=np.int64(8), height=np.array(8), threads=np.uint8(1))
    camera = dict(camera=np.int64(0), max_bounces=np.int16(3))
    session = restlab.Session(
        "cornell-box", integrator="restir_gi", spatial_radius=fractions.Fraction(7, 2), **camera, **size
    )
    assert session.parameters["spatial_radius"] == 3.5
    assert session.settings["max_bounces"] == 3
    session.set_camera(np.uint8(0), position=np.array([0, 1, 3]), yfov=np.float32(50.0))
    session.reset(np.uint32(7))
    assert session.settings["seed"] == 7
    assert len(session.frames(np.int8(2))) == 2
    assert session.probe(np.int64(3), np.int32(2))["x"] == 3
    session.resize(np.int64(4), np.uint16(5))
    reference = session.reference(spp=np.int64(4), target_relmse=np.float32(1.0), anew=np.bool_(True))
    assert reference.mean.shape == (5, 4, 3)
    one = reference.mean
    assert restlab.metric("flip_hdr", one, one, pixels_per_degree=np.float32(60.0)) == 0.0
    restlab.write_png(tmp_path / "x.png", one, exposure=np.int64(1))


def test_memory_stays_over_10000_frames():
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    session = restlab.Session("furnace", width=4, height=4, threads=1)

    def render(frames):
        for _ in range(frames):
            session.frame()
            session.radiance()
            session.aov("depth")

    render(1000)
    before = resident()
    render(10000)
    assert resident() - before < 1 << 20
