set(RL_VIEW_TESTS server_test.cpp)
set(RL_VIEW_LIBRARIES rl_view)
