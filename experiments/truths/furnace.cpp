#include "experiments/truths/furnace.h"

namespace restlab::analytic {

double furnaceRadiance(double emission, double albedo, uint32_t scatteringEvents) {
  double sum = 0.0, power = 1.0;
  for (uint32_t n = 0; n <= scatteringEvents; ++n, power *= albedo) sum += power;
  return emission * sum;
}

double furnaceRadianceLimit(double emission, double albedo) { return emission / (1.0 - albedo); }

}  // namespace restlab::analytic
