// A metric of an image against a reference, whose own noise stays out of the MSE where it can.
#pragma once

#include "core/image/metrics.h"
#include "experiments/runner/reference.h"

namespace restlab {

// As evaluateMetric(), but `mse` is taken against the two halves where the reference has them and
// the image is not the reference itself.
MetricValue errorAgainst(const std::string& metric, const Image& image, const Reference& reference,
                         const MetricOptions& options = {});

// Standard deviation of mean n0 n1, n0 and n1 being the noise of the halves: what the reference
// adds to an MSE against its halves, the same to that of every run. Estimated from their
// difference, and rather too large where channels have noise of their own; 0 without halves, where
// it is unknown.
double sharedNoiseOfMse(const Reference& reference);

}  // namespace restlab
