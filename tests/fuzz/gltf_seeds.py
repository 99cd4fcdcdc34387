"""Seeds of glTF and of compressed geometry."""

import base64
import json
import struct

from compressed_streams import (CORNERS, DRACO_GRID, MESHOPT_GRID, draco_triangle, meshopt_attributes,
                                meshopt_indices, varint)
from image_seeds import PNG_RGBA
from seed_files import write

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
