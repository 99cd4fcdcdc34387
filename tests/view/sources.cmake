set(RL_VIEW_TESTS command_test.cpp image_message_test.cpp live_view_test.cpp server_test.cpp)
set(RL_VIEW_LIBRARIES rl_view)
