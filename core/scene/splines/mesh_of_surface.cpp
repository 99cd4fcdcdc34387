#include "core/scene/splines/mesh_of_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/config.h"
#include "core/base/memory.h"
#include "core/scene/splines/read_nurbs.h"

namespace restlab {

namespace {

constexpr double kLines = 1080.0;
constexpr size_t kMostTriangles = size_t{1} << 22;  // of a surface

}  // namespace

double quarterOfPixel(const BezierGrid& grid, const glm::dmat4& toWorld,
                      const std::vector<SceneCamera>& cameras) {
  std::vector<glm::dvec3> points;
  glm::dvec3 low(1e300), high(-1e300);
  for (const BezierPiece& piece : grid.pieces) {
    for (size_t j = 0; j <= 8; ++j) {
      for (size_t i = 0; i <= 8; ++i) {
        const SplinePoint p = evaluate(piece, fraction(i, 8), fraction(j, 8));
        points.emplace_back(toWorld * glm::dvec4(p.position, 1.0));
        low = glm::min(low, points.back());
        high = glm::max(high, points.back());
      }
    }
  }
  const double size = glm::length(high - low);
  double least = size / 4000.0;
  for (const SceneCamera& camera : cameras) {
    double nearest = 1e300;
    for (const glm::dvec3& p : points)
      nearest = std::min(nearest, glm::distance(p, positionOf(camera)));
    // A camera on the surface would ask for no error at all.
    nearest = std::max(nearest, 1e-3 * size);
    const double pixel = camera.kind == rl::RL_CAMERA_PERSPECTIVE
                             ? 2.0 * nearest * std::tan(0.5 * camera.yfov) / kLines
                             : 2.0 * camera.ymag / kLines;
    least = &camera == &cameras.front() ? 0.25 * pixel : std::min(least, 0.25 * pixel);
  }
  return least;
}

MeshGeometry readMeshOfSurface(const ConfigTable& table, const ShapePlace& place) {
  const BezierGrid grid = bezierGrid(readNurbs(table));
  const bool isGiven = table.has("chord_error");
  const double given = isGiven ? table.getNumber("chord_error", 1.0, 1e-9, 1e9) : 0.0;
  double possible = 0.0;
  GridCells cells;
  for (const glm::dmat4& toWorld : place.toWorld) {
    const double error = isGiven ? given : quarterOfPixel(grid, toWorld, place.cameras);
    const auto cellsOf = [&](const BezierPiece& piece) {
      const BezierPiece inScene = transformed(piece, toWorld);
      if (const auto fit = cellsFor(inScene, error)) return *fit;
      const double least = leastChordError(inScene);
      possible = std::max(possible, least);
      return *cellsFor(inScene, least);
    };
    const GridCells own = gridCells(grid, cellsOf);
    cells.u.resize(own.u.size(), 1);
    cells.v.resize(own.v.size(), 1);
    for (size_t i = 0; i < own.u.size(); ++i) cells.u[i] = std::max(cells.u[i], own.u[i]);
    for (size_t i = 0; i < own.v.size(); ++i) cells.v[i] = std::max(cells.v[i], own.v[i]);
  }
  if (isGiven && possible > 0.0)
    table.fail("chord_error",
               fmt::format("'chord_error' is {:g}, which takes more than {} triangles "
                           "a piece: {:.3g} would do",
                           given, kMostTrianglesOfPiece, 1.01 * possible));
  if (cells.triangles() > kMostTriangles)
    table.fail(isGiven ? "chord_error" : "",
               fmt::format("the surface takes {} triangles, but at most {}: a larger 'chord_error'",
                           cells.triangles(), kMostTriangles));
  // Many small surfaces are summed: one guard for all that a thread reads.
  static thread_local MemoryGuard memory;
  constexpr uint64_t kBytes = 64;  // of a triangle, with its share of vertices and of copies
  memory.take(table.place(""), kBytes * cells.triangles());
  return tessellate(grid, cells);
}

}  // namespace restlab
