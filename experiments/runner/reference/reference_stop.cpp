#include "experiments/runner/reference/reference_stop.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"

namespace restlab {

std::vector<DrawnLight> sampledLights(const PreparedScene& prepared,
                                      const ReferenceConfig& config) {
  // A method of a suite draws as it likes, or takes one sample of each light.
  const std::vector<std::string>& known = referenceIntegrators();
  const bool isOfMethod = std::find(known.begin(), known.end(), config.integrator) == known.end();
  const bool hasNone = isOfMethod || config.maxBounces == 0;
  return hasNone ? std::vector<DrawnLight>() : drawnLights(*prepared.scene);
}

bool ReferenceStop::isReached(const ReferenceState& state) const {
  ReferenceTarget bounds = target_;
  bounds.relmse = 0.0;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (targetReached(bounds, state.spp(), kUnknown, state.timeS, 0.0)) return true;
  if (state.checks.kept().empty()) return false;
  const RelmseCheck& last = state.checks.kept().back();
  const RareLights rare = rareLights(lights_, double(last.raysPath), double(last.spp));
  return targetReached(target_, last.spp, state.checks.sinceHalf(), state.timeS, rare.sppNeeded);
}

std::string ReferenceStop::note(const ReferenceState& state) const {
  const std::vector<RelmseCheck>& checks = state.checks.kept();
  if (checks.empty()) return "";
  const std::string relmse = fmt::format("relmse {:.3g}", checks.back().relmse);
  if (!(target_.relmse > 0.0 && state.checks.sinceHalf() <= target_.relmse)) return relmse;
  const RareLights rare = rareLights(lights_, double(state.health.raysPath), double(state.spp()));
  if (rare.lights.empty()) return relmse;
  return fmt::format("{}, {:.3g} of {:g} draws of '{}'", relmse, rare.fewestDraws,
                     kFewestLightDraws, oneLine(rare.lights.front().name));
}

}  // namespace restlab
