set(RL_EXACT_TESTS
  exact/algebra_double_test.cpp
  exact/algebra_float_test.cpp
  exact/shift_test.cpp
)
