target_sources(rl_core PRIVATE
  scene/camera_path/camera_aim.cpp
  scene/camera_path/camera_path.cpp
  scene/camera_path/camera_path_check.cpp
  scene/camera_path/camera_path_config.cpp
  scene/content_hash.cpp
  scene/textures/cube_map.cpp
  scene/textures/environment.cpp
  scene/gltf/accessor.cpp
  scene/gltf/attributes.cpp
  scene/gltf/cameras_lights.cpp
  scene/gltf/container.cpp
  scene/gltf/document.cpp
  scene/gltf/extensions.cpp
  scene/gltf/instances.cpp
  scene/gltf/load.cpp
  scene/gltf/material.cpp
  scene/gltf/mesh.cpp
  scene/gltf/nodes.cpp
  scene/gltf/report.cpp
  scene/gltf/rules.cpp
  scene/gltf/schema.cpp
  scene/gltf/texture.cpp
  scene/gltf/triangles.cpp
  scene/gltf/uri.cpp
  scene/gltf/validate.cpp
  scene/textures/hdr_decode.cpp
  scene/textures/hdr_header.cpp
  scene/textures/image_decode.cpp
  scene/textures/jpeg_decode.cpp
  scene/compiled/light_factor.cpp
  scene/linear_map.cpp
  scene/plate.cpp
  scene/load_scene.cpp
  scene/textures/png_decode.cpp
  scene/compiled/coarse_vertices.cpp
  scene/compiled/scene_bounds.cpp
  scene/compiled/scene_origin.cpp
  scene/camera_path/sight.cpp
  scene/compiled/split_triangles.cpp
  scene/gltf/tinygltf.cpp
)
# tinygltf is compiled into tinygltf.cpp (with its own file and image access left out), xxHash is a
# header.
set_property(SOURCE scene/gltf/tinygltf.cpp PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
target_link_libraries(rl_core PUBLIC nlohmann_json::nlohmann_json)
target_include_directories(rl_core SYSTEM PRIVATE ${SPNG_INCLUDE_DIR} ${TURBOJPEG_INCLUDE_DIR})
target_link_libraries(rl_core PRIVATE ${SPNG_LIBRARY} ${TURBOJPEG_LIBRARY})
include(${CMAKE_CURRENT_LIST_DIR}/builtin/sources.cmake)
