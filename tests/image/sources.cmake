set(RL_IMAGE_TESTS
  image/exr_damage_test.cpp
  image/exr_test.cpp
  image/intervals_test.cpp
  image/metrics_test.cpp
  image/output_test.cpp
  image/png_test.cpp
)
