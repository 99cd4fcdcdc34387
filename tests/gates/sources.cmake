# Truths of other renderers, and the built-in Cornell box against its committed tile means.
set(RL_GATES_TESTS
  gates/cornell_test.cpp
  gates/mitsuba_test.cpp
  gates/tile_comparison.cpp
)
