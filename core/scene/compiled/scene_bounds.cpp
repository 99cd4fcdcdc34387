// worldBounds() and framingCamera().
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/scene/scene.h"

namespace restlab {
namespace {

using Box = std::array<glm::dvec3, 2>;

constexpr size_t kMostSamples = size_t(1) << 20;  // vertices sampled at most, about

Box emptyBox() {
  return {glm::dvec3(std::numeric_limits<double>::infinity()),
          glm::dvec3(-std::numeric_limits<double>::infinity())};
}

void extend(Box& box, const glm::dvec3& point) {
  box[0] = glm::min(box[0], point);
  box[1] = glm::max(box[1], point);
}

}  // namespace

std::array<glm::dvec3, 2> worldBounds(const Scene& scene) {
  // Exact for meshes used a few times; meshes used often count by the corners of their box.
  constexpr size_t kExactUses = 16;
  std::vector<size_t> uses(scene.geometries.size());
  for (const MeshInstance& instance : scene.instances) ++uses[instance.geometry];
  std::vector<Box> boxes(scene.geometries.size(), emptyBox());
  for (size_t g = 0; g < scene.geometries.size(); ++g) {
    for (const glm::vec3& position : scene.geometries[g].positions) extend(boxes[g], position);
  }
  Box bounds = emptyBox();
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& geometry = scene.geometries[instance.geometry];
    if (geometry.positions.empty()) continue;
    const glm::dmat4& toWorld = instance.objectToWorld;
    if (uses[instance.geometry] <= kExactUses) {
      for (const glm::vec3& position : geometry.positions) {
        extend(bounds, glm::dvec3(toWorld * glm::dvec4(position, 1.0)));
      }
    } else {
      const Box& box = boxes[instance.geometry];
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(box[corner & 1].x, box[(corner >> 1) & 1].y, box[corner >> 2].z);
        extend(bounds, glm::dvec3(toWorld * glm::dvec4(point, 1.0)));
      }
    }
  }
  if (bounds[0].x > bounds[1].x) return {glm::dvec3(0.0), glm::dvec3(0.0)};
  return bounds;
}

Box boundsWithoutStrays(const Scene& scene) {
  constexpr double kGap = 100.0;
  const Box all = worldBounds(scene);
  size_t count = 0;
  for (const MeshInstance& instance : scene.instances)
    count += scene.geometries[instance.geometry].positions.size();
  const size_t step = count / kMostSamples + 1;
  std::vector<glm::dvec3> points;
  size_t next = 0;  // index among the mesh's vertices
  for (const MeshInstance& instance : scene.instances) {
    const std::vector<glm::vec3>& positions = scene.geometries[instance.geometry].positions;
    for (; next < positions.size(); next += step)
      points.emplace_back(instance.objectToWorld * glm::dvec4(positions[next], 1.0));
    next -= positions.size();
  }
  if (points.empty()) return all;
  // Median of the vertices, not the middle of the bounds: a stray moves it by one rank only.
  glm::dvec3 middle;
  std::vector<double> numbers(points.size());
  const auto half = numbers.begin() + ptrdiff_t(numbers.size() / 2);
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), numbers.begin(),
                   [&](const glm::dvec3& p) { return p[axis]; });
    std::nth_element(numbers.begin(), half, numbers.end());
    middle[axis] = *half;
  }
  std::transform(points.begin(), points.end(), numbers.begin(),
                 [&](const glm::dvec3& p) { return glm::length(p - middle); });
  std::sort(numbers.begin(), numbers.end());
  const auto gap = std::adjacent_find(half, numbers.end(), [](double nearer, double farther) {
    return nearer > 0.0 && farther > kGap * nearer;
  });
  if (gap == numbers.end()) return all;
  // Put the limit inside the gap, as vertices outside the sample lie there, too. Vertices of one
  // triangle stay together: the far end of a rod is not a stray.
  const double farthest = std::sqrt(kGap) * *gap;
  Box bounds = emptyBox();
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& mesh = scene.geometries[instance.geometry];
    for (const glm::uvec3& triangle : mesh.triangles) {
      std::array<glm::dvec3, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[size_t(k)] =
            glm::dvec3(instance.objectToWorld * glm::dvec4(mesh.positions[triangle[k]], 1.0));
      if (std::any_of(corners.begin(), corners.end(),
                      [&](const glm::dvec3& p) { return glm::length(p - middle) <= farthest; }))
        for (const glm::dvec3& p : corners) extend(bounds, p);
    }
  }
  if (bounds[0].x > bounds[1].x) return all;
  return bounds;
}

SceneCamera framingCamera(const Scene& scene) {
  const Box bounds = boundsWithoutStrays(scene);
  const glm::dvec3 center = 0.5 * (bounds[0] + bounds[1]);
  const double radius = 0.5 * glm::length(bounds[1] - bounds[0]);
  SceneCamera camera;
  camera.name = "framing";
  camera.yfov = 0.8;
  // The bounding sphere touches the edges of a square image; from the front, a little above and to
  // the side, so that no face of a box is seen edge-on.
  const double distance = (radius > 0.0 ? radius : 1.0) / std::sin(0.5 * camera.yfov);
  const glm::dvec3 eye = center + distance * glm::normalize(glm::dvec3(0.35, 0.3, 1.0));
  camera.cameraToWorld = glm::inverse(glm::lookAt(eye, center, glm::dvec3(0, 1, 0)));
  return camera;
}

}  // namespace restlab
