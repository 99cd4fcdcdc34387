// Lines along x through the samples: from one end the winding number changes by one at each
// triangle that a line passes. A line belongs to exactly one of the triangles at an edge or a
// corner, as if it were moved aside by amounts that are smaller than any number.
#include "core/scene/distance/winding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace restlab {

namespace {

struct Crossing {
  double x = 0.0;
  int change = 0;  // of the winding number, towards larger x
};

// Where a line at (y, z) passes an edge: 1 at its left, -1 at its right.
int sideOf(const glm::dvec3& a, const glm::dvec3& b, double y, double z) {
  const double ay = b.y - a.y, az = b.z - a.z;
  const double area = ay * (z - a.z) - az * (y - a.y);
  if (area != 0.0) return area > 0.0 ? 1 : -1;
  // The line moved by an infinitesimal y, and by a smaller z.
  if (az != 0.0) return az < 0.0 ? 1 : -1;
  return ay > 0.0 ? 1 : -1;
}

// The same number for the triangles on both sides, but for its sign.
int sideOfEdge(const ClosedTriangles& s, uint32_t from, uint32_t to, double y, double z) {
  const glm::dvec3 a(s.positions[std::min(from, to)]), b(s.positions[std::max(from, to)]);
  const int side = sideOf(a, b, y, z);
  return from < to ? side : -side;
}

class WindingLines {
 public:
  WindingLines(const ClosedTriangles& surface, const SamplePlaces& places)
      : surface_(surface), places_(places) {}

  std::vector<uint8_t> inside() {
    crossings_.resize(size_t(places_.samples.y) * size_t(places_.samples.z));
    for (const glm::uvec3& t : surface_.triangles) cross(t);
    std::vector<uint8_t> result;
    result.reserve(crossings_.size() * size_t(places_.samples.x));
    for (int z = 0; z < places_.samples.z; ++z)
      for (int y = 0; y < places_.samples.y; ++y) mark(line(y, z), y, z, result);
    return result;
  }

 private:
  std::vector<Crossing>& line(int y, int z) {
    return crossings_[size_t(z) * size_t(places_.samples.y) + size_t(y)];
  }

  void cross(const glm::uvec3& t) {
    glm::dvec3 low(surface_.positions[t.x]), high = low;
    for (const uint32_t corner : {t.y, t.z}) {
      low = glm::min(low, glm::dvec3(surface_.positions[corner]));
      high = glm::max(high, glm::dvec3(surface_.positions[corner]));
    }
    const auto first = [&](int axis) {
      return std::max(int(std::floor((low[axis] - places_.low[axis]) / places_.cell)), 0);
    };
    const auto last = [&](int axis) {
      return std::min(int(std::ceil((high[axis] - places_.low[axis]) / places_.cell)),
                      places_.samples[axis] - 1);
    };
    for (int z = first(2); z <= last(2); ++z)
      for (int y = first(1); y <= last(1); ++y)
        add(t, places_.at(1, y), places_.at(2, z), line(y, z));
  }

  void add(const glm::uvec3& t, double y, double z, std::vector<Crossing>& to) {
    const int side = sideOfEdge(surface_, t.x, t.y, y, z);
    if (sideOfEdge(surface_, t.y, t.z, y, z) != side ||
        sideOfEdge(surface_, t.z, t.x, y, z) != side)
      return;
    const glm::dvec3 a(surface_.positions[t.x]);
    const glm::dvec3 u = glm::dvec3(surface_.positions[t.y]) - a,
                     v = glm::dvec3(surface_.positions[t.z]) - a;
    const glm::dvec3 n = glm::cross(u, v);
    double x = a.x - (n.y * (y - a.y) + n.z * (z - a.z)) / n.x;
    if (!std::isfinite(x)) x = a.x;
    x = std::clamp(x, std::min({a.x, a.x + u.x, a.x + v.x}), std::max({a.x, a.x + u.x, a.x + v.x}));
    memory_.take("crossings of the surface", 2 * sizeof(Crossing));  // a vector that grows
    to.push_back({x, side});
  }

  void mark(std::vector<Crossing>& line, int y, int z, std::vector<uint8_t>& result) {
    // Rounding may have told a line a corner from two sides; then a line beside it is asked.
    for (int tries = 1; sum(line) != 0 && tries < 20; ++tries) {
      const double aside = 1e-9 * double(tries) * places_.cell;
      std::vector<Crossing> again;
      for (const glm::uvec3& t : surface_.triangles)
        add(t, places_.at(1, y) + aside, places_.at(2, z) + 0.7 * aside, again);
      line = std::move(again);
    }
    if (sum(line) != 0)
      failInput(
          fmt::format("its inside is not found along x at y = {:g}, z = {:g}; a surface "
                      "without triangles that are nearly lines expected",
                      places_.at(1, y), places_.at(2, z)));
    std::sort(line.begin(), line.end(),
              [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    int winding = 0;
    auto next = line.begin();
    for (int i = 0; i < places_.samples.x; ++i) {
      for (; next != line.end() && next->x < places_.at(0, i); ++next) winding += next->change;
      result.push_back(winding != 0 ? 1 : 0);
    }
  }

  static int sum(const std::vector<Crossing>& line) {
    int all = 0;
    for (const Crossing& one : line) all += one.change;
    return all;
  }

  const ClosedTriangles& surface_;
  const SamplePlaces& places_;
  std::vector<std::vector<Crossing>> crossings_;
  MemoryGuard memory_;
};

}  // namespace

std::vector<uint8_t> insideSamples(const ClosedTriangles& surface, const SamplePlaces& places) {
  return WindingLines(surface, places).inside();
}

}  // namespace restlab
