target_sources(rl_core PRIVATE
  scene/camera_path/camera_aim.cpp
  scene/camera_path/camera_path.cpp
  scene/camera_path/camera_path_check.cpp
  scene/camera_path/camera_path_config.cpp
  scene/closure_info.cpp
  scene/material_notes.cpp
  scene/closure_table/closure_table.cpp
  scene/closure_table/table_files.cpp
  scene/content_hash.cpp
  scene/textures/cube_map.cpp
  scene/textures/daylight.cpp
  scene/textures/environment.cpp
  scene/textures/hdr_decode.cpp
  scene/textures/hdr_header.cpp
  scene/textures/image_decode.cpp
  scene/textures/jpeg_decode.cpp
  scene/compiled/light_factor.cpp
  scene/linear_map.cpp
  scene/plate.cpp
  scene/load_scene.cpp
  scene/scene_folders.cpp
  scene/scene_file/material_kinds.cpp
  scene/scene_file/scattering.cpp
  scene/scene_file/scene_file.cpp
  scene/scene_file/scene_settings.cpp
  scene/scene_file/shapes.cpp
  scene/scene_file/meshes.cpp
  scene/crease.cpp
  scene/textures/png_decode.cpp
  scene/textures/texture_range.cpp
  scene/compiled/coarse_vertices.cpp
  scene/compiled/scene_bounds.cpp
  scene/compiled/scene_origin.cpp
  scene/camera_path/sight.cpp
  scene/compiled/split_triangles.cpp
  scene/shapes/shape_info.cpp
  scene/shapes/fine_meshes.cpp
  scene/distance/closest_triangle.cpp
  scene/distance/distance_grid.cpp
  scene/distance/triangles.cpp
  scene/distance/winding.cpp
  scene/field/builder.cpp
  scene/field/expression.cpp
  scene/field/fault.cpp
  scene/field/grid.cpp
  scene/field/grid_file.cpp
  scene/field/program.cpp
  scene/field/reader.cpp
  scene/field/shape.cpp
  scene/field/solid.cpp
  scene/field/solid_tree.cpp
  scene/field/stand_in.cpp
  scene/curves/curve_words.cpp
  scene/curves/read_curves.cpp
  scene/curves/stand_in.cpp
  scene/curves/strands.cpp
  scene/splines/bezier.cpp
  scene/splines/closest_point.cpp
  scene/splines/mesh_of_surface.cpp
  scene/splines/nurbs.cpp
  scene/splines/read_nurbs.cpp
  scene/splines/surface_words.cpp
  scene/splines/tessellate.cpp
  ${RL_SHAPE_HOST_SOURCES}
)
target_link_libraries(rl_core PUBLIC nlohmann_json::nlohmann_json)
target_include_directories(rl_core SYSTEM PRIVATE ${SPNG_INCLUDE_DIR} ${TURBOJPEG_INCLUDE_DIR})
target_link_libraries(rl_core PRIVATE ${SPNG_LIBRARY} ${TURBOJPEG_LIBRARY})

# Scenes from files and from code are made once: half of the compile time is worth more than their speed.
add_library(rl_scene_files OBJECT
  scene/gltf/accessor.cpp
  scene/gltf/attributes.cpp
  scene/gltf/cameras_lights.cpp
  scene/gltf/closures.cpp
  scene/gltf/container.cpp
  scene/gltf/document.cpp
  scene/gltf/draco.cpp
  scene/gltf/draco_mesh.cpp
  scene/gltf/extensions.cpp
  scene/gltf/instances.cpp
  scene/gltf/layers.cpp
  scene/gltf/load.cpp
  scene/gltf/material.cpp
  scene/gltf/mesh.cpp
  scene/gltf/meshopt.cpp
  scene/gltf/nodes.cpp
  scene/gltf/report.cpp
  scene/gltf/rules.cpp
  scene/gltf/schema.cpp
  scene/gltf/specular_glossiness.cpp
  scene/gltf/texture.cpp
  scene/gltf/triangles.cpp
  scene/gltf/uri.cpp
  scene/gltf/validate.cpp
  scene/gltf/variants.cpp
  scene/gltf/tinygltf.cpp
  scene/builtin/builtin.cpp
  scene/builtin/builder.cpp
  scene/builtin/cornell.cpp
  scene/builtin/course.cpp
  scene/builtin/courtyard.cpp
  scene/builtin/door.cpp
  scene/builtin/floor.cpp
  scene/builtin/furnace.cpp
  scene/builtin/shapes.cpp
  scene/builtin/fields.cpp
  scene/builtin/gallery.cpp
  scene/builtin/glass.cpp
  scene/builtin/hair.cpp
  scene/builtin/many_lights.cpp
  scene/builtin/media.cpp
  scene/builtin/mesh.cpp
  scene/builtin/name.cpp
  scene/builtin/relations.cpp
  scene/builtin/quad_light.cpp
  scene/builtin/shell.cpp
  scene/builtin/sky.cpp
  scene/builtin/teapot.cpp
  scene/mitsuba/bsdf.cpp
  scene/mitsuba/bump.cpp
  scene/mitsuba/bsdf_kinds.cpp
  scene/mitsuba/curves.cpp
  scene/mitsuba/document.cpp
  scene/mitsuba/emitters.cpp
  scene/mitsuba/files.cpp
  scene/mitsuba/load.cpp
  scene/mitsuba/mesh_normals.cpp
  scene/mitsuba/obj.cpp
  scene/mitsuba/optical_constants.cpp
  scene/mitsuba/parameters.cpp
  scene/mitsuba/ply.cpp
  scene/mitsuba/report.cpp
  scene/mitsuba/sensor.cpp
  scene/mitsuba/serialized.cpp
  scene/mitsuba/shapes.cpp
  scene/mitsuba/spectrum.cpp
  scene/mitsuba/textures.cpp
  scene/mitsuba/values.cpp
  scene/gltf_write/materials.cpp
  scene/gltf_write/nodes.cpp
  scene/gltf_write/write.cpp
  scene/scene_write/scene_write.cpp
)
target_link_libraries(rl_scene_files PRIVATE rl_options embree TBB::tbb glm::glm fmt::fmt Threads::Threads
                      nlohmann_json::nlohmann_json OpenEXR::OpenEXR draco::draco meshoptimizer::meshoptimizer
                      pugixml::pugixml ZLIB::ZLIB)
rl_compile_lightly(rl_scene_files)
rl_compile_together(rl_scene_files 1 gltf builtin mitsuba gltf_write)
# Draco's headers define macros with short names.
set_property(SOURCE scene/gltf/draco_mesh.cpp PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
# tinygltf is compiled into tinygltf.cpp (with its own file and image access left out).
set_property(SOURCE scene/gltf/tinygltf.cpp PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
target_sources(rl_core PRIVATE $<TARGET_OBJECTS:rl_scene_files>)
target_link_libraries(rl_core PRIVATE draco::draco meshoptimizer::meshoptimizer pugixml::pugixml ZLIB::ZLIB)
