#include "core/image/metrics/flip_color.h"

#include <cmath>

#include "core/image/color.h"

namespace restlab::flip {
namespace {

// x = (a r^2 + b r) / (c r^2 + d r + e) with Narkowicz's 0.6 on the radiance r multiplied in.
constexpr double kA = 0.6 * 0.6 * 2.51, kB = 0.6 * 0.03;
constexpr double kC = 0.6 * 0.6 * 2.43, kD = 0.6 * 0.59, kE = 0.14;

// XYZ of a colour of luminance 1.
glm::dvec3 fromChromaticity(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

struct Spaces {
  glm::dvec3 white = fromChromaticity(0.31271, 0.32902);  // D65, five digits
  glm::dmat3 xyzFromLinear, linearFromXyz;
  Spaces() {
    const glm::dmat3 primaries(fromChromaticity(0.64, 0.33), fromChromaticity(0.30, 0.60),
                               fromChromaticity(0.15, 0.06));
    const glm::dvec3 scale = glm::inverse(primaries) * white;
    xyzFromLinear =
        glm::dmat3(primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z);
    linearFromXyz = glm::inverse(xyzFromLinear);
  }
};

const Spaces& spaces() {
  static const Spaces all;
  return all;
}

double cielabCurve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  if (t > kDelta * kDelta * kDelta) return std::cbrt(t);
  return t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

}  // namespace

glm::dvec3 opponentFromLinear(const glm::dvec3& linear) {
  const glm::dvec3 xyz = spaces().xyzFromLinear * linear / spaces().white;
  return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

glm::dvec3 linearFromOpponent(const glm::dvec3& opponent) {
  const double y = (opponent.x + 16.0) / 116.0;
  const glm::dvec3 xyz(y + opponent.y / 500.0, y, y - opponent.z / 200.0);
  return spaces().linearFromXyz * (xyz * spaces().white);
}

glm::dvec3 huntLabFromLinear(const glm::dvec3& linear) {
  const glm::dvec3 xyz = spaces().xyzFromLinear * linear / spaces().white;
  const double x = cielabCurve(xyz.x), y = cielabCurve(xyz.y), z = cielabCurve(xyz.z);
  const double lightness = 116.0 * y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

double toneMap(double radiance) {
  const double r = radiance < 0.0 ? 0.0 : radiance;
  return clampUnit((kA * r * r + kB * r) / (kC * r * r + kD * r + kE));
}

double radianceShownAs(double shown) {
  const double a = kA - shown * kC, b = kB - shown * kD, c = -shown * kE;
  return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

}  // namespace restlab::flip
