# Is `path` or an unbiased mode biased? Independent runs against `path`, cell by cell.
set(RL_BIAS_SOURCES
  bias/independent_runs.cpp
  bias/test_cameras.cpp
)
set(RL_BIAS_TESTS
  bias/absorption_test.cpp
  bias/bdpt_test.cpp
  bias/inconsistent_normals_test.cpp
  bias/builtin_scenes_test.cpp
  bias/camera_motion_test.cpp
  bias/light_choice_test.cpp
  bias/long_history_test.cpp
  bias/material_layers_test.cpp
  bias/parameters_test.cpp
  bias/transparency_test.cpp
  bias/undrawn_lamps_test.cpp
)
