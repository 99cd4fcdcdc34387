#include "core/scene/splines/nurbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace restlab {

namespace {

std::optional<SplineFault> faultOfAxis(const SplineAxis& axis, const std::string& name) {
  if (axis.degree < 1 || axis.degree > kMostSplineDegree)
    return SplineFault{"degree", fmt::format("the degree along {} is {}, but must be in 1..{}",
                                             name, axis.degree, kMostSplineDegree)};
  if (axis.count <= axis.degree)
    return SplineFault{"size", fmt::format("{} points along {} are too few: degree {} needs {} or "
                                           "more",
                                           axis.count, name, axis.degree, axis.degree + 1)};
  if (axis.count > kMostSplinePoints)
    return SplineFault{"size", fmt::format("{} points along {} are too many: at most {}",
                                           axis.count, name, kMostSplinePoints)};
  const std::string key = "knots_" + name;
  const auto& knots = axis.knots;
  const size_t right = size_t(axis.count + axis.degree + 1);
  if (knots.size() != right)
    return SplineFault{key, fmt::format("'{}' has {} numbers, but must have {}: {} points and "
                                        "degree {} + 1",
                                        key, knots.size(), right, axis.count, axis.degree)};
  for (size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]))
      return SplineFault{key, fmt::format("number {} of '{}' is not finite", i + 1, key)};
    if (i > 0 && knots[i] < knots[i - 1])
      return SplineFault{key, fmt::format("'{}' must not decrease, but {} follows {} (number {})",
                                          key, knots[i], knots[i - 1], i + 1)};
  }
  for (size_t i = 0, equal = 0; i < knots.size(); ++i) {
    equal = i > 0 && knots[i] == knots[i - 1] ? equal + 1 : 1;
    if (equal > size_t(axis.degree) + 1)
      return SplineFault{key, fmt::format("{} stands in '{}' more than {} times: degree {} allows "
                                          "no more",
                                          knots[i], key, axis.degree + 1, axis.degree)};
    const bool isInner = i > size_t(axis.degree) && i < size_t(axis.count);
    if (isInner && equal > size_t(axis.degree))
      return SplineFault{key, fmt::format("{} stands inside '{}' {} times, which tears the surface:"
                                          " at most {}",
                                          knots[i], key, equal, axis.degree)};
  }
  if (!(domainOf(axis)[0] < domainOf(axis)[1]))
    return SplineFault{key, fmt::format("'{}' has no interval: number {} must be below number {}",
                                        key, axis.degree + 1, axis.count + 1)};
  return std::nullopt;
}

// Basis functions of one place that are not 0, and their derivatives (Cox and de Boor).
struct Basis {
  size_t first = 0;  // of the control points
  std::array<double, kMostSplineDegree + 1> value{}, slope{};
};

Basis basisAt(const SplineAxis& axis, double x) {
  const auto& k = axis.knots;
  const size_t p = size_t(axis.degree);
  size_t span = p;
  while (span + 1 < size_t(axis.count) && x >= k[span + 1]) ++span;
  // The last interval that is not empty, where x is the end of the domain.
  while (span > p && k[span] == k[span + 1]) --span;
  Basis basis;
  basis.first = span - p;
  std::array<double, kMostSplineDegree + 1> n{};
  n[0] = 1.0;
  for (size_t degree = 1; degree <= p; ++degree) {
    const auto before = n;
    for (size_t i = 0; i <= degree; ++i) {
      // Function i of this degree begins at knot span - degree + i.
      const size_t at = span - degree + i;
      const auto share = [&](size_t knot, double value, double numerator) {
        const double width = k[knot + degree] - k[knot];
        return width > 0.0 ? numerator / width * value : 0.0;
      };
      const double lower = i > 0 ? share(at, before[i - 1], x - k[at]) : 0.0;
      const double upper = i < degree ? share(at + 1, before[i], k[at + 1 + degree] - x) : 0.0;
      n[i] = lower + upper;
      if (degree == p) {
        const double rise = i > 0 ? share(at, before[i - 1], double(p)) : 0.0;
        const double fall = i < degree ? share(at + 1, before[i], double(p)) : 0.0;
        basis.slope[i] = rise - fall;
      }
    }
  }
  basis.value = n;
  return basis;
}

