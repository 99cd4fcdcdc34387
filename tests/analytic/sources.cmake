# Solutions that tests compare with, exact or measured once, and their own tests.
set(RL_ANALYTIC_SOURCES
  analytic/bent_normals.cpp
  analytic/cornell_tiles.cpp
  analytic/furnace.cpp
  analytic/polygon_irradiance.cpp
  analytic/truths.cpp
)
set(RL_ANALYTIC_TESTS
  analytic/bent_normals_test.cpp
  analytic/cornell_tiles_test.cpp
  analytic/polygon_irradiance_test.cpp
  analytic/truths_test.cpp
)
