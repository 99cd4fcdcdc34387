#include "core/frame/host_filter.h"

#include <bit>
#include <chrono>
#include <cstring>

#include "core/base/packing.h"
#include "core/frame/pipeline.h"
#include "core/frame/session.h"
#include "core/gbuffer/guide_data.h"

namespace restlab {

namespace {

float number(uint32_t word) { return std::bit_cast<float>(word); }

}  // namespace

Image filterOnHost(const HostFilter& filter, const std::string& name, Pipeline& pipeline,
                   uint32_t width, uint32_t height, FrameStats& stats) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<uint32_t> radiance = pipeline.words(pipeline.graph().shared.radiance);
  const std::vector<uint32_t> guides = pipeline.words(pipeline.graph().shared.features.now);
  HostFrame frame = {Image(width, height), Image(width, height), Image(width, height)};
  const size_t pixels = frame.radiance.pixels.size();
  std::memcpy(frame.radiance.pixels.data(), radiance.data(), pixels * sizeof(glm::vec3));
  std::vector<bool> isLight(pixels);
  rl::Packing packing;
  for (size_t p = 0; p < pixels; ++p) {
    if (!packing.rlIsFinite3(frame.radiance.pixels[p])) {
      ++stats.health.counts[rl::RL_HEALTH_NONFINITE];
      frame.radiance.pixels[p] = glm::vec3(0.0f);
    }
    // Unpack the words as guideWrite() packs them (core/gbuffer/guide_data.glsl).
    const uint32_t* guide = guides.data() + 4 * rl::RL_GUIDE_UVEC4S * p;
    frame.normalW.pixels[p] = {number(guide[0]), number(guide[1]), number(guide[2])};
    isLight[p] = !(number(guide[3]) > 0.0f);
    frame.albedo.pixels[p] = packing.unpackPositive3(guide[6], guide[7]);
  }
  Image shown = filter(frame);
  for (size_t p = 0; p < pixels; ++p) {
    if (isLight[p]) shown.pixels[p] = frame.radiance.pixels[p];
  }
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  stats.passes.push_back({name, spent.count(), 0, 0});
  stats.timeMs += spent.count();
  return shown;
}

}  // namespace restlab
