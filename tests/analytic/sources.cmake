# Exact solutions that tests compare with, and their own tests.
set(RL_ANALYTIC_SOURCES
  analytic/furnace.cpp
  analytic/polygon_irradiance.cpp
  analytic/truths.cpp
)
set(RL_ANALYTIC_TESTS
  analytic/polygon_irradiance_test.cpp
  analytic/truths_test.cpp
)
