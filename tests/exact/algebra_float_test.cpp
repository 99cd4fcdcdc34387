// Proofs on the shipped resampling code in single precision, as rendered: exact to 1e-5.
#define EXACT_SUITE ExactFloat
namespace rl {
namespace {
constexpr double kTolerance = 1e-5;
}
}  // namespace rl
#include "tests/exact/algebra.inl"
