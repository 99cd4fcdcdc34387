"""Seeds of images: PNG, JPEG, Radiance HDR, EXR."""

import struct
import zlib

from seed_files import write

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
