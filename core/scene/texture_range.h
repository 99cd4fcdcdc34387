// What values a material's texture can take, for deciding what a scene needs.
#pragma once

#include <array>
#include <map>

#include "core/scene/scene.h"

namespace restlab {

// Bounds of every texel's RGBA, in [0, 1]. Filtering is a convex combination of texels, so they
// bound every look-up too. sRGB decoding is monotonic and keeps 0 and 1: zero and one stay what
// they are.
struct TexelRange {
  std::array<float, 4> low{1.0f, 1.0f, 1.0f, 1.0f};
  std::array<float, 4> high{1.0f, 1.0f, 1.0f, 1.0f};
};

// Reads each image once, when first asked for.
class TextureRanges {
 public:
  explicit TextureRanges(const Scene& scene) : scene_(scene) {}
  // The range of a material's slot; all ones where it is empty.
  const TexelRange& ofSlot(const rl::Material& material, uint32_t slot);

 private:
  const Scene& scene_;
  std::map<uint32_t, TexelRange> byImage_;
  const TexelRange white_;
};

}  // namespace restlab
