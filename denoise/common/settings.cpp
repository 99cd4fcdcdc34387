#include "denoise/common/settings.h"

namespace restlab {

namespace {

const Schema<EdgeSettings>& edgeSchema() {
  static const Schema<EdgeSettings> all = {
      Parameter<EdgeSettings>(
          &EdgeSettings::plane, "edge_plane", Range{1.0e-6, 10.0},
          "distance of a neighbour from the pixel's plane, over that to the camera, at which it no "
          "longer counts",
          "measured: docs/denoising.md"),
      Parameter<EdgeSettings>(&EdgeSettings::normal, "edge_normal", Range{1.0e-6, 2.0},
                              "1 - cosine between normals, at which a neighbour no longer counts",
                              "measured: docs/denoising.md")};
  return all;
}

}  // namespace

const Schema<DemodulateSettings>& demodulateSchema() {
  static const Schema<DemodulateSettings> all = {
      Parameter<DemodulateSettings>(
          &DemodulateSettings::demodulate, "demodulate", Choices{"none", "diffuse", "all"},
          "reflectances that the radiance is divided by before it is filtered: none, the diffuse "
          "one, or that and the specular one at normal incidence",
          "Schied et al. 2017, section 4: textures stay sharp")
          .beginsHistory()};
  return all;
}

std::vector<ParameterInfo> filterParameters() {
  std::vector<ParameterInfo> all = demodulateSchema().infos();
  append(all, edgeSchema().infos());
  return all;
}

rl::FilterEdges packFilterEdges(const ParameterMap& parameters) {
  const EdgeSettings s = edgeSchema().read(parameters);
  return {float(s.plane), float(s.normal)};
}

}  // namespace restlab
