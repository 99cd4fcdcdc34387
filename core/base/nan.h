#pragma once

#include <limits>

namespace restlab {

// Stands for a number that is not known or not defined.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace restlab
