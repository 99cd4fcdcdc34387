// Host side of `svgf`.
#include "denoise/svgf/svgf.h"

#include <algorithm>

#include "core/frame/frame_graph.h"
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

rl::SvgfParams packed(const ParameterMap& p) {
  rl::SvgfParams out{};
  out.iterations = uintOf(p, "svgf_iterations");
  out.cap = floatOf(p, "svgf_cap");
  out.deviations = floatOf(p, "svgf_deviations");
  out.edges = packFilterEdges(p);
  if (std::get<bool>(p.at("svgf_feedback"))) out.flags |= rl::RL_SVGF_FEEDBACK;
  if (boolOf(p, "svgf_confidence")) out.flags |= rl::RL_SVGF_CONFIDENCE;
  const std::string& variance = std::get<std::string>(p.at("svgf_variance"));
  if (variance == "differences") out.flags |= rl::RL_SVGF_DIFFERENCES;
  if (variance == "space") out.flags |= rl::RL_SVGF_SPACE;
  out.changes = packChanges(p);
  out.lobeRotationResponse = floatOf(p, "svgf_turn");
  out.resolveCap = floatOf(p, "svgf_resolve");
  out.resolveTest = {0.9f, 0.05f};  // the values of `accumulate` and the pixel cache
  return out;
}

void recordSvgf(FrameGraph& g, const FrameInfo& f) {
  rl::SvgfParams params = packed(f.parameters);
  const FrameBuffers& s = g.shared;
  if (s.effectiveSamples) params.flags |= rl::RL_SVGF_EFFECTIVE;
  const Buffer features = s.features.now;
  const Buffer shown = g.buffer("svgf_shown", f.pixels, sizeof(glm::vec3));
  const Buffer even = g.buffer("svgf_even", f.pixels, 16);
  const Buffer odd = g.buffer("svgf_odd", f.pixels, 16);
  const Buffer around = g.buffer("svgf_around", f.pixels, sizeof(glm::vec2));
  const History history =
      g.advance(g.history("svgf_history", f.pixels, 16 * rl::RL_SVGF_HISTORY_QUADS));
  const History resolved = g.advance(g.history("svgf_resolved", f.pixels, 16));
  const auto kernels = [&] {
    return g.kernels<rl::SvgfBuffers>(
        params, {s.radiance, features, s.features.before, s.motion, s.effectiveSamples, s.changes,
                 s.surfaces.now, s.surfaces.before, shown, even, odd, around, history.now,
                 history.before, resolved.now, resolved.before});
  };
  kernels()
      .pass("svgf_temporal", "svgf_temporal")
      .reads({s.radiance, features, s.features.before, s.motion, s.effectiveSamples, s.changes,
              history.before})
      .writes({history.now});
  kernels()
      .pass("svgf_variance", "svgf_variance")
      .reads({history.now, features, s.motion, s.effectiveSamples})
      .writes({around, even});
  for (params.step = 0; params.step < params.iterations; ++params.step) {
    const bool isEven = params.step % 2 == 0;
    GraphPass& pass = kernels()
                          .pass(iterationName("svgf", params.step), "svgf")
                          .reads({isEven ? even : odd, features, around})
                          .writes({isEven ? odd : even});
    const bool feedsBack = params.step == 0 && (params.flags & rl::RL_SVGF_FEEDBACK) != 0;
    if (feedsBack) pass.updates({history.now});
  }
  kernels()
      .pass("svgf_end", "svgf_end")
      .reads({params.iterations % 2 == 0 ? even : odd, features, s.motion, s.changes,
              s.surfaces.now, s.surfaces.before, resolved.before})
      .writes({shown, resolved.now});
  g.shared.shown = shown;
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
  i.needsFeatures = true;
  i.followsChanges = true;
  i.record = recordSvgf;
  i.readsEffectiveSamples = true;
  i.hasHistory = true;
  i.shownFrames = [](const ParameterMap& p, double radianceFrames) {
    return radianceFrames + std::get<double>(p.at("svgf_cap"));
  };
  return i;
}

const DenoiserInfo& svgfDenoiserInfo() {
  static const DenoiserInfo info = makeSvgf(
      {"svgf", "frames averaged over time, then wavelets guided by their variance", "moments"});
  return info;
}

}  // namespace restlab
