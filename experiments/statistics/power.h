// Power of tests: a test that does not reject proves nothing without it.
#pragma once

namespace restlab::stats {

// Returns the smallest |difference| that a two-sided t-test finds at level `alpha` with probability
// `power`, from the standard error of the difference and the noncentral t distribution. Infinite
// dof: the normal limit, (z_{1 - alpha/2} + z_power) times that error.
double smallestDetectableShift(double standardError, double dof, double alpha, double power);

// Returns the probability that a two-sided t-test at `alpha` rejects a true difference of `shift`.
double testPower(double shift, double standardError, double dof, double alpha);

// All functions throw std::invalid_argument unless alpha and power are in (0, 1), power > alpha,
// and the scale arguments are positive.

}  // namespace restlab::stats
