#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets that are made by rule: tests/fuzz/seeds/TARGET/NAME.

Names that begin with 'read' are of files that are read; all others are refused. Files named
found-* came out of fuzzing and are not made here.
"""

import base64
import json
import pathlib
import struct
import zlib

from compressed_streams import (CORNERS, DRACO_GRID, MESHOPT_GRID, draco_triangle, meshopt_attributes,
                                meshopt_indices, varint)

SEEDS = pathlib.Path(__file__).parent / "seeds"


def write(target, name, data):
    folder = SEEDS / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())


# ---- PNG, JPEG ------------------------------------------------------------------------------------


def png_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, depth, colour, raw, interlaced=0, extra=b""):
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlaced)
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", head) + extra
            + png_chunk(b"IDAT", zlib.compress(raw, 9)) + png_chunk(b"IEND", b""))


def jpeg_segment(marker, data):
    return bytes([0xFF, marker]) + struct.pack(">H", len(data) + 2) + data


def jpeg(width, height, scan, progressive=False):
    """One grey component; a Huffman table whose only DC code '0' is category 0 and whose only AC
    code '0' is the end of the block: a block of zero bits is flat grey."""
    one_code = bytes([1] + [0] * 15 + [0])
    frame = struct.pack(">BHHB", 8, height, width, 1) + bytes([1, 0x11, 0])
    spectral = bytes([0, 0, 0]) if progressive else bytes([0, 63, 0])
    return (b"\xff\xd8" + jpeg_segment(0xDB, bytes([0]) + bytes([1] * 64))
            + jpeg_segment(0xC2 if progressive else 0xC0, frame)
            + jpeg_segment(0xC4, bytes([0x00]) + one_code) + jpeg_segment(0xC4, bytes([0x10]) + one_code)
            + jpeg_segment(0xDA, bytes([1, 1, 0x00]) + spectral) + scan + b"\xff\xd9")


PNG_RGBA = png(2, 1, 8, 6, b"\0" + bytes([255, 0, 0, 255, 0, 255, 0, 128]))


def commands():
    camera = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1]
    write("command", "read-set", json.dumps({"do": "set", "pane": 0, "key": "mode", "value": "biased"}))
    write("command", "read-parameter", json.dumps({"do": "parameter", "pane": 1, "name": "x", "value": 0.5}))
    write("command", "read-camera", json.dumps({"do": "camera", "to_world": camera, "yfov": 0.7}))
    write("command", "read-resolution", json.dumps({"do": "resolution", "width": 640, "height": 360}))
    write("command", "unknown", json.dumps({"do": "open", "file": "/etc/passwd"}))
    write("command", "scaled-camera", json.dumps({"do": "camera", "to_world": [2] + camera[1:]}))
    write("command", "deep", "[" * 2000)
    write("command", "bytes", bytes(range(256)))


def textures():
    write("texture", "read-rgba.png", PNG_RGBA)
    write("texture", "read-rgb-filters.png",
          png(3, 5, 8, 2, b"".join(bytes([f]) + bytes(range(f, f + 9)) for f in range(5))))
    write("texture", "read-grey-16.png", png(2, 2, 16, 0, b"\0\1\2\3\4\1\5\6\7\10"))
    write("texture", "read-grey-alpha.png", png(1, 2, 8, 4, b"\0\1\2\0\3\4"))
    palette = png_chunk(b"PLTE", bytes(range(12))) + png_chunk(b"tRNS", b"\0\x80")
    write("texture", "read-palette-2-bit.png", png(5, 1, 2, 3, b"\0\x1b\xc0", extra=palette))
    write("texture", "read-interlaced.png", png(2, 2, 8, 0, b"\0\1\0\2\0\3\4", interlaced=1))
    write("texture", "read-grey.jpg", jpeg(8, 8, b"\x3f"))
    write("texture", "read-grey-16x8.jpg", jpeg(16, 8, b"\x0f"))
    write("texture", "read-progressive.jpg", jpeg(8, 8, b"\x7f", progressive=True))
    write("texture", "truncated.png", PNG_RGBA[:50])
    write("texture", "huge.png", png(100000, 100000, 8, 6, b"\0" * 100))
    write("texture", "lying.png", png(16384, 16384, 8, 6, b"\0" * 100))
    write("texture", "read-bomb.png", png(1, 1, 8, 0, b"\0" * 16000000))
    write("texture", "huge.jpg", jpeg(65500, 65500, b"\x3f"))
    write("texture", "lying.jpg", jpeg(16384, 16384, b"\x3f"))
    write("texture", "no-scan.jpg", jpeg(8, 8, b"")[:40])


# ---- scene files ----------------------------------------------------------------------------------


def scene_files():
    base = 'base = "cornell-box"\n'
    clay = base + '[[material]]\nname = "clay"\nkind = "oren_nayar"\ncolor = [0.7, 0.4, 0.2]\n'
    write("scene_file", "read-base.toml", base)
    write("scene_file", "read-kinds.toml", clay + "".join(
        f'[[material]]\nname = "{kind}"\nkind = "{kind}"\n'
        for kind in ("mirror", "power_lobe", "phong", "conductor", "disney", "plastic", "wax", "dielectric"))
        + '[[material]]\nname = "m"\nkind = "mixture"\nfirst = "clay"\nsecond = "mirror"\n'
        + '[[assign]]\nmaterial = "White"\nto = "m"\n[[assign]]\nmesh = "*Block"\nto = "wax"\n')
    write("scene_file", "read-lights.toml", base
          + '[[light]]\nkind = "ambient"\nradiance = 0.1\n[[light]]\nattenuation = [1.0, 0.5, 0.25]\n'
          + '[[light]]\nkind = "spot"\ndirection = [0.0, -1.0, 0.0]\n[camera]\nposition = [0.0, 1.0, 5.0]\n'
          + '[environment]\nradiance = 0.5\n[background]\nradiance = 0.0\n')
    write("scene_file", "read-settings.toml", clay + "[camera]\nyfov = 30.0\n\0material.clay.sigma=0.2&camera.yfov=60")
    write("scene_file", "unknown-setting.toml", clay + "\0material.clay.sgma=0.2")
    write("scene_file", "setting-of-nothing.toml", clay + "\0&=&..")
    write("scene_file", "itself.toml", 'base = "x.scene.toml"\n')
    write("scene_file", "folder.toml", 'base = "."\n')
    write("scene_file", "control.toml", 'base = "a\\u0000b\\nc"\n')
    write("scene_file", "endless-numbers.toml", clay + "sigma = nan\n")
    write("scene_file", "part-of-itself.toml",
          base + '[[material]]\nname = "m"\nkind = "mixture"\nfirst = "m"\nsecond = "m"\n')
    write("scene_file", "table-of-a-device.toml",
          base + '[[material]]\nname = "m"\nkind = "table"\nfile = "/dev/null"\n')
    write("scene_file", "bytes.toml", bytes(range(1, 256)))


# ---- Radiance HDR ---------------------------------------------------------------------------------


def hdr(width, height, pixels, first=b"#?RADIANCE\n"):
    return first + b"FORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + pixels


def hdr_row(width, runs):
    return struct.pack(">BBH", 2, 2, width) + runs


def environments():
    write("hdr", "read-flat.hdr", hdr(2, 1, bytes([128, 64, 0, 129, 0, 0, 0, 0])))
    row = hdr_row(8, (b"\x88\x40") * 4)
    write("hdr", "read-runs.hdr", hdr(8, 2, row + row))
    row = hdr_row(8, b"\x08abcdefgh" * 3 + b"\x04\x80\x80\x81\x81\x84\x7f")
    write("hdr", "read-literals.hdr", hdr(8, 1, row, b"#?RGBE\nEXPOSURE=1\n"))
    write("hdr", "short.hdr", hdr(8, 2, hdr_row(8, b"\x88\x40")))
    write("hdr", "overrun.hdr", hdr(8, 1, hdr_row(8, b"\xff\x40" * 4)))
    write("hdr", "huge.hdr", hdr(100000, 100000, b"\0" * 64))
    write("hdr", "lying.hdr", hdr(16384, 16384, b"\0" * 64))
    write("hdr", "negative.hdr", hdr(-8, 2, b"\0" * 64))
    write("hdr", "no-format.hdr", b"#?RADIANCE\n\n-Y 1 +X 1\n\0\0\0\0")
    write("hdr", "no-size.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n")
    pixel, marks = bytes([128, 64, 0, 129]), b"\1\1\1\x2b\1\1\1\1"
    write("hdr", "read-old-runs.hdr", hdr(300, 1, pixel + marks))
    write("hdr", "old-overrun.hdr", hdr(299, 1, pixel + marks))
    write("hdr", "old-endless.hdr", hdr(300, 1, pixel + b"\1\1\1\0" * 8 + b"\1\1\1\1"))
    write("hdr", "old-first.hdr", hdr(300, 1, marks + pixel))
    form = b"FORMAT=32-bit_rle_rgbe\n\n"
    write("hdr", "read-columns.hdr", b"#?RADIANCE\n" + form + b"+X 2 +Y 3\n" + pixel * 6)
    write("hdr", "read-exposed.hdr", b"#?RADIANCE\nEXPOSURE=2\nCOLORCORR=1 2 .5\nEXPOSURE= 3\n"
          + form + b"-Y 1 +X 1\n" + pixel)
    write("hdr", "read-primaries.hdr", b"#?RADIANCE\nPRIMARIES=.708 .292 .17 .797 .131 .046 .3127 .329\n"
          + form + b"-Y 1 -X 1\n" + pixel)
    write("hdr", "read-xyze.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + pixel)
    write("hdr", "exposed-by-zero.hdr", b"#?RADIANCE\nEXPOSURE=0\n" + form + b"-Y 1 +X 1\n" + pixel)
    write("hdr", "primaries-in-a-line.hdr", b"#?RADIANCE\nPRIMARIES=.1 .1 .2 .2 .3 .3 .3 .3\n"
          + form + b"-Y 1 +X 1\n" + pixel)


# ---- EXR ------------------------------------------------------------------------------------------


def attribute(name, kind, data):
    return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data


def channels(names, kind):
    rows = b"".join(n + b"\0" + struct.pack("<iB3xii", kind, 0, 1, 1) for n in names)
    return attribute(b"channels", b"chlist", rows + b"\0")


def exr(names=(b"B", b"G", b"R"), kind=2, window=(0, 0, 1, 1), compression=0, tile=None, chunks=None,
        extra=b"", version=2):
    """kind: 0 uint, 1 half, 2 float; one chunk a row, or one a tile."""
    x0, y0, x1, y1 = window
    box = struct.pack("<4i", *window)
    head = struct.pack("<II", 20000630, version | (0x200 if tile else 0))
    head += channels(names, kind) + attribute(b"compression", b"compression", bytes([compression]))
    head += attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
    head += attribute(b"lineOrder", b"lineOrder", b"\0")
    head += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    head += attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
    if tile:
        head += attribute(b"tiles", b"tiledesc", struct.pack("<IIB", tile[0], tile[1], 0))
    head += extra + b"\0"
    if chunks is None:
        size = {0: 4, 1: 2, 2: 4}[kind]
        value = {0: struct.pack("<I", 1), 1: struct.pack("<e", 1), 2: struct.pack("<f", 1)}[kind]
        width, height = x1 - x0 + 1, y1 - y0 + 1
        if tile:
            data = value * (width * height * len(names))
            chunks = [struct.pack("<5i", 0, 0, 0, 0, len(data)) + data]
        else:
            data = value * (width * len(names))
            rows = 16 if compression == 3 else 1
            chunks = []
            for y in range(y0, y1 + 1, rows):
                block = data * min(rows, y1 + 1 - y)
                chunks.append(struct.pack("<ii", y, len(block)) + block)
        assert len(data) == size * width * len(names) * (height if tile else 1)
    table, at = b"", len(head) + 8 * len(chunks)
    for chunk in chunks:
        table += struct.pack("<Q", at)
        at += len(chunk)
    return head + table + b"".join(chunks)


def zip_rows(data):
    """What EXR's ZIP makes of a block: bytes in two halves, differences, deflate."""
    halves = data[0::2] + data[1::2]
    delta = bytes([halves[0]]) + bytes((halves[i] - halves[i - 1] + 128) & 255 for i in range(1, len(halves)))
    return zlib.compress(delta)


