#include "core/scene/textures/texture_range.h"

#include <algorithm>

namespace restlab {
namespace {

TexelRange rangeOf(const TextureImage& image) {
  std::array<uint32_t, 4> low, high;
  low.fill(255u);
  high.fill(0u);
  for (const uint32_t texel : image.texels) {
    for (size_t c = 0; c < 4; ++c) {
      const uint32_t value = (texel >> (8 * c)) & 255u;
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  }
  TexelRange range;
  for (size_t c = 0; c < 4; ++c) {
    range.low[c] = float(low[c]) / 255.0f;
    range.high[c] = float(high[c]) / 255.0f;
  }
  return range;
}

}  // namespace

const TexelRange& TextureRanges::ofSlot(const rl::Material& material, uint32_t slot) {
  if (material.textures[slot] == rl::RL_INVALID) return white_;
  const uint32_t image = scene_.textureUses.at(material.textures[slot]).image;
  const auto found = byImage_.find(image);
  if (found != byImage_.end()) return found->second;
  return byImage_.emplace(image, rangeOf(scene_.images.at(image))).first->second;
}

}  // namespace restlab
