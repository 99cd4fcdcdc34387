// Synthetic images with layers, for tests of denoisers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/frame/image_denoiser.h"
#include "core/dialect/order.h"

namespace restlab::denoise {

// Names of denoisers that filter by guides and therefore run on layers alone.
inline std::vector<std::string> filters() {
  std::vector<std::string> names;
  for (const DenoiserInfo* info : denoiserRegistry()) {
    if (info->onHost) continue;  // a network does not meet the tolerances
    if (info->needsFeatures) names.push_back(info->name);
  }
  return names;
}

inline SessionConfig filterConfig(const std::string& denoiser, glm::uvec2 size, int threads = 1,
                                  const std::string& backend = "cpu") {
  SessionConfig config;
  config.denoiser = denoiser;
  config.width = size.x;
  config.height = size.y;
  config.threads = threads;
  config.backend = backend;
  return config;
}

inline Image imageOf(glm::uvec2 size, const std::function<glm::vec3(glm::uvec2)>& at) {
  Image image(size.x, size.y);
  for (uint32_t y = 0; y < size.y; ++y) {
    for (uint32_t x = 0; x < size.x; ++x) image.pixels[size_t(y) * size.x + x] = at({x, y});
  }
  return image;
}

// Returns a number in [0, 1) that differs for each pixel and frame.
inline float noiseAt(glm::uvec2 p, uint32_t frame) {
  uint32_t h = p.x * 0x9e3779b1u ^ p.y * 0x85ebca77u ^ frame * 0xc2b2ae3du;
  h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12u)) * 0x297a2d39u;
  h ^= h >> 15u;
  return float(h >> 8u) * (1.0f / 16777216.0f);
}

}  // namespace restlab::denoise
