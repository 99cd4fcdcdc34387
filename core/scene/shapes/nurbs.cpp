#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/shapes/shape_info.h"
#include "core/scene/splines/closest_point.h"
#include "core/scene/splines/mesh_of_surface.h"
#include "core/scene/splines/read_nurbs.h"
#include "core/scene/splines/surface_words.h"

namespace restlab {

namespace {

// The surface that was asked for last, by any thread: questions come in long rows.
std::shared_ptr<const ClosedSurface> preparedSurface(const std::vector<uint32_t>& words) {
  static std::mutex mutex;
  static std::vector<uint32_t> known;
  static std::shared_ptr<const ClosedSurface> surface;
  const std::lock_guard lock(mutex);
  if (surface == nullptr || known != words) {
    surface = std::make_shared<const ClosedSurface>(surfaceOfWords(words));
    known = words;
  }
  return surface;
}

MeshGeometry standInOf(const ShapeGeometry& shape) {
  const BezierGrid grid = surfaceOfWords(shape.words);
  // About 8000 triangles, and at least one cell a piece.
  const size_t cells =
      std::clamp<size_t>(size_t(std::sqrt(4000.0 / double(grid.pieces.size()))), 1, 32);
  return tessellate(
      grid, {std::vector<size_t>(grid.columns(), cells), std::vector<size_t>(grid.rows(), cells)});
}

}  // namespace

ShapeInfo nurbsShape() {
  ShapeInfo info;
  info.summary = "a surface of control points: NURBS, B-splines, Bezier pieces; way = \"exact\"";
  info.read = [](const ConfigTable& table, const ShapeFiles&, ShapeGeometry& shape) {
    const NurbsSurface surface = readNurbs(table);
    shape.words = atPlace(table.place("points"), [&] { return surfaceWords(bezierGrid(surface)); });
    if (standInOf(shape).triangles.empty())
      table.fail("points",
                 "the surface has no area in single precision; put its points near 0 and move it "
                 "with 'translate'");
  };
  info.readMesh = [](const ConfigTable& table, const ShapePlace& place) {
    std::optional<MeshGeometry> mesh;
    if (table.getChoice("way", "mesh", {"mesh", "exact"}) == "mesh")
      mesh = readMeshOfSurface(table, place);
    return mesh;
  };
  NurbsSurface hill{{3, 4, clampedKnots(3, 4)}, {3, 4, clampedKnots(3, 4)}, {}, {}};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const bool isInner = i % 3 != 0 && j % 3 != 0;
      hill.points.emplace_back(i / 1.5 - 1.0, j / 1.5 - 1.0, isInner ? 1.0 : 0.0);
      hill.weights.push_back(1.0);
    }
  }
  info.examples = {{"nurbs_sphere", {}, surfaceWords(bezierGrid(sphereAsNurbs()))},
                   {"nurbs_hill", {}, surfaceWords(bezierGrid(hill))}};
  info.isClosed = [](const ShapeGeometry& shape) {
    return isClosedSurface(surfaceOfWords(shape.words));
  };
  info.isInside = [](const ShapeGeometry& shape, const glm::dvec3& posL) {
    return preparedSurface(shape.words)->isInside(posL);
  };
  info.box = [](const ShapeGeometry& shape) { return boxOfWords(shape.words); };
  info.standIn = standInOf;
  return info;
}

}  // namespace restlab
