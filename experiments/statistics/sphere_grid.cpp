#include "experiments/statistics/sphere_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace restlab::stats {
namespace {

constexpr int kMaxDepth = 7;
constexpr double kPi = std::numbers::pi;

struct Box {
  double theta0, theta1, phi0, phi1;
};

glm::dvec3 direction(double theta, double phi) {
  const double s = std::sin(theta);
  return {s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
}

glm::dvec4 gauss(const SphereGrid::Function& f, const Box& b) {
  const double ht = 0.5 * (b.theta1 - b.theta0), hp = 0.5 * (b.phi1 - b.phi0);
  const double ct = 0.5 * (b.theta1 + b.theta0), cp = 0.5 * (b.phi1 + b.phi0);
  glm::dvec4 sum(0.0);
  for (int i = 0; i < 5; ++i) {
    const double theta = ct + ht * kGauss5X[i];
    glm::dvec4 row(0.0);
    for (int j = 0; j < 5; ++j) row += kGauss5W[j] * f(direction(theta, cp + hp * kGauss5X[j]));
    sum += kGauss5W[i] * std::sin(theta) * row;
  }
  return sum * (ht * hp);
}

bool agree(const glm::dvec4& a, const glm::dvec4& b) {
  for (int c = 0; c < 4; ++c) {
    if (std::abs(a[c] - b[c]) > 1e-7 + 1e-4 * std::abs(b[c])) return false;
  }
  return true;
}

glm::dvec4 adaptive(const SphereGrid::Function& f, const Box& b, const glm::dvec4& coarse,
                    int depth) {
  const double t = 0.5 * (b.theta0 + b.theta1), p = 0.5 * (b.phi0 + b.phi1);
  const Box quarters[4] = {{b.theta0, t, b.phi0, p},
                           {b.theta0, t, p, b.phi1},
                           {t, b.theta1, b.phi0, p},
                           {t, b.theta1, p, b.phi1}};
  glm::dvec4 parts[4], fine(0.0);
  for (int i = 0; i < 4; ++i) {
    parts[i] = gauss(f, quarters[i]);
    fine += parts[i];
  }
  if (depth == kMaxDepth || agree(coarse, fine)) return fine;
  glm::dvec4 sum(0.0);
  for (int i = 0; i < 4; ++i) sum += adaptive(f, quarters[i], parts[i], depth + 1);
  return sum;
}

// Distances from a peak, in widths, of the cell borders.
constexpr double kSteps[] = {0.25, 0.6, 1.0, 1.6, 2.6, 4.5, 8.0, 15.0, 30.0, 60.0};

void addAround(std::vector<double>& edges, double center, double width, double low, double high) {
  for (const double step : kSteps) {
    for (const double edge : {center - step * width, center + step * width}) {
      if (edge > low && edge < high) edges.push_back(edge);
    }
  }
  if (center > low && center < high) edges.push_back(center);
}

// Sorts edges and removes slivers; `fixed` edges stay.
std::vector<double> tidy(std::vector<double> edges, const std::vector<double>& fixed,
                         double sliver) {
  std::sort(edges.begin(), edges.end());
  std::vector<double> kept = fixed;
  for (const double e : edges) {
    const bool isFree =
        std::all_of(kept.begin(), kept.end(), [&](double k) { return std::abs(e - k) > sliver; });
    if (isFree) kept.push_back(e);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

SphereGrid::SphereGrid(const std::vector<Peak>& peaks) {
  std::vector<double> thetas, phis;
  double thetaSliver = 0.05, phiSliver = 0.1;
  for (const Peak& peak : peaks) {
    const double theta = std::acos(std::clamp(peak.direction.z, -1.0, 1.0));
    const double sine = std::sin(theta);
    addAround(thetas, theta, peak.width, 0.0, kPi);
    thetaSliver = std::min(thetaSliver, 0.2 * peak.width);
    if (sine > 1e-6) {
      const double width = std::min(peak.width / sine, 1.0);
      addAround(phis, std::atan2(peak.direction.y, peak.direction.x), width, -kPi, kPi);
      phiSliver = std::min(phiSliver, 0.2 * width);
    }
  }
  for (int i = 1; i < 12; ++i) thetas.push_back(kPi * i / 12.0);
  for (int i = 1; i < 8; ++i) phis.push_back(-kPi + kPi * i / 4.0);
  thetas_ = tidy(thetas, {0.0, 0.5 * kPi, kPi}, thetaSliver);
  phis_ = tidy(phis, {-kPi, kPi}, phiSliver);
}

std::optional<size_t> SphereGrid::find(const glm::dvec3& d) const {
  const double theta = std::atan2(std::hypot(d.x, d.y), d.z), phi = std::atan2(d.y, d.x);
  if (!std::isfinite(theta) || !std::isfinite(phi)) return std::nullopt;
  auto index = [](const std::vector<double>& edges, double x) {
    const auto it = std::upper_bound(edges.begin(), edges.end(), x);
    return std::clamp<ptrdiff_t>(it - edges.begin() - 1, 0, ptrdiff_t(edges.size()) - 2);
  };
  return size_t(index(thetas_, theta)) * (phis_.size() - 1) + size_t(index(phis_, phi));
}

bool SphereGrid::isBelow(size_t cell) const {
  return thetas_[cell / (phis_.size() - 1)] > 0.5 * kPi - 1e-9;
}

glm::dvec4 SphereGrid::integrateCell(size_t cell, const Function& f, int depth) const {
  const size_t i = cell / (phis_.size() - 1), j = cell % (phis_.size() - 1);
  const int n = 1 << depth;
  const double dt = (thetas_[i + 1] - thetas_[i]) / n, dp = (phis_[j + 1] - phis_[j]) / n;
  glm::dvec4 sum(0.0);
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const Box box{thetas_[i] + a * dt, thetas_[i] + (a + 1) * dt, phis_[j] + b * dp,
                    phis_[j] + (b + 1) * dp};
      sum += adaptive(f, box, gauss(f, box), 0);
    }
  }
  return sum;
}

std::vector<glm::dvec4> SphereGrid::integrate(const Function& f) const {
  std::vector<glm::dvec4> cells;
  cells.reserve(size());
  for (size_t i = 0; i < size(); ++i) cells.push_back(integrateCell(i, f, 0));
  return cells;
}

}  // namespace restlab::stats
