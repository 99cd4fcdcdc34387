# Truths of other renderers, scenes of Mitsuba whose pixels are known, and the built-in Cornell box against its committed tile means.
set(RL_GATES_TESTS
  gates/cornell_test.cpp
  gates/mitsuba_test.cpp
  gates/tile_comparison.cpp
  gates/known_pixels.cpp
  gates/mitsuba_cameras_test.cpp
  gates/mitsuba_lamps_test.cpp
  gates/mitsuba_surfaces_test.cpp
  scene/gltf_builder.cpp
  scene/mitsuba_builder.cpp
)
