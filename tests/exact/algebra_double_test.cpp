// Proofs on the shipped resampling code in double precision: exact to 1e-12.
#define RL_REAL_DOUBLE
#define EXACT_SUITE ExactDouble
namespace rl {
namespace {
constexpr double kTolerance = 1e-12;
}
}  // namespace rl
#include "tests/exact/algebra.inl"
