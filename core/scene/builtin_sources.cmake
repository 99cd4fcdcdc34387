# Built-in scenes and the feature scan's helper; included by core/scene/sources.cmake.
target_sources(rl_core PRIVATE
  scene/builtin.cpp
  scene/builtin_builder.cpp
  scene/builtin_cornell.cpp
  scene/builtin_courtyard.cpp
  scene/builtin_door.cpp
  scene/builtin_floor.cpp
  scene/builtin_furnace.cpp
  scene/builtin_gallery.cpp
  scene/builtin_glass.cpp
  scene/builtin_many_lights.cpp
  scene/builtin_media.cpp
  scene/builtin_mesh.cpp
  scene/builtin_name.cpp
  scene/builtin_relations.cpp
  scene/builtin_quad_light.cpp
  scene/builtin_shell.cpp
  scene/builtin_sky.cpp
  scene/texture_range.cpp
)
