#include "core/scene/compiled/coarse_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace restlab {

namespace {

// Distance of a point to the box of a mesh's vertices.
double distanceTo(const MeshGeometry& mesh, const glm::dmat4& toWorld, const glm::dvec3& pointW) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::vec3& p : mesh.positions) {
    const glm::dvec3 at(toWorld * glm::dvec4(p, 1.0));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  return glm::length(glm::max(glm::max(low - pointW, pointW - high), glm::dvec3(0.0)));
}

}  // namespace

std::string coarseVertices(const Scene& scene) {
  return coarseVertices(scene, originOf(scene, scene.mainCamera));
}

std::string coarseVertices(const Scene& scene, const SceneOrigin& origin) {
  std::vector<float> farthest;  // largest coordinate of a vertex, by geometry
  for (const MeshGeometry& mesh : scene.geometries) {
    float& most = farthest.emplace_back(0.0f);
    for (const glm::vec3& p : mesh.positions)
      most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  double coarsest = 0.0;
  std::string where;
  for (const MeshInstance& m : scene.instances) {
    const float most = farthest[m.geometry];
    const double spacing =
        double(std::nextafter(most, std::numeric_limits<float>::infinity())) - double(most);
    const glm::dmat3 linear(m.objectToWorld);
    const double larger =
        std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
    if (!(spacing * larger > coarsest)) continue;
    if (origin.followsCamera && distanceTo(scene.geometries[m.geometry], m.objectToWorld,
                                           origin.focusW) > kHarmlessReach * origin.viewSize)
      continue;
    coarsest = spacing * larger;
    where = m.name;
  }
  const auto bounds = worldBounds(scene);
  const glm::dvec3 extent = bounds[1] - bounds[0];
  const double size =
      origin.followsCamera ? origin.viewSize : std::max({extent.x, extent.y, extent.z});
  if (!(coarsest > kCoarsestVertices * size)) return "";
  return fmt::format(
      "{}: {}: vertices are so far from their origin that float32 rounds them to {:.2g} m, {:.2g} "
      "of {}; give the distance to the node instead",
      scene.name, where, coarsest, coarsest / size,
      origin.followsCamera ? "what the camera sees" : "the scene's size");
}

}  // namespace restlab