def images():
    write("exr", "read-float.exr", exr())
    write("exr", "read-half.exr", exr(kind=1))
    write("exr", "read-grey.exr", exr(names=(b"Y",), kind=1))
    write("exr", "read-layers.exr", exr(names=(b"B", b"G", b"R", b"half0.B", b"half0.G", b"half0.R"), kind=1))
    write("exr", "read-offset.exr", exr(window=(-3, 5, -1, 6)))
    write("exr", "read-tile.exr", exr(tile=(8, 8)))
    block = zip_rows(struct.pack("<f", 1) * 48)
    write("exr", "read-zip.exr", exr(window=(0, 0, 7, 1), compression=3,
                                     chunks=[struct.pack("<ii", 0, len(block)) + block]))
    write("exr", "read-text.exr", exr(extra=attribute(b"restlab:scene", b"string", b"room")))
    colours = lambda *xy: attribute(b"chromaticities", b"chromaticities", struct.pack("<8f", *xy))
    write("exr", "read-xyz.exr", exr(extra=colours(1, 0, 0, 1, 0, 0, 1 / 3, 1 / 3)))
    write("exr", "colours-in-a-line.exr", exr(extra=colours(.1, .1, .2, .2, .3, .3, .3, .3)))
    write("exr", "no-colours.exr", exr(extra=colours(*[float("nan")] * 8)))
    write("exr", "read-cube.exr", exr(window=(0, 0, 0, 5), extra=attribute(b"envmap", b"envmap", b"\1")))
    write("exr", "read-no-cube.exr", exr(window=(0, 0, 1, 5), extra=attribute(b"envmap", b"envmap", b"\1")))
    write("exr", "integers.exr", exr(kind=0))
    write("exr", "one-channel.exr", exr(names=(b"R",)))
    write("exr", "lying.exr", exr(window=(0, 0, 16383, 16383), chunks=[b"\0" * 32]))
    write("exr", "huge.exr", exr(window=(0, 0, 99999, 99999), chunks=[b"\0" * 32]))
    write("exr", "negative.exr", exr(window=(5, 5, 1, 1), chunks=[b"\0" * 32]))
    write("exr", "overflow.exr", exr(window=(-2**31, -2**31, 2**31 - 1, 2**31 - 1), chunks=[b"\0" * 32]))
    write("exr", "tiles.exr", exr(tile=(1, 1), window=(0, 0, 16383, 8191), chunks=[b"\0" * 32]))
    write("exr", "deep.exr", exr(version=2 | 0x800))
    write("exr", "parts.exr", exr(version=2 | 0x1000))
    write("exr", "long-attribute.exr", exr(extra=b"note\0string\0" + struct.pack("<I", 0x7FFFFFF0)))
    write("exr", "lying-preview.exr", exr(extra=attribute(b"preview", b"preview", struct.pack("<II", 65535, 65535))))
    write("exr", "lying-strings.exr", exr(extra=attribute(b"multiView", b"stringvector", struct.pack("<i", 2**31 - 1))))
    big = b"note\0string\0" + struct.pack("<I", 0x7FFFFFF0)
    write("exr", "hidden-size.exr", exr(extra=attribute(b"gain", b"float", b"1234" + big)))
    hidden = attribute(b"more", b"chlist", channels((b"R",), 1)[len(b"channels\0chlist\0") + 4:-1])
    write("exr", "hidden-channels.exr", exr(extra=hidden + b"\0" + big))
    many = tuple(sorted(b"x%04d.R" % i for i in range(300)))
    write("exr", "many-channels.exr", exr(names=many, window=(0, 0, 0, 0)))


