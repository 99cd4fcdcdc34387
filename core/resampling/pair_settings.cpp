#include "core/resampling/pair_settings.h"

#include <cmath>

#include "core/frame/schema.h"

namespace restlab {

namespace {

struct PairSettings {
  double radius = 3.0;
  double minNormalDot = 0.9;
  double maxPlaneDistance = 0.05;
};

const Schema<PairSettings>& schema() {
  static const Schema<PairSettings> all = {
      Parameter<PairSettings>(
          &PairSettings::radius, "spatial_radius", Range{1.5, 256.0},
          "pixels; donors come from a square tile that spreads them as a disk of this radius would",
          "near donors differ least where histories are old; Bitterli et al. 2020 use 30"),
      Parameter<PairSettings>(&PairSettings::minNormalDot, "normal_threshold", Range{-1.0, 1.0},
                              "least cosine between the normals of two pixels' surfaces",
                              "Bitterli et al. 2020: 25 degrees = 0.906"),
      Parameter<PairSettings>(&PairSettings::maxPlaneDistance, "plane_threshold", Range{0.0, 10.0},
                              "largest distance from each other's plane over the camera distance",
                              "Bitterli et al. 2020 compare depths at 10 %")};
  return all;
}

}  // namespace

std::vector<ParameterInfo> pairParameters() { return schema().infos(); }

rl::SimilarityThresholds packSimilarity(const ParameterMap& parameters) {
  const PairSettings s = schema().read(parameters);
  return {float(s.minNormalDot), float(s.maxPlaneDistance)};
}

rl::PairParams packPairs(const ParameterMap& parameters) {
  // The root mean square distance of two points of a square of side s is s / sqrt(3), that of a
  // point of a disk to its centre r / sqrt(2).
  const double side = std::sqrt(1.5) * schema().read(parameters).radius;
  return {static_cast<uint32_t>(std::lround(side)), packSimilarity(parameters)};
}

}  // namespace restlab
