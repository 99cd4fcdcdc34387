#!/usr/bin/env python3
"""Compares the bits of renders with those that were taken before a change.

    tests/net/net.py [--program build/release/restlab] [--take]

net.toml is rendered on the CPU; for a few of its scenes the general kernels and Vulkan are asked, too. hashes.txt
has one line an image: the hash of its pixels and its name. --take writes the file; without it, whatever differs is
named and the exit code is 1. Scenes that are not there are left out, with a line. Images of Vulkan may differ where a
compiler orders sums anew: they are named, and count for nothing.
"""
import argparse
import hashlib
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
HASHES = HERE / "hashes.txt"
OTHERS = {"dining-room": "rooms/dining-room/dining-room.gltf", "living-room": "rooms/living-room/living-room.gltf"}
BUILT_IN = ["cornell-box", "door-ajar", "many-lights", "glossy-gallery", "glass", "courtyard"]
GENERAL = [("path", []), ("restir_gi", ["--cache", "voxel"]), ("restir_gi", ["--mode", "biased", "--denoiser", "svgf_restir"])]


def pixels(path):
    """The chunks of an EXR of scan lines, uncompressed, without its header: two files of other metadata are equal."""
    data = path.read_bytes()
    at = 8
    header = {}
    while data[at]:
        end = data.index(b"\0", at)
        name = data[at:end].decode()
        at = data.index(b"\0", end + 1) + 1
        size = struct.unpack_from("<i", data, at)[0]
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    at += 1
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    lines = {0: 1, 2: 1, 3: 16}[header["compression"][0]]
    blocks = -(-(bottom - top + 1) // lines)
    parts = [header["channels"], header["dataWindow"]]
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        size = struct.unpack_from("<i", data, offset + 4)[0]
        raw = data[offset + 8:offset + 8 + size]
        try:
            raw = zlib.decompress(raw)
        except zlib.error:
            pass  # such a block was not worth compressing
        parts.append(raw)
    return b"".join(parts)


def run(program, arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{program} {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")


def render_suite(program, folder, scenes, prefix, further):
    out = folder / prefix
    run(program, ["run", HERE / "net.toml", "-o", out, "-q", "--scenes", ",".join(scenes), *further])
    return {f"{prefix}/{image.stem}": image for image in (out / "images").glob("*.exr") if "reference" not in image.stem}


def render_general(program, folder, scenes):
    images = {}
    for scene in scenes:
        for i, (integrator, further) in enumerate(GENERAL):
            image = folder / f"{scene}-{i}.exr"
            run(program, ["render", scene, "-o", image, "--resolution", "40x24", "--frames", "6", "--general", "-q",
                          "--integrator", integrator, *further])
            images[f"general/{image.stem}"] = image
    return images


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=HERE.parent.parent / "build/release/restlab")
    parser.add_argument("--take", action="store_true")
    options = parser.parse_args()
    known = subprocess.run([options.program, "list", "scenes"], capture_output=True, text=True, check=True).stdout
    scenes = BUILT_IN + [name for name, path in OTHERS.items() if path in known]
    for name in set(BUILT_IN + list(OTHERS)) - set(scenes):
        print(f"net: no scene {name} here (RESTLAB_SCENES): left out")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        images = render_suite(options.program, folder, scenes, "cpu", ["-j", "2"])
        images |= render_general(options.program, folder, ["cornell-box", "glass", "courtyard"])
        images |= render_suite(options.program, folder, ["cornell-box", "glass"], "vulkan", ["--set", "backend=vulkan"])
        now = {name: hashlib.sha256(pixels(image)).hexdigest()[:16] for name, image in images.items()}
    if options.take:
        HASHES.write_text("".join(f"{now[name]} {name}\n" for name in sorted(now)))
        print(f"net: {len(now)} images taken")
        return 0
    before = {line.split(" ", 1)[1]: line.split(" ", 1)[0] for line in HASHES.read_text().splitlines()}
    missing = [name for name in before if name not in now and any(scene in name for scene in scenes)]
    other = [name for name in now if before.get(name) != now[name]]
    for name in missing:
        print(f"net: {name} is gone")
    for name in sorted(other):
        print(f"net: {name} {'is another image' if name in before else 'is new'}")
    red = missing + [name for name in other if not name.startswith("vulkan/")]
    print(f"net: {len(now) - len(other)} of {len(now)} images have the bits of before")
    return 1 if red else 0


if __name__ == "__main__":
    sys.exit(main())