# ---- glTF -----------------------------------------------------------------------------------------


def uri(data, kind="application/octet-stream"):
    return f"data:{kind};base64," + base64.b64encode(data).decode()


def triangle(**more):
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": uri(CORNERS)}],
    }
    document.update(more)
    return document


def glb(document, binary):
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I", len(text)) + b"JSON" + text
    body += struct.pack("<I", len(binary)) + b"BIN\0" + binary
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


# ---- Compressed geometry --------------------------------------------------------------------------


def numbered(*numbers):
    return b"".join(struct.pack("<H", number) for number in numbers)


def compressed():
    corners = [CORNERS[i:i + 12] for i in (0, 12, 24)]
    write("draco", "read-sequential", numbered(1, 3, 0) + draco_triangle())
    write("draco", "read-edgebreaker", numbered(32, 25, 3) + DRACO_GRID)
    write("draco", "other-count", numbered(1, 4, 0) + draco_triangle())
    write("draco", "no-normals", numbered(1, 3, 1) + draco_triangle())
    write("draco", "point-cloud", numbered(1, 3, 0) + draco_triangle(kind=0))
    write("draco", "old", numbered(1, 3, 0) + draco_triangle(version=b"\x01\x01"))
    write("draco", "lying-points", numbered(1, 65535, 0) + draco_triangle(points=65535))
    write("draco", "lying-triangles", numbered(65535, 25, 3)
          + DRACO_GRID[:13] + varint(65535) + DRACO_GRID[14:])
    write("draco", "short", numbered(32, 25, 3) + DRACO_GRID[:60])
    write("meshopt", "read-attributes", numbered(0, 3, 12) + meshopt_attributes(corners))
    write("meshopt", "read-triangles", numbered(1, 96, 2) + MESHOPT_GRID)
    write("meshopt", "read-indices", numbered(2, 3, 4) + meshopt_indices([0, 1, 2]))
    write("meshopt", "read-octahedral", numbered(0x100, 3, 4)
          + meshopt_attributes([bytes([0, 0, 127, 0]), bytes([127, 0, 127, 0]), bytes([0, 129, 127, 0])]))
    write("meshopt", "read-quaternion", numbered(0x200, 2, 8) + meshopt_attributes([bytes(8), bytes(range(8))]))
    write("meshopt", "read-exponential", numbered(0x300, 3, 12) + meshopt_attributes(corners))
    write("meshopt", "filtered-indices", numbered(0x102, 3, 4) + meshopt_indices([0, 1, 2]))
    write("meshopt", "huge-count", numbered(0, 65535, 256) + meshopt_attributes(corners))
    write("meshopt", "short", numbered(0, 3, 12) + meshopt_attributes(corners)[:40])
    write("meshopt", "another-mode", numbered(1, 3, 4) + meshopt_indices([0, 1, 2]))


