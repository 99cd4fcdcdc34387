# Is `path` or an unbiased mode biased? Independent runs against `path`, cell by cell.
set(RL_BIAS_SOURCES
  bias/independent_runs.cpp
)
