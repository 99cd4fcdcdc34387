// Images that a NumPy script makes as well, with values that are exact in float.
#pragma once

#include "core/image/image.h"

namespace restlab::image_test {

// 40x30 pixels: r = k/64, image = r + k/256.
struct KnownPair {
  Image image{40, 30}, reference{40, 30};
  KnownPair() {
    for (uint32_t y = 0; y < 30; ++y) {
      for (uint32_t x = 0; x < 40; ++x) {
        for (uint32_t c = 0; c < 3; ++c) {
          const float r = float((x * 7 + y * 3 + c * 5) % 64) / 64.0f;
          const float d = float(int((x * 5 + y * 11 + c * 2) % 33) - 16) / 256.0f;
          reference.at(x, y)[int(c)] = r;
          image.at(x, y)[int(c)] = r + d;
        }
      }
    }
  }
};

// 20x150 pixels without a regular pattern, taller than a band of the filters: r = scale k/256,
// image = scale k/1024.
struct RoughPair {
  Image image{20, 150}, reference{20, 150};
  explicit RoughPair(float scale = 1.0f) {
    for (uint32_t y = 0; y < 150; ++y) {
      for (uint32_t x = 0; x < 20; ++x) {
        for (uint32_t c = 0; c < 3; ++c) {
          const float r = float((x * 73 + y * 151 + c * 57 + x * y * 11) % 256) / 256.0f;
          const float n = float((x * 29 + y * 83 + c * 101 + x * y * 7) % 256) / 256.0f;
          reference.at(x, y)[int(c)] = scale * r;
          image.at(x, y)[int(c)] = scale * (0.75f * r + 0.25f * n);
        }
      }
    }
  }
};

}  // namespace restlab::image_test
