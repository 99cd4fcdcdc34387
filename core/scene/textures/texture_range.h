// Ranges of a material's texture values, for deciding what a scene needs.
#pragma once

#include <array>
#include <map>

#include "core/scene/scene.h"

namespace restlab {

// Bounds of every texel's RGBA, in [0, 1]. Filtering is a convex combination of texels, so the
// bounds hold for every look-up. sRGB decoding is monotonic and keeps 0 and 1: bounds of 0 and 1
// stay exact.
struct TexelRange {
  std::array<float, 4> low{1.0f, 1.0f, 1.0f, 1.0f};
  std::array<float, 4> high{1.0f, 1.0f, 1.0f, 1.0f};
};

// Reads each image once, at its first use.
class TextureRanges {
 public:
  explicit TextureRanges(const Scene& scene) : scene_(scene) {}
  // Range of a material's slot; all ones if it is empty.
  const TexelRange& ofSlot(const rl::Material& material, uint32_t slot);

 private:
  const Scene& scene_;
  std::map<uint32_t, TexelRange> byImage_;
  const TexelRange white_;
};

}  // namespace restlab
