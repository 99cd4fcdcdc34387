#include "core/scene/splines/read_nurbs.h"

#include <fmt/format.h>

namespace restlab {

namespace {

constexpr double kMost = 1e9;  // of coordinates, weights and knots

}  // namespace

NurbsSurface readNurbs(const ConfigTable& table) {
  for (const char* key : {"size", "points"}) {
    if (!table.has(key))
      table.fail("", fmt::format("[[shape]] of kind 'nurbs' has no '{}': size = [4, 4] and points "
                                 "= [[x, y, z], ...], u fastest",
                                 key));
  }
  const auto pairOf = [&](const char* key, int64_t low, int64_t high) {
    const std::vector<int64_t> pair = table.getIntegers(key, {3, 3}, low, high);
    if (pair.size() != 2)
      table.fail(key, fmt::format("'{}' must have two numbers: along u and along v", key));
    return pair;
  };
  const auto degree = pairOf("degree", 1, kMostSplineDegree);
  const auto size = pairOf("size", 2, kMostSplinePoints);
  NurbsSurface s;
  s.u = {int(degree[0]), int(size[0]), {}};
  s.v = {int(degree[1]), int(size[1]), {}};
  for (const std::vector<double>& p : table.getRows("points", 3, -kMost, kMost))
    s.points.emplace_back(p[0], p[1], p[2]);
  s.weights = table.has("weights") ? table.getList("weights", -kMost, kMost)
                                   : std::vector<double>(s.points.size(), 1.0);
  for (SplineAxis* axis : {&s.u, &s.v}) {
    const std::string key = axis == &s.u ? "knots_u" : "knots_v";
    if (table.has(key)) {
      axis->knots = table.getList(key, -kMost, kMost);
    } else if (axis->count > axis->degree) {
      axis->knots = clampedKnots(axis->degree, axis->count);
    }
  }
  if (const auto fault = faultOf(s)) table.fail(fault->key, fault->message);
  return s;
}

}  // namespace restlab
