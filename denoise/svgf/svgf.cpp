// Host side of `svgf`.
#include "denoise/svgf/svgf.h"

#include <algorithm>

#include "core/temporal_gradients/settings.h"
#include "denoise/common/settings.h"
#include "denoise/svgf/svgf_info.h"

namespace restlab {

const DenoiserInfo& svgfDenoiserInfo();

namespace {

std::vector<ParameterInfo> parametersOf(const SvgfDefaults& defaults) {
  std::vector<ParameterInfo> all = {
      iterationsParameter("svgf", 5, "Schied et al. 2017, section 4.4"),
      {"svgf_cap",
       20.0,
       0.0,
       1.0e6,
       {},
       "frames that a history may weigh; the weight of a new frame is 1 / (this + 1) at least",
       "measured: docs/denoising.md (Schied et al. 2017: 4)"},
      deviationsParameter("svgf", 1.0),
      {"svgf_feedback",
       false,
       0,
       0,
       {},
       "the history keeps the result of the first iteration, not the mean of frames",
       "measured: docs/denoising.md (Schied et al. 2017, section 4.1: true)",
       true},
      {"svgf_variance",
       defaults.variance,
       0,
       0,
       {"moments", "differences", "space"},
       "what the variance is estimated by: frames as if they shared no samples; differences of "
       "frames, which knows that they do; neighbours",
       "measured: docs/denoising.md"},
      {"svgf_confidence",
       defaults.confidence,
       0,
       0,
       {},
       "frames that the radiance averages itself, as reservoirs tell, are not averaged again",
       "measured: docs/denoising.md"}};
  all.push_back({"svgf_turn",
                 0.25,
                 0.0,
                 1.0e6,
                 {},
                 "share of a glossy history that is forgotten when the view turns by the width of "
                 "its lobe; 0: none",
                 "measured: docs/denoising.md"});
  // A change of this parameter resets the history: an average that was not written is stale.
  all.push_back(
      {"svgf_resolve",
       4.0,
       0.0,
       1.0e6,
       {},
       "frames of a moving view that what is shown may average, by what pixels show at "
       "their centres; 0: it averages none",
       "measured: docs/denoising.md (temporal antialiasing: Schied et al. 2017, section 4)",
       true,
       "visible"});
  for (ParameterInfo& parameter : filterParameters()) all.push_back(std::move(parameter));
  return all;
}

// Confidence that a reservoir may have from the pixel's own last frame: in a still view and in a
// new view; below 0 if there are no reservoirs.
struct DonorCaps {
  float still = -1.0f, moving = -1.0f;
};
DonorCaps donorCaps(const ParameterMap& p) {
  if (!p.contains("confidence_cap")) return {};
  if (!std::get<bool>(p.at("temporal"))) return {0.0f, 0.0f};
  const float still = floatOf(p, "confidence_cap");
  const bool isFollowed = std::get<bool>(p.at("reproject"));
  return {still, isFollowed ? std::min(still, floatOf(p, "moving_confidence_cap")) : 0.0f};
}

std::vector<std::byte> pack(const std::string&, const ParameterMap& p) {
  rl::SvgfParams out{};
  out.iterations = uintOf(p, "svgf_iterations");
  out.cap = floatOf(p, "svgf_cap");
  out.deviations = floatOf(p, "svgf_deviations");
  out.edges = packFilterEdges(p);
  if (std::get<bool>(p.at("svgf_feedback"))) out.flags |= rl::RL_SVGF_FEEDBACK;
  if (std::get<bool>(p.at("svgf_confidence"))) {
    out.flags |= rl::RL_SVGF_CONFIDENCE;
    const DonorCaps caps = donorCaps(p);
    out.donorCap = caps.still;
    out.movingDonorCap = caps.moving;
  }
  const std::string& variance = std::get<std::string>(p.at("svgf_variance"));
  if (variance == "differences") out.flags |= rl::RL_SVGF_DIFFERENCES;
  if (variance == "space") out.flags |= rl::RL_SVGF_SPACE;
  out.changes = packChanges(p);
  out.lobeRotationResponse = floatOf(p, "svgf_turn");
  out.resolveCap = floatOf(p, "svgf_resolve");
  out.resolveTest = {0.9f, 0.05f};  // the values of `accumulate` and the pixel cache
  return bytesOf(out);
}

}  // namespace

DenoiserInfo makeSvgf(const SvgfDefaults& defaults) {
  DenoiserInfo i;
  i.name = defaults.name;
  i.summary = defaults.summary;
  i.biasOfStillView = BiasClass::biased;
  i.biasOfMovingView = BiasClass::biased;
  i.why =
      "light is averaged over neighbours on like surfaces, and over frames where it may have "
      "changed";
  i.parameters = parametersOf(defaults);
  if (defaults.validateEvery != 0) i.defaults[kValidateEvery] = defaults.validateEvery;
  i.comparesSquares = true;
  i.inputs = {"radiance", "guide", "guide_before", "motion"};
  i.optionalInputs = {"reservoir_history", kChanges, "visible", "visible_before"};
  const uint32_t historyBytes = 16 * rl::RL_SVGF_HISTORY_QUADS;
  i.buffers = {{"svgf_shown", sizeof(glm::vec3), 0, -1},
               {"svgf_even", 16, 0, -1},
               {"svgf_odd", 16, 0, -1},
               {"svgf_around", sizeof(glm::vec2), 0, -1},
               {"svgf_history", historyBytes, 0, 5},
               {"svgf_history_before", historyBytes, 0, 4},
               {"svgf_resolved", 16, 0, 7},
               {"svgf_resolved_before", 16, 0, 6}};
  i.passes = {{"svgf_temporal", "svgf_temporal", false}, {"svgf_variance", "svgf_variance", false}};
  for (PassInfo& pass : waveletPasses("svgf", "svgf_iterations")) i.passes.push_back(pass);
  i.passes.push_back({"svgf_end", "svgf_end", false});
  i.hasHistory = true;
  i.shownFrames = [](const ParameterMap& p, double radianceFrames) {
    return radianceFrames + std::get<double>(p.at("svgf_cap"));
  };
  i.packParameters = pack;
  return i;
}

const DenoiserInfo& svgfDenoiserInfo() {
  static const DenoiserInfo info = makeSvgf(
      {"svgf", "frames averaged over time, then wavelets guided by their variance", "moments"});
  return info;
}

}  // namespace restlab
