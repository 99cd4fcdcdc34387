set(RL_RUNNER_TESTS accumulate_test.cpp block_images_test.cpp columns_test.cpp compare_folders_test.cpp convergence_test.cpp every_parameter_test.cpp
  folder_lock_test.cpp job_test.cpp light_events_test.cpp pace_test.cpp reference_chunk_test.cpp reference_noise_test.cpp reference_state_test.cpp
  reference_test.cpp relmse_checks_test.cpp reverse_turns_test.cpp scene_settings_test.cpp
  scene_sweep_test.cpp speed_up_test.cpp suite_test.cpp summary_test.cpp
  sweep_test.cpp table_test.cpp temporal_test.cpp truth_test.cpp parameter_sweep_test.cpp
  plan_test.cpp task_file_test.cpp)
set(RL_RUNNER_LIBRARIES rl_runner)
