# Verdicts on made-up runs whose truth is known, and how often they are false.
set(RL_CERTIFICATE_TESTS
  certificate/calibration_test.cpp
  certificate/judge_test.cpp
  certificate/suite_table_test.cpp
  certificate/text_test.cpp
)
set(RL_CERTIFICATE_LIBRARIES rl_certificate)
