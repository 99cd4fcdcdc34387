// Metric of an image against a reference, without the reference's own noise where possible.
#pragma once

#include "core/image/metrics/metrics.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

// Like evaluateMetric(), but computes `mse`, `relmse_e1e-2` and `relmse_e1e-2_trim0.1` against the
// two halves if the reference has them and the image is not the reference itself.
MetricValue errorAgainst(const std::string& metric, const Image& image, const Reference& reference,
                         const MetricOptions& options = {});

}  // namespace restlab
