// The shipped resampling files as they render: exact to 1e-5.
#define EXACT_SUITE ExactFloat
namespace rl {
namespace {
constexpr double kTolerance = 1e-5;
}
}  // namespace rl
#include "tests/exact/every_combination.inl"
