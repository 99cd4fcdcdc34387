# What every registered integrator must pass in every mode.
set(RL_CONFORMANCE_TESTS
  conformance/analytic_scenes_test.cpp
  conformance/cache_entries_test.cpp
  conformance/changing_light_test.cpp
  conformance/cache_run.cpp
  conformance/determinism_test.cpp
  conformance/health_test.cpp
  conformance/layers_test.cpp
  conformance/light_transport_test.cpp
  conformance/live_light_test.cpp
  conformance/live_session_test.cpp
  conformance/long_run_test.cpp
  conformance/moving_view_test.cpp
  conformance/radiance_test.cpp
  conformance/thin_wall_test.cpp
  conformance/variants.cpp
)
