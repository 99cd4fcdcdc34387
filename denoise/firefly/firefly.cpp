// Host side of `firefly`.
#include "denoise/firefly/firefly.h"

#include "core/frame/denoiser.h"
#include "denoise/common/settings.h"

namespace restlab {

const DenoiserInfo& fireflyDenoiserInfo();

const DenoiserInfo& fireflyDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "firefly";
    i.summary = "pixels brighter than all of their neighbours are darkened to them";
    i.biasOfStillView = BiasClass::biased;
    i.biasOfMovingView = BiasClass::biased;
    i.why = "a clamp takes energy away; it is counted as fireflies";
    i.comparesSquares = true;
    i.parameters = {
        {"firefly_radius",
         int64_t{1},
         1,
         8,
         {},
         "neighbours of a pixel: as far away, in pixels",
         "3x3 pixels, as is usual"},
        {"firefly_factor",
         1.0,
         0.0,
         1.0e6,
         {},
         "times the brightest neighbour's luminance, over reflectance: what a pixel may "
         "have",
         "1: rank-ordered, as is usual"},
        demodulateParameter()};
    i.inputs = {"radiance", "guide"};
    i.buffers = {{"firefly_shown", sizeof(glm::vec3), 0, -1}};
    i.passes = {{"firefly", "firefly", false}};
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::FireflyParams out{};
      out.radius = uintOf(p, "firefly_radius");
      out.factor = floatOf(p, "firefly_factor");
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
