# Deliberately wrong or declared biased: the bias tests must notice the first and bound the second.
set(RL_CANARY_TESTS
  canary/biased_mode_test.cpp
  canary/wrong_weights_test.cpp
)
