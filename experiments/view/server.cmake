# rl_server: the viewer's HTTP and WebSocket server. Boost.Beast takes half a minute to compile, so
# it is named before all else: the last source to be compiled would be compiled alone.
add_library(rl_server OBJECT ${CMAKE_CURRENT_LIST_DIR}/server.cpp)
target_link_libraries(rl_server PRIVATE rl_options fmt::fmt Threads::Threads Boost::headers)
rl_compile_lightly(rl_server)
