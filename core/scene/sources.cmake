target_sources(rl_core PRIVATE
  scene/camera_aim.cpp
  scene/camera_path.cpp
  scene/camera_path_check.cpp
  scene/camera_path_config.cpp
  scene/content_hash.cpp
  scene/cube_map.cpp
  scene/environment.cpp
  scene/gltf_accessor.cpp
  scene/gltf_attributes.cpp
  scene/gltf_cameras_lights.cpp
  scene/gltf_container.cpp
  scene/gltf_document.cpp
  scene/gltf_extensions.cpp
  scene/gltf_instances.cpp
  scene/gltf_load.cpp
  scene/gltf_material.cpp
  scene/gltf_mesh.cpp
  scene/gltf_nodes.cpp
  scene/gltf_report.cpp
  scene/gltf_rules.cpp
  scene/gltf_schema.cpp
  scene/gltf_texture.cpp
  scene/gltf_triangles.cpp
  scene/gltf_uri.cpp
  scene/gltf_validate.cpp
  scene/hdr_decode.cpp
  scene/hdr_header.cpp
  scene/image_decode.cpp
  scene/jpeg_decode.cpp
  scene/light_factor.cpp
  scene/linear_map.cpp
  scene/plate.cpp
  scene/load_scene.cpp
  scene/png_decode.cpp
  scene/coarse_vertices.cpp
  scene/scene_bounds.cpp
  scene/scene_origin.cpp
  scene/sight.cpp
  scene/split_triangles.cpp
  scene/tinygltf.cpp
)
# tinygltf is compiled into tinygltf.cpp (with its own file and image access left out), xxHash is a
# header.
target_link_libraries(rl_core PUBLIC nlohmann_json::nlohmann_json)
target_include_directories(rl_core SYSTEM PRIVATE ${SPNG_INCLUDE_DIR} ${TURBOJPEG_INCLUDE_DIR})
target_link_libraries(rl_core PRIVATE ${SPNG_LIBRARY} ${TURBOJPEG_LIBRARY})
include(${CMAKE_CURRENT_LIST_DIR}/builtin_sources.cmake)
