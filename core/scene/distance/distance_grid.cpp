#include "core/scene/distance/distance_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/distance/closest_triangle.h"
#include "core/scene/distance/winding.h"
#include "core/scene/field/grid_file.h"

namespace restlab {

namespace {

constexpr int kCellsAround = 2;  // cells around the surface, on each side

SamplePlaces placesAround(const ClosedTriangles& surface, int cells) {
  const glm::dvec3 size = surface.high - surface.low;
  SamplePlaces places;
  places.cell = std::max({size.x, size.y, size.z}) / double(cells - 2 * kCellsAround);
  for (int c = 0; c < 3; ++c) {
    const int inside = std::clamp(int(std::ceil(size[c] / places.cell - 1e-9)), 1, cells);
    places.samples[c] = std::min(inside + 2 * kCellsAround, cells) + 1;
    const double middle = 0.5 * (surface.low[c] + surface.high[c]);
    places.low[c] = middle - 0.5 * places.cell * double(places.samples[c] - 1);
  }
  return places;
}

}  // namespace

SampledGrid distanceGrid(const ClosedTriangles& surface, int cells) {
  const SamplePlaces places = placesAround(surface, cells);
  SampledGrid grid;
  grid.samples = places.samples;
  grid.low = glm::dvec3(glm::vec3(places.low));
  grid.high = glm::dvec3(glm::vec3(places.low + places.cell * glm::dvec3(places.samples - 1)));
  if (const std::string fault = faultOfGridBox(grid); !fault.empty())
    failInput("no grid can hold its distances: " + fault + "; move or scale it");
  const std::vector<uint8_t> inside = insideSamples(surface, places);
  if (std::find(inside.begin(), inside.end(), 1) == inside.end())
    failInput("no sample is inside of the surface: it is thinner than a cell; more cells expected");
  const ClosestTriangle closest(surface);
  const glm::ivec3 n = places.samples;
  grid.values.resize(inside.size());
  tbb::parallel_for(0, n.y * n.z, [&](int row) {
    const int y = row % n.y, z = row / n.y;
    double last = 1e30;
    for (int x = 0; x < n.x; ++x) {
      const size_t i = size_t(row) * size_t(n.x) + size_t(x);
      // A step changes a distance by its length at most.
      last =
          closest.distance({places.at(0, x), places.at(1, y), places.at(2, z)}, last + places.cell);
      grid.values[i] = float(inside[i] != 0 ? -last : last);
    }
  });
  return grid;
}

}  // namespace restlab
