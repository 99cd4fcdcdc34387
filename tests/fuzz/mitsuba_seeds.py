"""Seeds of scenes and meshes of Mitsuba."""

import struct
import zlib

from seed_files import write


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
