#include "denoise/common/settings.h"

namespace restlab {

ParameterInfo demodulateParameter() {
  return {"demodulate",
          std::string("all"),
          0,
          0,
          {"none", "diffuse", "all"},
          "reflectances that the radiance is divided by before it is filtered: none, the diffuse "
          "one, or that and the specular one at normal incidence",
          "Schied et al. 2017, section 4: textures stay sharp",
          true};
}

std::vector<ParameterInfo> filterParameters() {
  return {
      demodulateParameter(),
      {"edge_plane",
       0.02,
       1.0e-6,
       10.0,
       {},
       "distance of a neighbour from the pixel's plane, over that to the camera, at which it no "
       "longer counts",
       "measured: docs/denoising.md"},
      {"edge_normal",
       0.1,
       1.0e-6,
       2.0,
       {},
       "1 - cosine between normals, at which a neighbour no longer counts",
       "measured: docs/denoising.md"}};
}

rl::FilterEdges packFilterEdges(const ParameterMap& parameters) {
  return {floatOf(parameters, "edge_plane"), floatOf(parameters, "edge_normal")};
}

ParameterInfo deviationsParameter(const std::string& name, double defaultValue) {
  return {name + "_deviations",
          defaultValue,
          1.0e-3,
          1.0e6,
          {},
          "standard deviations that mean luminances around two pixels may differ by",
          "measured: docs/denoising.md"};
}

ParameterInfo iterationsParameter(const std::string& name, int64_t defaultValue,
                                  const std::string& source) {
  return {name + "_iterations",
          defaultValue,
          0,
          kMostIterations,
          {},
          "wavelet iterations; iteration i reaches 2^i pixels to each side",
          source,
          true};
}

}  // namespace restlab
