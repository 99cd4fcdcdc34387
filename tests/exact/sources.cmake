set(RL_EXACT_TESTS
  exact/algebra_double_test.cpp
  exact/algebra_float_test.cpp
  exact/every_combination_double_test.cpp
  exact/every_combination_float_test.cpp
  exact/mis_values_test.cpp
  exact/shift_test.cpp
)
