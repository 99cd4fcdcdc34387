# Built-in scenes and the feature scan's helper; included by core/scene/sources.cmake.
target_sources(rl_core PRIVATE
  scene/builtin/builtin.cpp
  scene/builtin/builder.cpp
  scene/builtin/cornell.cpp
  scene/builtin/courtyard.cpp
  scene/builtin/door.cpp
  scene/builtin/floor.cpp
  scene/builtin/furnace.cpp
  scene/builtin/gallery.cpp
  scene/builtin/glass.cpp
  scene/builtin/many_lights.cpp
  scene/builtin/media.cpp
  scene/builtin/mesh.cpp
  scene/builtin/name.cpp
  scene/builtin/relations.cpp
  scene/builtin/quad_light.cpp
  scene/builtin/shell.cpp
  scene/builtin/sky.cpp
  scene/textures/texture_range.cpp
)
