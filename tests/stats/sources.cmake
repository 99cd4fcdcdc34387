# The statistics library of all bias tests, and its own tests.
set(RL_STATS_SOURCES
  stats/chi2.cpp
  stats/holm.cpp
  stats/ks.cpp
  stats/power.cpp
  stats/replicates.cpp
  stats/run_set.cpp
  stats/tost.cpp
  stats/welch.cpp
)
set(RL_STATS_TESTS
  stats/replicates_test.cpp
  stats/stats_test.cpp
)
