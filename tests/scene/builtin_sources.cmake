# Tests of the built-in scenes and of the feature scan; included by tests/scene/sources.cmake.
set(RL_BUILTIN_TESTS
  scene/builtin_name_test.cpp
  scene/builtin_test.cpp
  scene/builtin_rooms_test.cpp
  scene/builtin_sweep_test.cpp
  scene/feature_scan_test.cpp
  scene/mesh_checks.cpp
)
