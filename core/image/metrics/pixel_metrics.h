// Metrics made of differences pixel by pixel. The registry ensures that images have one size,
// selected values are finite, and the mask selects something.
#pragma once

#include <vector>

#include "core/image/metrics/metrics.h"

namespace restlab {

// Metrics in the order of reports, including those of relmseConventions().
std::vector<MetricInfo> pixelMetrics();

constexpr double kRelmseEpsilon = 1e-2;  // the e1e-2 of the names

// Mean of the errors, one per pixel, without the largest 0.1 % of them (rounded down); the detail
// has their number. `errors` must not be empty.
MetricValue trimmedMean(std::vector<double> errors);

// relmse as other programs compute it: metrics `relmse_` + name.
const std::vector<std::string>& relmseConventions();

}  // namespace restlab