SplinePoint evaluateOnce(const NurbsSurface& s, double u, double v) {
  const Basis bu = basisAt(s.u, u), bv = basisAt(s.v, v);
  glm::dvec4 h(0.0), hu(0.0), hv(0.0);
  for (size_t j = 0; j <= size_t(s.v.degree); ++j) {
    for (size_t i = 0; i <= size_t(s.u.degree); ++i) {
      const size_t at = (bv.first + j) * size_t(s.u.count) + bu.first + i;
      const glm::dvec4 p(s.points[at] * s.weights[at], s.weights[at]);
      h += p * (bu.value[i] * bv.value[j]);
      hu += p * (bu.slope[i] * bv.value[j]);
      hv += p * (bu.value[i] * bv.slope[j]);
    }
  }
  SplinePoint point;
  point.position = glm::dvec3(h) / h.w;
  point.du = (glm::dvec3(hu) - point.position * hu.w) / h.w;
  point.dv = (glm::dvec3(hv) - point.position * hv.w) / h.w;
  return point;
}

}  // namespace

std::array<double, 2> domainOf(const SplineAxis& axis) {
  return {axis.knots[size_t(axis.degree)], axis.knots[size_t(axis.count)]};
}

std::optional<SplineFault> faultOf(const NurbsSurface& s) {
  if (const auto fault = faultOfAxis(s.u, "u")) return fault;
  if (const auto fault = faultOfAxis(s.v, "v")) return fault;
  const size_t right = size_t(s.u.count) * size_t(s.v.count);
  if (s.points.size() != right)
    return SplineFault{"points", fmt::format("'points' has {} points, but must have {}: {} along u "
                                             "times {} along v",
                                             s.points.size(), right, s.u.count, s.v.count)};
  if (s.weights.size() != right)
    return SplineFault{"weights", fmt::format("'weights' has {} numbers, but must have {}: one a "
                                              "point",
                                              s.weights.size(), right)};
  for (size_t i = 0; i < right; ++i) {
    const glm::dvec3& p = s.points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return SplineFault{"points", fmt::format("point {} of 'points' is not finite", i + 1)};
    if (!(s.weights[i] > 0.0) || !std::isfinite(s.weights[i]))
      return SplineFault{"weights", fmt::format("number {} of 'weights' is {}, but must be above 0",
                                                i + 1, s.weights[i])};
  }
  const auto [least, most] = std::minmax_element(s.weights.begin(), s.weights.end());
  constexpr double kMostRatio = 1e6;
  if (*most > kMostRatio * *least)
    return SplineFault{"weights", fmt::format("the largest of 'weights' is {:.3g} times the least, "
                                              "but must be at most {:g} times",
                                              *most / *least, kMostRatio)};
  return std::nullopt;
}

std::vector<double> clampedKnots(int degree, int count) {
  std::vector<double> knots(size_t(degree) + 1, 0.0);
  const int spans = count - degree;
  for (int i = 1; i < spans; ++i) knots.push_back(double(i) / spans);
  knots.insert(knots.end(), size_t(degree) + 1, 1.0);
  return knots;
}

SplinePoint evaluate(const NurbsSurface& s, double u, double v) {
  SplinePoint point = evaluateOnce(s, u, v);
  glm::dvec3 n = glm::cross(point.du, point.dv);
  if (!(glm::length(n) >
        1e-9 * std::pow(std::max(glm::length(point.du), glm::length(point.dv)), 2.0))) {
    const auto [u0, u1] = domainOf(s.u);
    const auto [v0, v1] = domainOf(s.v);
    const double step = 1e-7;
    const SplinePoint beside =
        evaluateOnce(s, u + step * (0.5 * (u0 + u1) - u), v + step * (0.5 * (v0 + v1) - v));
    n = glm::cross(beside.du, beside.dv);
  }
  if (glm::length(n) > 0.0) point.normal = glm::normalize(n);
  return point;
}

NurbsSurface sphereAsNurbs() {
  const double corner = std::sqrt(0.5);
  constexpr std::array<glm::dvec2, 9> kCircle{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
  // Half a circle from -z over the radius 1 to +z.
  constexpr std::array<glm::dvec2, 5> kHalf{{{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}}};
  NurbsSurface s;
  s.u = {2, 9, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}};
  s.v = {2, 5, {0, 0, 0, 0.5, 0.5, 1, 1, 1}};
  for (size_t j = 0; j < kHalf.size(); ++j) {
    for (size_t i = 0; i < kCircle.size(); ++i) {
      s.points.emplace_back(kHalf[j].x * kCircle[i], kHalf[j].y);
      s.weights.push_back((i % 2 == 1 ? corner : 1.0) * (j % 2 == 1 ? corner : 1.0));
    }
  }
  return s;
}

}  // namespace restlab
