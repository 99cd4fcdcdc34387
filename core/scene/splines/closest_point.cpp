#include "core/scene/splines/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace restlab {

namespace {

constexpr size_t kSteps = 4;  // of the samples along one direction of a piece

// Points along an edge of the grid: 0 and 1 are u at its ends, 2 and 3 v.
std::vector<SplinePoint> alongEdge(const BezierGrid& grid, int edge) {
  std::vector<SplinePoint> points;
  const bool isU = edge < 2;
  const UnitParameter end = edge % 2 == 0 ? UnitParameter{0.0, 1.0} : UnitParameter{1.0, 0.0};
  const size_t last = (isU ? grid.columns() : grid.rows()) - 1, line = edge % 2 == 0 ? 0 : last;
  for (size_t k = 0; k < (isU ? grid.rows() : grid.columns()); ++k) {
    const BezierPiece& piece =
        grid.pieces[isU ? k * grid.columns() + line : line * grid.columns() + k];
    for (size_t i = 0; i <= kSteps; ++i)
      points.push_back(isU ? evaluate(piece, end, fraction(i, kSteps))
                           : evaluate(piece, fraction(i, kSteps), end));
  }
  return points;
}

// Moves (s, t) of a piece to where it is closest to p (Gauss and Newton, within the piece).
SplinePoint approach(const BezierPiece& piece, glm::dvec2 st, const glm::dvec3& p) {
  const auto at = [&] { return evaluate(piece, {st.x, 1.0 - st.x}, {st.y, 1.0 - st.y}); };
  SplinePoint point = at();
  for (int i = 0; i < 30; ++i) {
    const glm::dvec3 miss = p - point.position;
    const double e = glm::dot(point.du, point.du), f = glm::dot(point.du, point.dv),
                 g = glm::dot(point.dv, point.dv), damp = 1e-9 * (e + g),
                 det = (e + damp) * (g + damp) - f * f;
    if (!(det > 0.0)) break;
    const glm::dvec2 b(glm::dot(miss, point.du), glm::dot(miss, point.dv));
    const glm::dvec2 step((b.x * (g + damp) - b.y * f) / det, (b.y * (e + damp) - b.x * f) / det);
    const glm::dvec2 before = st;
    // Halve the step until the point comes closer.
    for (double share = 1.0; share > 1e-3; share *= 0.5) {
      st = glm::clamp(before + share * step, glm::dvec2(0.0), glm::dvec2(1.0));
      const SplinePoint next = at();
      if (glm::distance(next.position, p) <= glm::distance(point.position, p)) {
        point = next;
        break;
      }
      st = before;
    }
    if (glm::distance(st, before) < 1e-12) break;
  }
  return point;
}

}  // namespace

bool isClosedSurface(const BezierGrid& grid) {
  std::array<std::vector<SplinePoint>, 4> edges;
  for (int k = 0; k < 4; ++k) edges[size_t(k)] = alongEdge(grid, k);
  double size = 0.0;
  for (const auto& edge : edges) {
    for (const SplinePoint& p : edge) size = std::max(size, glm::length(p.position));
  }
  const double error = 1e-5 * size;
  const auto isPoint = [&](size_t k) {
    return std::all_of(edges[k].begin(), edges[k].end(), [&](const SplinePoint& p) {
      return glm::distance(p.position, edges[k][0].position) < error;
    });
  };
  const auto meet = [&](size_t a, size_t b) {
    for (size_t i = 0; i < edges[a].size(); ++i) {
      if (!(glm::distance(edges[a][i].position, edges[b][i].position) < error)) return false;
    }
    return true;
  };
  for (size_t k = 0; k < 4; k += 2) {
    if (!meet(k, k + 1) && !(isPoint(k) && isPoint(k + 1))) return false;
  }
  double volume = 0.0;
  for (const BezierPiece& piece : grid.pieces) {
    for (size_t j = 0; j < kSteps; ++j) {
      for (size_t i = 0; i < kSteps; ++i) {
        const SplinePoint p =
            evaluate(piece, fraction(2 * i + 1, 2 * kSteps), fraction(2 * j + 1, 2 * kSteps));
        volume += glm::dot(p.position, glm::cross(p.du, p.dv));
      }
    }
  }
  return volume > 0.0;
}

ClosedSurface::ClosedSurface(BezierGrid grid) : grid_(std::move(grid)) {
  for (size_t k = 0; k < grid_.pieces.size(); ++k) {
    for (size_t j = 0; j <= kSteps; ++j) {
      for (size_t i = 0; i <= kSteps; ++i) {
        // Beside the edges: a pole has no way back.
        const UnitParameter s = fraction(2 * i + 1, 2 * kSteps + 2),
                            t = fraction(2 * j + 1, 2 * kSteps + 2);
        const SplinePoint at = evaluate(grid_.pieces[k], s, t);
        samples_.push_back({at.position, at.normal, k, {s.at, t.at}});
        if (i > 0)
          spacing_ = std::max(spacing_, glm::distance(at.position, samples_.end()[-2].position));
        if (j > 0)
          spacing_ = std::max(
              spacing_, glm::distance(at.position, samples_.end()[-2 - int(kSteps)].position));
      }
    }
  }
}

bool ClosedSurface::isInside(const glm::dvec3& p) const {
  // The closest sample of each of the six pieces that come closest.
  std::array<std::pair<double, const Sample*>, 6> begins;
  begins.fill({1e300, nullptr});
  for (const Sample& sample : samples_) {
    const glm::dvec3 d = sample.position - p;
    std::pair<double, const Sample*> one(glm::dot(d, d), &sample);
    for (auto& begin : begins) {
      if (one.first < begin.first) std::swap(one, begin);
      if (one.second == nullptr || one.second->piece == begin.second->piece) break;
    }
  }
  // Far away the closest sample is as good as the closest point, if it is straight below.
  const double distance = std::sqrt(begins[0].first),
               height = glm::dot(p - begins[0].second->position, begins[0].second->normal);
  if (distance > 4.0 * spacing_ && std::abs(height) > 0.7 * distance) return height < 0.0;
  double nearest = 1e300;
  bool isInside = false;
  for (const auto& [d2, sample] : begins) {
    if (sample == nullptr) break;
    const SplinePoint at = approach(grid_.pieces[sample->piece], sample->st, p);
    const double own = glm::distance(at.position, p);
    if (!(own < nearest)) continue;
    nearest = own;
    isInside = glm::dot(p - at.position, at.normal) < 0.0;
  }
  return isInside;
}

}  // namespace restlab
