# Unit tests of the dialect, chi-squared tests of everything that samples, and of the configuration.
list(APPEND RL_UNIT_TESTS
  bsdf_cases.cpp
  bsdf_sampling_test.cpp
  bsdf_values_test.cpp
  config_test.cpp
  ggx_reference.cpp
  math_test.cpp
  rng_test.cpp
  sphere_grid.cpp
)
