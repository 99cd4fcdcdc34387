#include "core/scene/compiled/sheen_albedo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/shading/bsdf.h"

namespace restlab {
namespace {

constexpr uint32_t kNodes = rl::RL_SHEEN_CELLS + 1;
constexpr int kRings = 128, kSectors = 64;
// At the horizon the lobe has a limit, which the quadrature takes from just above it.
constexpr double kLeastCos = 1e-4;

// Shadowing of Estevez and Kulla (2017), table 1: a rough and a smooth end.
class Shadowing {
 public:
  explicit Shadowing(double alpha) {
    const double smooth = (1.0 - alpha) * (1.0 - alpha);
    constexpr double kRough[] = {21.5473, 3.82987, 0.19823, -1.97760, -4.32054};
    constexpr double kSmooth[] = {25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
    for (int i = 0; i < 5; ++i) fit_[i] = kRough[i] + (kSmooth[i] - kRough[i]) * smooth;
  }
  double lambda(double cosTheta) const {
    return cosTheta < 0.5 ? std::exp(at(cosTheta)) : std::exp(2.0 * at(0.5) - at(1.0 - cosTheta));
  }

 private:
  double at(double x) const {
    return fit_[0] / (1.0 + fit_[1] * std::pow(x, fit_[2])) + fit_[3] * x + fit_[4];
  }
  double fit_[5];
};

double sheenAlbedoOf(double cosO, double alpha) {
  const Shadowing shadowing(alpha);
  const double sinO = std::sqrt(1.0 - cosO * cosO), lambdaO = shadowing.lambda(cosO);
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double root = (i + 0.5) / kRings, cosI = root * root, sinI = std::sqrt(1.0 - cosI * cosI);
    const double shadowed = 4.0 * cosO * (1.0 + lambdaO + shadowing.lambda(cosI));
    for (int j = 0; j < kSectors; ++j) {
      const double phi = (j + 0.5) / kSectors * std::numbers::pi;
      const double x = sinO + sinI * std::cos(phi), y = sinI * std::sin(phi), z = cosO + cosI;
      const double sin2 = (x * x + y * y) / (x * x + y * y + z * z);
      sum += std::pow(sin2, 0.5 / alpha) * root / shadowed;
    }
  }
  // 2 root / rings of the change of variable, 2 pi / sectors, and (2 + 1 / alpha) / (2 pi) of D.
  return sum * 2.0 * (2.0 + 1.0 / alpha) / (double(kRings) * kSectors);
}

}  // namespace

const std::vector<glm::uvec4>& sheenAlbedoTable() {
  static const std::vector<glm::uvec4> kTable = [] {
    std::vector<float> nodes;
    for (uint32_t row = 0; row < kNodes; ++row) {
      const double y = double(row) / rl::RL_SHEEN_CELLS;
      const double alpha = std::max(y * y, double(rl::RL_SHEEN_ALPHA_FLOOR));
      for (uint32_t column = 0; column < kNodes; ++column) {
        const double x = double(column) / rl::RL_SHEEN_CELLS;
        nodes.push_back(float(sheenAlbedoOf(std::max(x * x, kLeastCos), alpha)));
      }
    }
    const auto bits = [&](uint32_t row, uint32_t column) {
      return std::bit_cast<uint32_t>(nodes[row * kNodes + column]);
    };
    std::vector<glm::uvec4> table;
    for (uint32_t row = 0; row < rl::RL_SHEEN_CELLS; ++row) {
      for (uint32_t c = 0; c < rl::RL_SHEEN_CELLS; ++c)
        table.emplace_back(bits(row, c), bits(row, c + 1), bits(row + 1, c), bits(row + 1, c + 1));
    }
    return table;
  }();
  return kTable;
}

}  // namespace restlab
