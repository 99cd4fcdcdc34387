target_sources(rl_core PRIVATE
  image/atomic_file.cpp
  image/bias_runs.cpp
  image/chromaticities.cpp
  image/exr_header.cpp
  image/exr_layers.cpp
  image/exr_read.cpp
  image/exr_write.cpp
  image/flip.cpp
  image/flip_color.cpp
  image/flip_exposures.cpp
  image/half_products.cpp
  image/halves_noise.cpp
  image/intervals.cpp
  image/layer_colors.cpp
  image/mask.cpp
  image/metrics.cpp
  image/pixel_metrics.cpp
  image/plane.cpp
  image/png.cpp
  image/ssim.cpp
  image/window_metrics.cpp
  image/srgb.cpp
)
target_link_libraries(rl_core PUBLIC OpenEXR::OpenEXR PRIVATE Boost::headers)
# As system headers, so that our warnings do not judge them.
target_include_directories(rl_core SYSTEM PRIVATE ${STB_INCLUDE_DIR})
