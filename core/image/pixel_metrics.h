// Metrics that are made of differences pixel by pixel. Images are of one size, their values finite
// where the mask selects, and it selects something: the registry sees to that.
#pragma once

#include <vector>

#include "core/image/metrics.h"

namespace restlab {

// In the order of reports. Those of relmseConventions are among them.
std::vector<MetricInfo> pixelMetrics();

// relmse as other programs compute it: metrics `relmse_` + name.
const std::vector<std::string>& relmseConventions();

}  // namespace restlab
