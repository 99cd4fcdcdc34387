# Unit tests of the dialect, chi-squared tests of everything that samples, and of the configuration.
list(APPEND RL_UNIT_TESTS
  alpha_test.cpp
  bsdf_cases.cpp
  closure_cases.cpp
  closures_test.cpp
  bsdf_delta_test.cpp
  bsdf_sampling_test.cpp
  bsdf_values_test.cpp
  bvh_test.cpp
  camera_test.cpp
  config_test.cpp
  direct_sample_test.cpp
  environment_test.cpp
  feature_mask_test.cpp
  kernel_units_test.cpp
  layer_cases.cpp
  layers_test.cpp
  own_kernels_test.cpp
  ggx_reference.cpp
  light_test.cpp
  light_tree_test.cpp
  math_test.cpp
  multiscatter_test.cpp
  pack_test.cpp
  path_shift_test.cpp
  partners_test.cpp
  plate_test.cpp
  ray_offset_test.cpp
  records_test.cpp
  frame_graph_test.cpp
  replay_sample_test.cpp
  reservoir_store_test.cpp
  rng_audit_bdpt.cpp
  rng_audit_local.cpp
  rng_audit_path.cpp
  rng_audit_radiance_trace.cpp
  rng_audit_radiosity_direct.cpp
  rng_audit_radiosity_rays.cpp
  rng_audit_restir_spatial_shift.cpp
  rng_audit_restir_cache_update.cpp
  rng_audit_restir_di_initial.cpp
  rng_audit_restir_initial.cpp
  rng_audit_restir_light_edges.cpp
  rng_audit_restir_cache_reuse.cpp
  rng_audit_changes_trace.cpp
  rng_audit_restir_spatial.cpp
  rng_audit_restir_temporal.cpp
  rng_audit_surflet_propose.cpp
  rng_audit_template.cpp
  rng_audit_test.cpp
  rng_audit_voxel_propose.cpp
  rng_test.cpp
  surface_test.cpp
  surface_transform_test.cpp
  texture_test.cpp
  drawn_lights_test.cpp
  shapes_test.cpp
  shape_draws_test.cpp
  field_text_test.cpp
  field_trace_test.cpp
  nurbs_test.cpp
  curves_test.cpp
  field_grid_test.cpp
  distance_grid_test.cpp
  form_factor_test.cpp
  cpu_raster_test.cpp)

# They set macros for the kernels that they include.
set(alone ${RL_UNIT_TESTS})
list(FILTER alone INCLUDE REGEX "^(rng_audit_|feature_mask|partners|direct_sample|replay_sample)")
list(TRANSFORM alone PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
set_property(SOURCE ${alone} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
# Millions of samples in the test's own code.
foreach(file bsdf_sampling_test.cpp)
  set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/${file} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
  # As in rl_compile_lightly (cmake/options.cmake).
  set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/${file} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
endforeach()

# Rays that tell tracers apart, and materials with layers, for other tests too.
set(RL_UNIT_SOURCES layered.cpp ray_cases.cpp)
