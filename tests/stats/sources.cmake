# Tests of experiments/statistics, and what tests alone ask of statistics.
set(RL_STATS_SOURCES
  stats/ks.cpp
)
set(RL_STATS_TESTS
  stats/bias_test.cpp
  stats/run_set_test.cpp
  stats/stats_test.cpp
)
