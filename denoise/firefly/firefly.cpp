// Host side of `firefly`.
#include "denoise/firefly/firefly.h"

#include "core/frame/denoiser.h"
#include "core/frame/frame_graph.h"
#include "denoise/common/settings.h"

namespace restlab {

const DenoiserInfo& fireflyDenoiserInfo();

namespace {

struct FireflySettings {
  uint32_t radius = 1;
  double factor = 1.0;
};

const Schema<FireflySettings>& schema() {
  static const Schema<FireflySettings> all = {
      Parameter<FireflySettings>(&FireflySettings::radius, "firefly_radius", Range{1, 8},
                                 "neighbours of a pixel: as far away, in pixels",
                                 "3x3 pixels, as is usual"),
      Parameter<FireflySettings>(
          &FireflySettings::factor, "firefly_factor", Range{0.0, 1.0e6},
          "times the brightest neighbour's luminance, over reflectance: what a pixel may "
          "have",
          "1: rank-ordered, as is usual")};
  return all;
}

void recordFirefly(FrameGraph& g, const FrameInfo& f) {
  const FireflySettings s = schema().read(f.parameters);
  const rl::FireflyParams params{s.radius, float(s.factor)};
  const Buffer radiance = g.shared.radiance, features = g.shared.features.now;
  const Buffer shown = g.buffer("firefly_shown", f.pixels, sizeof(glm::vec3));
  g.kernels<rl::FireflyBuffers>(params, {radiance, features, shown})
      .pass("firefly", "firefly")
      .reads({radiance, features})
      .writes({shown});
  g.shared.shown = shown;
}

}  // namespace

const DenoiserInfo& fireflyDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "firefly";
    i.summary = "pixels brighter than all of their neighbours are darkened to them";
    i.biasOfStillView = BiasClass::biased;
    i.biasOfMovingView = BiasClass::biased;
    i.why = "a clamp takes energy away; it is counted as fireflies";
    i.comparesSquares = true;
    i.parameters = schema().infos();
    append(i.parameters, demodulateSchema().infos());
    i.needsFeatures = true;
    i.record = recordFirefly;
    return i;
  }();
  return info;
}

}  // namespace restlab
