target_sources(rl_core PRIVATE
  image/io/atomic_file.cpp
  image/io/chromaticities.cpp
  image/io/exr_header.cpp
  image/io/exr_layers.cpp
  image/io/exr_read.cpp
  image/io/exr_write.cpp
  image/metrics/flip.cpp
  image/metrics/flip_color.cpp
  image/metrics/flip_exposures.cpp
  image/io/layer_colors.cpp
  image/metrics/mask.cpp
  image/metrics/metrics.cpp
  image/metrics/pixel_metrics.cpp
  image/metrics/plane.cpp
  image/io/png.cpp
  image/metrics/ssim.cpp
  image/metrics/window_metrics.cpp
  image/io/srgb.cpp
)
target_link_libraries(rl_core PUBLIC OpenEXR::OpenEXR PRIVATE Boost::headers)
# As system headers, so that our warnings do not judge them.
target_include_directories(rl_core SYSTEM PRIVATE ${STB_INCLUDE_DIR})
