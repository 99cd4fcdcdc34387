#include "experiments/runner/run/block_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/radiance_range.h"
#include "core/frame/method.h"
#include "experiments/runner/reference/light_draws.h"
#include "experiments/runner/run/block_label.h"

namespace restlab {

std::vector<std::string> warningsOf(const Suite& suite, const PreparedScene& prepared,
                                    const BlockResult& block) {
  const Image& reference = block.reference.mean;
  std::vector<std::string> lines;
  const auto say = [&](const std::string& what) {
    const std::string line = fmt::format("{}: {}", blockLabel(suite, block), what);
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  };
  // For example a camera that has left the room. Without light in the image no row means anything.
  if (std::all_of(reference.pixels.begin(), reference.pixels.end(),
                  [](const glm::vec3& p) { return p == glm::vec3(0.0f); }))
    say("its reference is black; its rows say nothing");
  if (const std::string why = whyNotConverged(block.reference); !why.empty()) {
    const bool isTarget = suite.target.relmse > 0.0;
    const std::string draws = block.reference.metadata.at("fewest_light_draws");
    if (isTarget || std::strtod(draws.c_str(), nullptr) < kHardlyDrawn)
      say(fmt::format("its reference {}: {}",
                      isTarget ? "is not converged" : "may lack the light of what was hardly drawn",
                      why));
  }
  if (block.motion) {
    for (const std::string& line : cameraPathWarnings(prepared.scene->source(), *block.motion,
                                                      suite.warmupFrames + suite.timedFrames))
      say(line);
  }
  for (const SuiteMethod& method : suite.rendered()) {
    const std::string why = whyOutsideRange(*findMethod(method.session).denoiser, reference);
    if (!why.empty()) say(why);
  }
  return lines;
}

}  // namespace restlab
