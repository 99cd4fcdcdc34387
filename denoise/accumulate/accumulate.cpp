// Host side of `accumulate`.
#include "denoise/accumulate/accumulate.h"

#include "core/frame/denoiser.h"
#include "core/frame/frame_graph.h"
#include "core/frame/schema.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

const DenoiserInfo& accumulateDenoiserInfo();

namespace {

struct AccumulateSettings {
  double cap = 20.0;
  std::string filter = "bilinear";
  double minNormalDot = 0.9;
  double maxPlaneDistance = 0.05;
};

const Schema<AccumulateSettings>& schema() {
  static const Schema<AccumulateSettings> all = {
      Parameter<AccumulateSettings>(
          &AccumulateSettings::cap, "accumulate_cap", Range{0.0, 1.0e6},
          "frames that a history may weigh; the weight of a new frame is 1 / (this + 1) at least",
          "the confidence cap of reservoirs: Lin et al. 2022"),
      Parameter<AccumulateSettings>(&AccumulateSettings::filter, "accumulate_filter",
                                    Choices{"nearest", "bilinear"},
                                    "how the history is read where the camera has moved",
                                    "measured: docs/decisions/bilinear-history.md"),
      Parameter<AccumulateSettings>(
          &AccumulateSettings::minNormalDot, "accumulate_normal_threshold", Range{-1.0, 1.0},
          "least cosine between the normals of a pixel and its history", "as of the pixel cache"),
      Parameter<AccumulateSettings>(
          &AccumulateSettings::maxPlaneDistance, "accumulate_plane_threshold", Range{0.0, 10.0},
          "largest distance from each other's plane over the distance to the camera",
          "as of the pixel cache")};
  return all;
}

void recordAccumulate(FrameGraph& g, const FrameInfo& f) {
  const AccumulateSettings settings = schema().read(f.parameters);
  rl::AccumulateParams params{};
  params.cap = float(settings.cap);
  params.similarity = {float(settings.minNormalDot), float(settings.maxPlaneDistance)};
  if (settings.filter == "bilinear") params.flags |= rl::RL_ACCUMULATE_BILINEAR;
  params.changes = packChanges(f.parameters);
  const FrameBuffers& s = g.shared;
  const Buffer shown = g.buffer("accumulated", f.pixels, sizeof(glm::vec3));
  const History history = g.advance(g.history("accumulate_history", f.pixels, 16));
  g.kernels<rl::AccumulateBuffers>(params, {s.radiance, s.surfaces.now, s.surfaces.previous,
                                            s.changes, shown, history.now, history.previous})
      .pass("accumulate", "accumulate")
      .reads({s.radiance, s.surfaces.now, s.surfaces.previous, s.changes, history.previous})
      .writes({shown, history.now});
  g.shared.shown = shown;
}

}  // namespace

const DenoiserInfo& accumulateDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "accumulate";
    i.summary = "the exponential average of the frames that show the same surface";
    i.biasOfStillView = BiasClass::unbiased;
    i.biasOfMovingView = BiasClass::biased;
    i.why =
        "still view: the weights depend on the frame's number alone; moving: radiance lags behind "
        "where it changes with the view, and at edges; reading between pixels blurs";
    i.parameters = schema().infos();
    i.reasonUnused = [](const std::string& name, const ParameterMap& p) {
      const bool isOfHistory = name.starts_with("accumulate_") && name != "accumulate_cap";
      return isOfHistory && schema().read(p).cap == 0.0 ? "accumulate_cap is 0" : "";
    };
    i.needsSurfaces = true;
    i.followsChanges = true;
    i.record = recordAccumulate;
    i.hasHistory = true;
    // accumulate_cap counts from the first whole average on (accumulate.glsl).
    i.shownFrames = [](const ParameterMap& p, double radianceFrames) {
      return radianceFrames + schema().read(p).cap;
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
