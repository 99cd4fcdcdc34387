# Denoisers: what each does to images whose answer is known.
set(RL_DENOISE_TESTS
  accumulate_kernel_test.cpp
  energy_test.cpp
  filters_test.cpp
  over_time_test.cpp
  host_filter_test.cpp
  oidn_test.cpp
  accumulate_test.cpp
  border_test.cpp
  reuse_over_time_test.cpp
  slopes_test.cpp
  conformance/variants.cpp
)
