// Host side of `atrous`.
#include "denoise/atrous/atrous.h"

#include "core/frame/denoiser.h"
#include "core/frame/frame_graph.h"
#include "denoise/common/settings.h"

namespace restlab {

const DenoiserInfo& atrousDenoiserInfo();

namespace {

struct AtrousSettings {
  uint32_t iterations = 5;
  double deviations = 3.0;
};

const Schema<AtrousSettings>& schema() {
  static const Schema<AtrousSettings> all = {
      iterationsParameter(&AtrousSettings::iterations, "atrous_iterations",
                          "Dammertz et al. 2010, section 3"),
      deviationsParameter(&AtrousSettings::deviations, "atrous_deviations")};
  return all;
}

void recordAtrous(FrameGraph& g, const FrameInfo& f) {
  const AtrousSettings s = schema().read(f.parameters);
  rl::AtrousParams params{};
  params.iterations = s.iterations;
  params.deviations = float(s.deviations);
  params.edges = packFilterEdges(f.parameters);
  const Buffer radiance = g.shared.radiance, features = g.shared.features.now;
  const Buffer shown = g.buffer("atrous_shown", f.pixels, sizeof(glm::vec3));
  const Buffer even = g.buffer("atrous_even", f.pixels, 16);
  const Buffer odd = g.buffer("atrous_odd", f.pixels, 16);
  const Buffer around = g.buffer("atrous_around", f.pixels, sizeof(glm::vec2));
  const auto kernels = [&] {
    return g.kernels<rl::AtrousBuffers>(params, {radiance, features, shown, even, odd, around});
  };
  kernels().pass("atrous_begin", "atrous_begin").reads({radiance, features}).writes({even});
  kernels().pass("atrous_around", "atrous_around").reads({even, features}).writes({around});
  for (params.step = 0; params.step < params.iterations; ++params.step) {
    const bool isEven = params.step % 2 == 0;
    kernels()
        .pass(iterationName("atrous", params.step), "atrous")
        .reads({isEven ? even : odd, features, around})
        .writes({isEven ? odd : even});
  }
  const Buffer last = params.iterations % 2 == 0 ? even : odd;
  kernels().pass("atrous_end", "atrous_end").reads({last, features}).writes({shown});
  g.shared.shown = shown;
}

std::string whyAtrousUnused(const std::string& name, const ParameterMap& parameters) {
  const bool isOfIterations = name == "atrous_deviations" || name.starts_with("edge_");
  const bool isOff = schema().read(parameters).iterations == 0;
  return isOfIterations && isOff ? "atrous_iterations is 0" : "";
}

}  // namespace

const DenoiserInfo& atrousDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "atrous";
    i.summary = "edge-avoiding wavelets over the frame alone, without a history";
    i.biasOfStillView = BiasClass::biased;
    i.biasOfMovingView = BiasClass::biased;
    i.why = "light is averaged over neighbours on like surfaces";
    i.parameters = schema().infos();
    append(i.parameters, filterParameters());
    i.reasonUnused = whyAtrousUnused;
    i.comparesSquares = true;
    i.needsFeatures = true;
    i.record = recordAtrous;
    return i;
  }();
  return info;
}

}  // namespace restlab
