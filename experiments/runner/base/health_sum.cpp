#include "experiments/runner/base/health_sum.h"

#include <fmt/format.h>

namespace restlab {

bool isFault(size_t count) {
  return count == rl::RL_HEALTH_NONFINITE || count == rl::RL_HEALTH_DROPPED_WEIGHTS;
}

void HealthSum::add(const FrameStats& frame) {
  for (size_t i = 0; i < health.counts.size(); ++i) health.counts[i] += frame.health.counts[i];
  raysPath += frame.raysPath;
  raysShadow += frame.raysShadow;
}

void HealthSum::add(const HealthSum& sum) {
  for (size_t i = 0; i < health.counts.size(); ++i) health.counts[i] += sum.health.counts[i];
  raysPath += sum.raysPath;
  raysShadow += sum.raysShadow;
}

std::string HealthSum::text() const {
  std::string text;
  for (size_t i = 0; i < health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (!name || !*name) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, health.counts[i]);
  }
  return text;
}

}  // namespace restlab
