// Metrics that are made of differences pixel by pixel. Images are of one size, their values finite
// where the mask selects, and it selects something: the registry sees to that.
#pragma once

#include <vector>

#include "core/image/metrics.h"

namespace restlab {

// In the order of reports. Those of relmseConventions are among them.
std::vector<MetricInfo> pixelMetrics();

constexpr double kRelmseEpsilon = 1e-2;  // the e1e-2 of the names

// Mean of the errors, one a pixel, without the largest 0.1 % of them (rounded down); the detail has
// how many. No error at all is an error of the caller.
MetricValue trimmedMean(std::vector<double> errors);

// relmse as other programs compute it: metrics `relmse_` + name.
const std::vector<std::string>& relmseConventions();

}  // namespace restlab
