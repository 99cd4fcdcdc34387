set(RL_VIEW_TESTS command_test.cpp every_parameter_test.cpp image_message_test.cpp lights_test.cpp live_view_test.cpp materials_test.cpp server_test.cpp tev_test.cpp dropped_round_test.cpp view_history_test.cpp view_images_test.cpp measure_test.cpp
  view_loop_test.cpp view_pages_test.cpp view_program_test.cpp view_end_test.cpp prompt_end_test.cpp view_exposure_test.cpp view_limits_test.cpp moving_test.cpp page.cpp page_fixture.cpp page_layout_test.cpp page_open_test.cpp page_panels_test.cpp page_commands_test.cpp page_images_test.cpp page_pixels_test.cpp page_session_test.cpp page_speed_test.cpp page_stress_test.cpp page_room_test.cpp unused_settings_test.cpp page_settings_test.cpp cli/program.cpp report/browser.cpp report/sample.cpp page_tools_test.cpp)
set(RL_VIEW_LIBRARIES rl_view rl_report)
# Their tests share a browser.
set(RL_VIEW_SUITES PageCommandsTest PageImagesTest PageLayoutTest PageMaterialsTest PageOpenTest PagePanelsTest PagePixelsTest PageRoomTest PageSessionTest PageSettingsTest PageStressTest PageToolsTest)
# Both compile Boost.Beast, at the same time if they are apart.
set_property(SOURCE view/page.cpp view/server_test.cpp PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
