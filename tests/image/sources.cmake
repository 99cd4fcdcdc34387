set(RL_IMAGE_TESTS
  image/exr_test.cpp
  image/intervals_test.cpp
  image/metrics_test.cpp
  image/png_test.cpp
)
