#include "core/scene/compiled/ggx_albedo.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/shading/bsdf.h"

namespace restlab {

namespace {

constexpr uint32_t kNodes = rl::RL_GGX_NODES;
// Quadrature points for the two variables of a visible normal. The integrand has a kink where the
// reflected direction meets the horizon: the error is about 1e-5
// (tests/unit/multiscatter_test.cpp).
constexpr uint32_t kPoints = 64, kAzimuths = 24;

// Gauss-Legendre abscissae on [-1, 1] of positive sign and their weights, for 3 points.
constexpr double kGauss3X = 0.774596669241483, kGauss3W0 = 8.0 / 9.0, kGauss3W1 = 5.0 / 9.0;

// Loss and Schlick part of the albedo for one direction: the mean of G2 / G1 over the visible
// normals of wo (Heitz 2014, eq. 99), which are drawn by spherical caps (Dupuy & Benyoub 2023) at
// the points of a midpoint rule. Light that leaves below the horizon is lost.
glm::dvec2 lossAndSchlick(double cosO, double alpha) {
  const double sinO = std::sqrt(1.0 - cosO * cosO);
  const double stretched = std::hypot(alpha * sinO, cosO);
  const double wx = alpha * sinO / stretched, wz = cosO / stretched;
  // 1 / (1 + Lambda(o)) in a form that is 0, not undefined, at the horizon.
  const double g1 = 2.0 * cosO / (cosO + stretched);
  glm::dvec2 sum(0.0);
  for (uint32_t i = 0; i < kPoints; ++i) {
    // Facets steep enough to send light down are rare where alpha is small: u = 1 - (1 - t)^4 finds
    // them.
    const double rest = 1.0 - (i + 0.5) / kPoints, rest3 = rest * rest * rest;
    const double z = rest * rest3 * (1.0 + wz) - wz;
    const double r = std::sqrt(std::fmax(0.0, 1.0 - z * z));
    glm::dvec2 ring(0.0);
    for (uint32_t j = 0; j < kAzimuths; ++j) {
      const double phi =
          std::numbers::pi * (j + 0.5) / kAzimuths;  // half the circle: the rest mirrors it
      const glm::dvec3 h = glm::normalize(
          glm::dvec3(alpha * (r * std::cos(phi) + wx), alpha * r * std::sin(phi), z + wz));
      const double cosH = sinO * h.x + cosO * h.z;
      const double cosI = 2.0 * cosH * h.z - cosO;
      if (cosI <= 0.0) {
        ring.x += 1.0;
        continue;
      }
      const double tan2 = std::fmax(0.0, 1.0 - cosI * cosI) / (cosI * cosI);
      const double masked = g1 * 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
      ring.x += masked / (1.0 + masked);
      const double m = 1.0 - std::fmin(cosH, 1.0), m2 = m * m;
      ring.y += m2 * m2 * m / (1.0 + masked);
    }
    sum += ring * (4.0 * rest3);
  }
  return sum / double(kPoints * kAzimuths);
}

// 2 int f cos dcos for an f that is linear in x = sqrt(cos) between the nodes: 4 int f x^3 dx, of
// degree 4 on each interval, which three Gauss points integrate exactly.
glm::dvec2 cosineMean(const std::array<glm::dvec2, kNodes>& nodes) {
  constexpr double width = 1.0 / (kNodes - 1);
  glm::dvec2 sum(0.0);
  for (uint32_t i = 0; i + 1 < kNodes; ++i) {
    for (const double g : {-kGauss3X, 0.0, kGauss3X}) {
      const double t = 0.5 + 0.5 * g, x = (i + t) * width;
      const double weight = 0.5 * width * (g == 0.0 ? kGauss3W0 : kGauss3W1);
      sum += weight * 4.0 * x * x * x * (nodes[i] * (1.0 - t) + nodes[i + 1] * t);
    }
  }
  return sum;
}

std::vector<glm::vec2> computeTable() {
  std::vector<glm::vec2> table;
  table.reserve(size_t(kNodes) * (kNodes + 1));
  for (uint32_t row = 0; row < kNodes; ++row) {
    const double roughness = double(row) / (kNodes - 1);
    std::array<glm::dvec2, kNodes> nodes;
    for (uint32_t i = 0; i < kNodes; ++i) {
      const double x = double(i) / (kNodes - 1);
      const double cosO = x * x;
      // A smooth surface loses nothing and reflects by Schlick's formula at cosO.
      nodes[i] = row == 0 ? glm::dvec2(0.0, std::pow(1.0 - cosO, 5.0))
                          : lossAndSchlick(cosO, roughness * roughness);
      table.emplace_back(nodes[i]);
    }
    table.emplace_back(cosineMean(nodes));
  }
  return table;
}

}  // namespace

const std::vector<glm::vec2>& ggxAlbedoTable() {
  static const std::vector<glm::vec2> table = computeTable();
  return table;
}

}  // namespace restlab
