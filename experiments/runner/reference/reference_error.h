// A metric of an image against a reference, whose own noise stays out of the MSE where it can.
#pragma once

#include "core/image/metrics.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

// As evaluateMetric(), but `mse`, `relmse_e1e-2` and `relmse_e1e-2_trim0.1` are taken against the
// two halves where the reference has them and the image is not the reference itself.
MetricValue errorAgainst(const std::string& metric, const Image& image, const Reference& reference,
                         const MetricOptions& options = {});

}  // namespace restlab
