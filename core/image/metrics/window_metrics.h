// Metrics that look at the neighbourhood of every pixel.
#pragma once

#include <vector>

#include "core/image/metrics/metrics.h"

namespace restlab {

std::vector<MetricInfo> windowMetrics();

}  // namespace restlab
