// Host side of `atrous`.
#include "denoise/atrous/atrous.h"

#include "core/frame/denoiser.h"
#include "denoise/common/settings.h"

namespace restlab {

const DenoiserInfo& atrousDenoiserInfo();

const DenoiserInfo& atrousDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "atrous";
    i.summary = "edge-avoiding wavelets over the frame alone, without a history";
    i.biasOfStillView = BiasClass::biased;
    i.biasOfMovingView = BiasClass::biased;
    i.why = "light is averaged over neighbours on like surfaces";
    i.parameters = {iterationsParameter("atrous", 5, "Dammertz et al. 2010, section 3"),
                    deviationsParameter("atrous", 3.0)};
    for (ParameterInfo& parameter : filterParameters()) i.parameters.push_back(parameter);
    i.comparesSquares = true;
    i.inputs = {"radiance", "guide"};
    i.buffers = {{"atrous_shown", sizeof(glm::vec3), 0, -1},
                 {"atrous_even", 16, 0, -1},
                 {"atrous_odd", 16, 0, -1},
                 {"atrous_around", sizeof(glm::vec2), 0, -1}};
    i.passes = {{"atrous_begin", "atrous_begin", false}, {"atrous_around", "atrous_around", false}};
    for (PassInfo& pass : waveletPasses("atrous", "atrous_iterations"))
      i.passes.push_back(std::move(pass));
    i.passes.push_back({"atrous_end", "atrous_end", false});
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::AtrousParams out{};
      out.iterations = uintOf(p, "atrous_iterations");
      out.deviations = floatOf(p, "atrous_deviations");
      out.edges = packFilterEdges(p);
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
