#include "core/frame/frame_stats.h"

namespace restlab {

const std::array<const char*, rl::RL_HEALTH_COUNT>& Health::names() {
  static const std::array<const char*, rl::RL_HEALTH_COUNT> names = {
      "nonfinite", "rejected_jacobian", "capped_confidence", "delta_lobes",   "unreusable_pixels",
      "negative",  "dropped_weights",   "cache_full",        "light_changed", "new_history",
      "fireflies", "long_walks",        "ray_segments",      "loops_cut"};
  return names;
}

const std::array<const char*, rl::RL_HEALTH_COUNT>& Health::meanings() {
  static const std::array<const char*, rl::RL_HEALTH_COUNT> meanings = {
      "non-finite channel values in measured frames; sample values set to zero; reservoirs emptied "
      "for such a value. Always a fault",
      "shifts outside max_jacobian, undefined in both directions: unbiased",
      "donors whose confidence was cut to confidence_cap or moving_confidence_cap: every pixel "
      "of a long history",
      "hits on roughness so small that a mirror was drawn",
      "first hits that no other pixel can use: mirrors, glass, roughness below roughness_limit",
      "pixels with a negative channel, which control variates leave: clamping them would be bias",
      "resampling weights that were no finite, non-negative number. Always a fault",
      "surfaces that found no place in a cache: more entries or radiance_entries help",
      "cells of radiance whose kept path found other light than before: the cell begins anew",
      "pixels of accumulate, svgf and its kin that no pixel of the last frame has shown",
      "pixels that firefly has darkened: it takes their energy away",
      "paths that were ended after 1023 collisions inside a body, with more than 1e-4 of their "
      "throughput left: that light is missing",
      "rays that met 384 segments of an implicit surface and took the rest as one: they may miss a "
      "place where it is crossed twice",
      "pixels of passes on lavapipe whose loops took 65535 turns or more, by groups of 8: the "
      "driver "
      "ends all loops there, and what they would have found is missing"};
  return meanings;
}

FrameStats statsOf(const std::vector<Pipeline::PassResult>& passes) {
  FrameStats stats;
  for (const Pipeline::PassResult& pass : passes) {
    stats.passes.push_back(
        {pass.name, pass.timeMs, pass.counters.raysPath, pass.counters.raysShadow, pass.isOnce});
    for (size_t k = 0; k < stats.health.counts.size(); ++k)
      stats.health.counts[k] += pass.counters.health[k];
    if (pass.isOnce) {
      stats.sceneMs += pass.timeMs;
      continue;
    }
    stats.timeMs += pass.timeMs;
    stats.raysPath += pass.counters.raysPath;
    stats.raysShadow += pass.counters.raysShadow;
  }
  return stats;
}

}  // namespace restlab
