// What a test would have caught: not rejecting proves nothing without it.
#pragma once

namespace restlab::stats {

// Smallest |difference| that a two-sided z-test over n observations of standard deviation `sigma`
// finds at level `alpha` with probability `power`: (z_{1 - alpha/2} + z_power) sigma / sqrt(n).
double smallestDetectableBias(double sigma, double n, double alpha, double power);

// Observations needed to find `bias` likewise (rounded up): ((z + z) sigma / bias)^2.
double requiredObservations(double sigma, double bias, double alpha, double power);

// The same for a t-test with few degrees of freedom, from the standard error of the difference and
// the noncentral t distribution. Infinite dof: the normal limit.
double smallestDetectableShift(double standardError, double dof, double alpha, double power);

// Probability that a two-sided t-test at `alpha` rejects a true difference of `shift`.
double testPower(double shift, double standardError, double dof, double alpha);

// All throw std::invalid_argument unless alpha and power are in (0, 1), power > alpha, and the
// scale arguments are positive.

}  // namespace restlab::stats
