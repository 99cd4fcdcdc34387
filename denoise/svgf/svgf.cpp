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

struct SvgfSettings {
  uint32_t iterations = 5;
  double cap = 20.0;
  double deviations = 1.0;
  bool feedback = false;
  std::string variance = "moments";
  bool confidence = false;
  double turn = 0.25;
  double resolve = 4.0;
};

const Schema<SvgfSettings>& schema() {
  static const Schema<SvgfSettings> all = {
      iterationsParameter(&SvgfSettings::iterations, "svgf_iterations",
                          "Schied et al. 2017, section 4.4"),
      Parameter<SvgfSettings>(
          &SvgfSettings::cap, "svgf_cap", Range{0.0, 1.0e6},
          "frames that a history may weigh; the weight of a new frame is 1 / (this + 1) at least",
          "measured: docs/denoising.md (Schied et al. 2017: 4)"),
      deviationsParameter(&SvgfSettings::deviations, "svgf_deviations"),
      Parameter<SvgfSettings>(
          &SvgfSettings::feedback, "svgf_feedback",
          "the history keeps the result of the first iteration, not the mean of frames",
          "measured: docs/denoising.md (Schied et al. 2017, section 4.1: true)")
          .beginsHistory(),
      Parameter<SvgfSettings>(
          &SvgfSettings::variance, "svgf_variance", Choices{"moments", "differences", "space"},
          "what the variance is estimated by: frames as if they shared no samples; differences of "
          "frames, which knows that they do; neighbours",
          "measured: docs/denoising.md"),
      Parameter<SvgfSettings>(
          &SvgfSettings::confidence, "svgf_confidence",
          "frames that the radiance averages itself, as reservoirs tell, are not averaged again",
          "measured: docs/denoising.md"),
      Parameter<SvgfSettings>(
          &SvgfSettings::turn, "svgf_turn", Range{0.0, 1.0e6},
          "share of a glossy history that is forgotten when the view turns by the width of "
          "its lobe; 0: none",
          "measured: docs/denoising.md"),
      Parameter<SvgfSettings>(
          &SvgfSettings::resolve, "svgf_resolve", Range{0.0, 1.0e6},
          "frames of a moving view that what is shown may average, by what pixels show at "
          "their centres; 0: it averages none",
          "measured: docs/denoising.md (temporal antialiasing: Schied et al. 2017, section 4)")
          .beginsHistory()
          .needs("gbuffer")};
  return all;
}

std::vector<ParameterInfo> parametersOf(const SvgfDefaults& defaults) {
  SvgfSettings settings;
  settings.variance = defaults.variance;
  settings.confidence = defaults.confidence;
  std::vector<ParameterInfo> all = schema().infos(settings);
  append(all, filterParameters());
  return all;
}

rl::SvgfParams packed(const ParameterMap& parameters) {
  const SvgfSettings s = schema().read(parameters);
  rl::SvgfParams out{};
  out.iterations = s.iterations;
  out.cap = float(s.cap);
  out.deviations = float(s.deviations);
  out.edges = packFilterEdges(parameters);
  if (s.feedback) out.flags |= rl::RL_SVGF_FEEDBACK;
  if (s.confidence) out.flags |= rl::RL_SVGF_CONFIDENCE;
  if (s.variance == "differences") out.flags |= rl::RL_SVGF_DIFFERENCES;
  if (s.variance == "space") out.flags |= rl::RL_SVGF_SPACE;
  out.changes = packChanges(parameters);
  out.lobeRotationResponse = float(s.turn);
  out.resolveCap = float(s.resolve);
  out.resolveTest = {0.9f, 0.05f};  // the values of `accumulate` and the pixel cache
  return out;
}

void recordSvgf(FrameGraph& g, const FrameInfo& f) {
  rl::SvgfParams params = packed(f.parameters);
  const FrameBuffers& s = g.shared;
  if (s.radianceFrames) params.flags |= rl::RL_SVGF_EFFECTIVE;
  const Buffer features = s.features.now;
  const Buffer shown = g.buffer("svgf_shown", f.pixels, sizeof(glm::vec3));
  const Buffer even = g.buffer("svgf_even", f.pixels, 16);
  const Buffer odd = g.buffer("svgf_odd", f.pixels, 16);
  const Buffer around = g.buffer("svgf_around", f.pixels, sizeof(glm::vec2));
  const History history =
      g.advance(g.history("svgf_history", f.pixels, 16 * rl::RL_SVGF_HISTORY_UVEC4S));
  const History resolved = g.advance(g.history("svgf_resolved", f.pixels, 16));
  const auto kernels = [&] {
    return g.kernels<rl::SvgfBuffers>(
        params, {s.radiance, features, s.features.previous, s.motion, s.radianceFrames, s.changes,
                 s.surfaces.now, s.surfaces.previous, shown, even, odd, around, history.now,
                 history.previous, resolved.now, resolved.previous});
  };
  kernels()
      .pass("svgf_temporal", "svgf_temporal")
      .reads({s.radiance, features, s.features.previous, s.motion, s.radianceFrames, s.changes,
              history.previous})
      .writes({history.now});
  kernels()
      .pass("svgf_variance", "svgf_variance")
      .reads({history.now, features, s.radianceFrames})
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
              s.surfaces.now, s.surfaces.previous, resolved.previous})
      .writes({shown, resolved.now});
  g.shared.shown = shown;
}

std::string whySvgfUnused(const std::string& name, const ParameterMap& parameters) {
  const SvgfSettings s = schema().read(parameters);
  const bool isOfIterations =
      name == "svgf_deviations" || name == "svgf_variance" || name == "svgf_feedback";
  if (isOfIterations && s.iterations == 0) return "svgf_iterations is 0";
  // Only a method with such a cap shows means of frames.
  if (name == "svgf_confidence" && !parameters.contains("confidence_cap"))
    return "frames of the integrator average none";
  return "";
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
  i.reasonUnused = whySvgfUnused;
  i.comparesSquares = true;
  i.needsFeatures = true;
  i.followsChanges = true;
  i.record = recordSvgf;
  i.readsRadianceFrames = true;
  i.hasHistory = true;
  i.shownFrames = [](const ParameterMap& p, double radianceFrames) {
    return radianceFrames + schema().read(p).cap;
  };
  return i;
}

const DenoiserInfo& svgfDenoiserInfo() {
  static const DenoiserInfo info = makeSvgf(
      {"svgf", "frames averaged over time, then wavelets guided by their variance", "moments"});
  return info;
}

}  // namespace restlab
