# Renders a Lambert glTF scene with Cycles under restlab's settings, for a comparison on one machine:
#
#   apt-get install blender python3-numpy
#   blender -b --python experiments/peers/cycles.py -- SCENE.gltf OUT.exr SPP SIZE SCATTERING_EVENTS THREADS
#   ./lab compare --ref REFERENCE.exr OUT.exr --any-reference
#
# Box filter of one pixel, no Russian roulette, clamp, denoiser or adaptive sampling. Blender imports glTF
# materials as its Principled BSDF, whose rough base is not Lambert's, and emission with another unit: each
# material becomes a Diffuse BSDF of the base colour, or an Emission of emissiveFactor x emissiveStrength.
# Prints one line of JSON: seconds of wall and CPU time of the render call.
import json
import os
import resource
import sys
import time

import bpy
import numpy

# Debian 12's glTF importer uses the alias that its numpy no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

scene_path, out, spp, size, events, threads = sys.argv[sys.argv.index("--") + 1:]
with open(scene_path) as file:
    materials = {m.get("name", ""): m for m in json.load(file).get("materials", [])}

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=os.path.abspath(scene_path))
for material in bpy.data.materials:
    source = materials.get(material.name)
    if source is None:
        sys.exit(f"{scene_path}: Blender's material '{material.name}' is not in the file")
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    emitted = source.get("emissiveFactor", [0, 0, 0])
    if max(emitted) > 0:
        strength = source.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
        shader = nodes.new("ShaderNodeEmission")
        shader.inputs["Color"].default_value = (*emitted, 1)
        shader.inputs["Strength"].default_value = strength
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = source["pbrMetallicRoughness"].get("baseColorFactor", [1, 1, 1, 1])
        shader.inputs["Roughness"].default_value = 0
    links.new(shader.outputs[0], output.inputs["Surface"])

scene = bpy.context.scene
scene.camera = next(o for o in scene.objects if o.type == "CAMERA")
scene.render.engine = "CYCLES"
scene.render.resolution_x = scene.render.resolution_y = int(size)
scene.render.resolution_percentage = 100
scene.render.threads_mode = "FIXED"
scene.render.threads = int(threads)
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = os.path.abspath(out)
scene.view_settings.view_transform = "Raw"
if scene.world is None:
    scene.world = bpy.data.worlds.new("black")
scene.world.use_nodes = False
scene.world.color = (0, 0, 0)
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = int(spp)
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1.0
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.light_sampling_threshold = 0
bounces = int(events) - 1  # Cycles counts the bounces after the first scattering event
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
cycles.min_light_bounces = cycles.min_transparent_bounces = 1024
cycles.caustics_reflective = cycles.caustics_refractive = True
cycles.blur_glossy = 0


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


cpu, wall = cpu_seconds(), time.monotonic()
bpy.ops.render.render(write_still=True)
print(json.dumps({"renderer": f"Cycles {bpy.app.version_string}", "spp": int(spp), "threads": int(threads),
                  "wall_s": time.monotonic() - wall, "cpu_s": cpu_seconds() - cpu}))
