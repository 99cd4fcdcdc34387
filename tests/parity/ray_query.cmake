# Ray queries: tested on the machine's own device where it has them, and by night everywhere on lavapipe of Mesa 25, which
# is fetched for it on Debian 12. Without the network that test skips there, visibly.
target_sources(rl_tests_parity PRIVATE ${CMAKE_CURRENT_LIST_DIR}/ray_query_test.cpp)
target_compile_definitions(rl_tests_parity PRIVATE
  RESTLAB_RAY_QUERY_CACHE="${CMAKE_CURRENT_BINARY_DIR}/ray_query_cache")
add_test(NAME parity.mesa_backport
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/mesa_backport.sh ${CMAKE_CURRENT_BINARY_DIR}/mesa_backport
          $<TARGET_FILE:rl_tests_parity> --gtest_filter=*RayQuery*)
# The driver is there for its ray queries: a case that finds none has failed.
set_tests_properties(parity.mesa_backport PROPERTIES LABELS nightly TIMEOUT 1200
  SKIP_RETURN_CODE 77 FAIL_REGULAR_EXPRESSION "SKIPPED: no Vulkan device")
