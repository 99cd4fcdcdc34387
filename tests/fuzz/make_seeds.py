#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets that are made by rule: tests/fuzz/seeds/TARGET/NAME.

Names that begin with 'read' are of files that are read; all others are refused. Files named
found-* came out of fuzzing and are not made here.
"""

import gltf_seeds
import grid_seeds
import image_seeds
import mitsuba_seeds
import text_seeds

for make in (image_seeds.textures, image_seeds.environments, image_seeds.images, gltf_seeds.scenes,
             gltf_seeds.compressed, text_seeds.scene_files, text_seeds.suites, text_seeds.commands,
             text_seeds.fields, text_seeds.curves, grid_seeds.grids,
             mitsuba_seeds.mitsuba_scenes, mitsuba_seeds.meshes):
    make()