def compressed_scenes(compact):
    stream = draco_triangle()
    extension = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
    more = dict(
        extensionsUsed=["KHR_draco_mesh_compression"], extensionsRequired=["KHR_draco_mesh_compression"],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions": extension}]}],
        bufferViews=[{"buffer": 0, "byteLength": len(stream)}],
        buffers=[{"byteLength": len(stream), "uri": uri(stream)}])
    accessors = [{"componentType": 5126, "count": 3, "type": "VEC3"},
                 {"componentType": 5123, "count": 3, "type": "SCALAR"}]
    write("gltf", "read-draco.gltf", compact(triangle(accessors=accessors, **more)))
    write("gltf", "draco-count.gltf", compact(triangle(
        accessors=[accessors[0], accessors[1] | {"count": 2**31}], **more)))
    corners = meshopt_attributes([CORNERS[i:i + 12] for i in (0, 12, 24)])
    view = {"buffer": 1, "byteLength": 36, "extensions": {"EXT_meshopt_compression": {
        "buffer": 0, "byteLength": len(corners), "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}}
    more = dict(extensionsUsed=["EXT_meshopt_compression"], extensionsRequired=["EXT_meshopt_compression"],
                buffers=[{"byteLength": len(corners), "uri": uri(corners)},
                         {"byteLength": 36, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}])
    write("gltf", "read-meshopt.gltf", compact(triangle(bufferViews=[view], **more)))
    huge = json.loads(json.dumps(view))
    huge["byteLength"] = more["buffers"][1]["byteLength"] = 12 * 2**40
    huge["extensions"]["EXT_meshopt_compression"]["count"] = 2**40
    write("gltf", "meshopt-count.gltf", compact(triangle(bufferViews=[huge], **more)))


def scenes():
    compact = lambda document: json.dumps(document, separators=(",", ":"))
    write("gltf", "read-empty.gltf", compact({"asset": {"version": "2.0"}}))
    write("gltf", "read-triangle.gltf", compact(triangle()))
    write("gltf", "read-triangle.glb", glb(triangle(buffers=[{"byteLength": 36}]), CORNERS))
    write("gltf", "read-material.gltf", compact(triangle(
        extensionsUsed=["KHR_texture_transform", "KHR_materials_transmission", "KHR_materials_volume",
                        "KHR_materials_ior", "KHR_materials_specular", "KHR_materials_emissive_strength"],
        materials=[{
            "pbrMetallicRoughness": {
                "baseColorFactor": [1, 0.5, 0.25, 0.5], "metallicFactor": 0, "roughnessFactor": 0.5,
                "baseColorTexture": {"index": 0, "extensions": {
                    "KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2]}}}},
            "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": True,
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                           "KHR_materials_volume": {"attenuationDistance": 2, "thicknessFactor": 1},
                           "KHR_materials_ior": {"ior": 1.3},
                           "KHR_materials_specular": {"specularFactor": 0.5},
                           "KHR_materials_emissive_strength": {"emissiveStrength": 5}}}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        textures=[{"source": 0, "sampler": 0}], samplers=[{"wrapS": 33071, "magFilter": 9728}],
        images=[{"uri": uri(PNG_RGBA, "image/png")}])))
    write("gltf", "read-indices.gltf", compact(triangle(
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "mode": 5}]}],
        accessors=[{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                   {"bufferView": 1, "componentType": 5121, "count": 4, "type": "SCALAR"}],
        bufferViews=[{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 4}],
        buffers=[{"byteLength": 36, "uri": uri(struct.pack("<9f", 0, 0, 1, 1, 0, 0, 0, 1, 0))},
                 {"byteLength": 4, "uri": uri(bytes([0, 1, 2, 0]))}])))
    write("gltf", "read-sparse.gltf", compact(triangle(
        accessors=[{"componentType": 5126, "count": 3, "type": "VEC3", "sparse": {
            "count": 3, "indices": {"bufferView": 1, "componentType": 5123},
            "values": {"bufferView": 0}}}],
        bufferViews=[{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 6}],
        buffers=[{"byteLength": 36, "uri": uri(CORNERS)},
                 {"byteLength": 6, "uri": uri(struct.pack("<3H", 0, 1, 2))}])))
    write("gltf", "read-lights-cameras.gltf", compact({
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}, "intensity": 3},
            {"type": "directional", "color": [1, 0.5, 0]}, {"type": "point"}]}},
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
                    {"type": "orthographic",
                     "orthographic": {"xmag": 1, "ymag": 2, "znear": 0, "zfar": 10}}],
        "nodes": [{"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
                  {"camera": 1, "rotation": [0, 1, 0, 0], "children": [2]},
                  {"extensions": {"KHR_lights_punctual": {"light": 1}}, "scale": [-1, 2, 3]}]}))
    write("gltf", "read-instances.gltf", compact(triangle(
        extensionsUsed=["EXT_mesh_gpu_instancing"],
        nodes=[{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 2, 3, 4, 1], "extensions": {
            "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}])))
    write("gltf", "read-specular-glossiness.gltf", compact(triangle(
        extensionsUsed=["KHR_materials_pbrSpecularGlossiness"],
        materials=[{"extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [1, 0.5, 0.25, 1], "specularFactor": [0.5, 1, 0], "glossinessFactor": 0.5,
            "diffuseTexture": {"index": 0}, "specularGlossinessTexture": {"index": 0, "texCoord": 1}}}}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        textures=[{"source": 0}], images=[{"uri": uri(PNG_RGBA, "image/png")}])))
    compressed_scenes(compact)
    write("gltf", "loop.gltf", compact(triangle(nodes=[{"mesh": 0, "children": [1]}, {"children": [0]}])))
    write("gltf", "outside.gltf", compact(triangle(buffers=[{"byteLength": 36, "uri": "../corners.bin"}])))
    write("gltf", "huge-count.gltf", compact(triangle(accessors=[
        {"bufferView": 0, "componentType": 5126, "count": 2**53 - 1, "type": "VEC3"}])))
    write("gltf", "zeros.gltf", compact(triangle(accessors=[
        {"componentType": 5126, "count": 2**31, "type": "VEC3"}])))
    write("gltf", "huge-view.gltf", compact(triangle(bufferViews=[
        {"buffer": 0, "byteOffset": 2**53 - 1, "byteLength": 2**53 - 1}])))
    write("gltf", "huge-buffer.gltf", compact(triangle(buffers=[
        {"byteLength": 2**53 - 1, "uri": uri(CORNERS)}])))
    write("gltf", "deep.gltf", "[" * 1000)
    write("gltf", "short.glb", glb(triangle(), CORNERS)[:-5])


# ---- Suites ---------------------------------------------------------------------------------------


def suites():
    write("suite", "read-all.toml", """name = "all"
scenes = ["cornell-box", 'door-ajar']
[settings]
width = 32
height = 18
runs = 2
frames = 1
components = ["all", "indirect"]
accumulate = true
ages = [1, 2]
camera_path = "turn"
[reference]
spp = 4
[[camera_path]]
name = "turn"
kind = "orbit"
degrees_per_frame = 0.5
target = [0.0, 1, 0]
[[scene]]
scene = "quad-light"
camera = "0"
environment_scale = 2.5
optional = true
[[method]]
[[method]]
name = "gi"
integrator = "restir_gi"
mode = "biased"
confidence_cap = 10.0
""".replace('accumulate = true\nages = [1, 2]\ncamera_path = "turn"', 'camera_path = "turn"'))
    write("suite", "read-sweep.toml", """scenes = ["cornell-box"]
[sweep]
max_bounces = [2, 4]
"method.gi.confidence_cap" = [10.0, 20.0]
[[method]]
name = "gi"
integrator = "restir_gi"
""")
    write("suite", "read-accumulate.toml", """scenes = "cornell-box"
settings = { frames = 8, accumulate = true, ages = [1, 2], temporal = true }
method = [{}, { name = "b", integrator = "restir_gi", mode = "unbiased" }]
""")
    write("suite", "unknown-key.toml", "scenes = ['cornell-box']\nsceen = 1\n[[method]]\n")
    write("suite", "wrong-type.toml", "scenes = [1]\n[[method]]\n")
    write("suite", "no-toml.toml", "scenes = [\n")
    write("suite", "deep.toml", "a = " + "[" * 1000)
    write("suite", "deep-tables.toml", "[" + ".".join(["a"] * 1000) + "]\n")
    write("suite", "include-itself.toml", 'include = "suite.toml"\n')
    axes = "".join(f"{key} = [{', '.join(map(str, range(1, 101)))}]\n"
                   for key in ("max_bounces", "width", "height", "seed", "frames", "warmup_frames"))
    write("suite", "endless-sweep.toml", "scenes = ['cornell-box']\n[sweep]\n" + axes + "[[method]]\n")
    write("suite", "control.toml", b'scenes = ["a\\u001b[31m"]\n"\\u001b[31m\\nx" = 1\n[[method]]\n')
    write("suite", "bytes.toml", bytes(range(256)))


def serialized(version=4, vertices=4, last=3, cut=0, shapes=1):
    """A square; `vertices` is what it claims, `last` its last index."""
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    data = struct.pack("<I", 0x1000 | 2) + (b"square\0" if version == 4 else b"")
    data += struct.pack("<QQ", vertices, 2)
    data += b"".join(struct.pack("<3f", x, y, 0) for x, y in corners)
    data += b"".join(struct.pack("<2f", x, y) for x, y in corners)
    data += struct.pack("<6I", 0, 1, 2, 0, 2, last)
    packed = zlib.compress(data, 9)
    packed = packed[:len(packed) - cut]
    offset = struct.pack("<Q" if version == 4 else "<I", 0)
    return struct.pack("<HH", 0x041c, version) + packed + offset * shapes + struct.pack("<I", shapes)


def ply(form="ascii", vertices=3, body=b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"):
    return (f"ply\nformat {form} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
            "end_header\n").encode() + body


def mitsuba_scenes():
    def scene(body, version="3.0.0"):
        return f'<scene version="{version}">\n{body}\n</scene>\n'

    shape = '<shape type="rectangle"><transform name="to_world"><scale x="2"/><rotate y="1" angle="30"/>' \
            '<translate z="-1"/></transform>{}</shape>'
    write("mitsuba", "read-rectangle.xml", scene(shape.format('<bsdf type="diffuse"/>')))
    write("mitsuba", "read-names.xml", scene(
        '<default name="a" value="0.3"/><bsdf type="twosided" id="b"><bsdf type="roughconductor"><float '
        'name="alpha" value="$a"/><string name="material" value="Au"/></bsdf></bsdf><alias id="b" as="c"/>'
        + shape.format('<ref id="c"/>')) + "\0a=0.1")
    write("mitsuba", "read-lights.xml", scene(
        '<emitter type="point"><point name="position" x="1"/><rgb name="intensity" value="#ff8040"/></emitter>'
        '<emitter type="spot"/><emitter type="constant"><spectrum name="radiance" value="400:1, 700:2"/>'
        '</emitter><sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><lookat '
        'origin="0,1,4" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"><integer name="width" '
        'value="64"/></film></sensor><integrator type="path"><integer name="max_depth" value="5"/></integrator>'
        + shape.format('<emitter type="area"><rgb name="radiance" value="3"/></emitter>')))
    write("mitsuba", "read-textures.xml", scene(shape.format(
        '<bsdf type="mask"><texture name="opacity" type="checkerboard"/><bsdf type="blendbsdf"><float '
        'name="weight" value="0.2"/><bsdf type="plastic"/><bsdf type="principled"/></bsdf></bsdf>')))
    write("mitsuba", "read-legacy.xml", scene(
        '<shape type="shapegroup" id="g"><shape type="cube"><boolean name="flipNormals" value="true"/></shape>'
        '</shape><shape type="instance"><ref id="g"/><transform name="toWorld"><matrix value="1 0 0 1 0 1 0 2 '
        '0 0 1 3 0 0 0 1"/></transform></shape>', "0.6.0"))
    write("mitsuba", "unknown.xml", scene(shape.format('<bsdf type="velvet"/>')))
    write("mitsuba", "read-unknown.xml", scene(shape.format('<bsdf type="velvet"/>')) + "\0allow_unknown=1")
    write("mitsuba", "cut.xml", '<scene version="3.0.0"><shape type="cube">')
    write("mitsuba", "itself.xml", scene('<include filename="x.xml"/>'))
    write("mitsuba", "loop.xml", scene('<bsdf type="twosided" id="a"><ref id="a"/></bsdf>'
                                       + shape.format('<ref id="a"/>')))
    write("mitsuba", "growing.xml", scene("".join(
        f'<default name="{chr(98 + i)}" value="{("$" + chr(97 + i)) * 9}"/>' if i else
        '<default name="b" value="123456789"/>' for i in range(12))))
    write("mitsuba", "mesh-is-xml.xml", scene('<shape type="ply"><string name="filename" value="x.xml"/></shape>'))
    write("mitsuba", "bytes.xml", bytes(range(1, 256)))


def meshes():
    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\n"
    write("obj", "read-triangle.obj", square + "f 1/1/1 2/1/1 3/1/1\nf -3//-1 -2 -1\n")
    write("obj", "no-vertex.obj", square + "f 1 2 4\n")
    write("obj", "nan.obj", "v nan 0 0\n")
    write("obj", "large.obj", square + "f 1 2 4294967298\n")
    write("ply", "read-text.ply", ply())
    body = struct.pack("9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<B3i", 3, 0, 1, 2)
    write("ply", "read-little.ply", ply("binary_little_endian", body=body))
    big = struct.pack(">9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack(">B3i", 3, 0, 1, 2)
    write("ply", "read-big.ply", ply("binary_big_endian", body=big))
    write("ply", "many.ply", ply(vertices=2**31))
    write("ply", "cut.ply", ply("binary_little_endian", body=body[:-2]))
    write("serialized", "read-3.serialized", serialized(3))
    write("serialized", "read-4.serialized", serialized(4))
    write("serialized", "many.serialized", serialized(vertices=2**31))
    write("serialized", "no-vertex.serialized", serialized(last=4))
    write("serialized", "cut.serialized", serialized(cut=9))
    write("serialized", "many-shapes.serialized", serialized()[:-4] + struct.pack("<I", 2**31))


for make in (textures, environments, images, scenes, compressed, scene_files, suites, commands, mitsuba_scenes, meshes):
    make()
