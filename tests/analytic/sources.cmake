# Solutions that tests compare with and that are no library of experiments/truths, and the tests of both.
set(RL_ANALYTIC_SOURCES
  analytic/inconsistent_normals.cpp
  analytic/cornell_tiles.cpp
  analytic/local_images.cpp
)
set(RL_ANALYTIC_LIBRARIES rl_bsdf)
set(RL_ANALYTIC_TESTS
  analytic/inconsistent_normals_test.cpp
  analytic/cornell_tiles_test.cpp
  analytic/height_field_test.cpp
  analytic/media_test.cpp
  analytic/polygon_irradiance_test.cpp
  analytic/sampling_noise_test.cpp
  analytic/scene_file_textures_test.cpp
  analytic/truths_test.cpp
  analytic/wax_test.cpp
  analytic/local_ambient_test.cpp
  analytic/local_colours_test.cpp
  analytic/local_maps_test.cpp
  analytic/local_test.cpp
  analytic/radiosity_test.cpp
  scene/gltf_builder.cpp
)
