#include "core/scene/camera_path/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/ray_triangle.h"

namespace restlab {

namespace {

constexpr double kNoEntry = std::numeric_limits<double>::infinity();
constexpr uint32_t kPieceSize = 64;  // triangles
constexpr uint32_t kManyUses = 16;   // more uses of a mesh: a forest

double largestComponent(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

double distanceToBox(const glm::dvec3& point, const glm::dvec3& low, const glm::dvec3& high) {
  return glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
}

// Distance at which a ray enters a box, in lengths of its direction.
double entryOf(const glm::dvec3& origin, const glm::dvec3& dir, const glm::dvec3& low,
               const glm::dvec3& high) {
  double enter = 0.0, leave = kNoEntry;
  for (int axis = 0; axis < 3; ++axis) {
    if (dir[axis] == 0.0) {
      if (origin[axis] < low[axis] || origin[axis] > high[axis]) return kNoEntry;
      continue;
    }
    const double a = (low[axis] - origin[axis]) / dir[axis];
    const double b = (high[axis] - origin[axis]) / dir[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  constexpr double kSlack = 1e-9;  // for flat boxes
  return enter <= leave * (1.0 + kSlack) ? enter : kNoEntry;
}

double distanceToEdge(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double length2 = glm::dot(edge, edge);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(point - a, edge) / length2, 0.0, 1.0) : 0.0;
  return glm::length(point - a - t * edge);
}

}  // namespace

double distanceToTriangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area = glm::length(normal);
  if (area > 0.0) {
    const bool isAbove = glm::dot(glm::cross(b - a, point - a), normal) >= 0.0 &&
                         glm::dot(glm::cross(c - b, point - b), normal) >= 0.0 &&
                         glm::dot(glm::cross(a - c, point - c), normal) >= 0.0;
    if (isAbove) return std::abs(glm::dot(point - a, normal)) / area;
  }
  return std::min(
      {distanceToEdge(point, a, b), distanceToEdge(point, b, c), distanceToEdge(point, c, a)});
}

Sight::Sight(const Scene& scene) : scene_(scene) {
  std::vector<uint32_t> uses(scene.geometries.size());
  for (const MeshInstance& instance : scene.instances) ++uses[instance.geometry];
  std::vector<std::array<glm::dvec3, 2>> boxes(scene.geometries.size(),
                                               {glm::dvec3(kNoEntry), glm::dvec3(-kNoEntry)});
  for (size_t g = 0; g < scene.geometries.size(); ++g) {
    if (uses[g] <= kManyUses) continue;
    for (const glm::vec3& p : scene.geometries[g].positions) {
      boxes[g][0] = glm::min(boxes[g][0], glm::dvec3(p));
      boxes[g][1] = glm::max(boxes[g][1], glm::dvec3(p));
    }
  }
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    const auto count = uint32_t(scene.geometries[instance.geometry].triangles.size());
    if (count == 0) continue;
    const bool isForest = uses[instance.geometry] > kManyUses;
    const uint32_t step = isForest ? count : kPieceSize;
    for (uint32_t first = 0; first < count; first += std::min(step, count - first)) {
      Piece piece{i, first, std::min(step, count - first), glm::dvec3(kNoEntry),
                  glm::dvec3(-kNoEntry)};
      const auto add = [&](const glm::dvec3& p) {
        piece.low = glm::min(piece.low, p);
        piece.high = glm::max(piece.high, p);
      };
      if (isForest) {
        const auto& box = boxes[instance.geometry];
        for (int k = 0; k < 8; ++k) {
          const glm::dvec3 p(box[k & 1].x, box[k >> 1 & 1].y, box[k >> 2].z);
          add(glm::dvec3(instance.objectToWorld * glm::dvec4(p, 1.0)));
        }
      } else {
        for (uint32_t t = 0; t < piece.count; ++t)
          for (const glm::dvec3& p : corners(piece, first + t)) add(p);
      }
      pieces_.push_back(piece);
    }
  }
}

std::array<glm::dvec3, 3> Sight::corners(const Piece& piece, uint32_t triangle) const {
  const MeshInstance& instance = scene_.instances[piece.instance];
  const MeshGeometry& mesh = scene_.geometries[instance.geometry];
  const glm::uvec3 indices = mesh.triangles[triangle];
  std::array<glm::dvec3, 3> points;
  for (int k = 0; k < 3; ++k)
    points[size_t(k)] =
        glm::dvec3(instance.objectToWorld * glm::dvec4(mesh.positions[indices[k]], 1.0));
  return points;
}

double Sight::distanceTo(const glm::dvec3& originW, const glm::dvec3& dirW) const {
  double nearest = kNoEntry;
  for (const Piece& piece : pieces_) {
    if (!(entryOf(originW, dirW, piece.low, piece.high) < nearest)) continue;
    for (uint32_t t = 0; t < piece.count; ++t) {
      const auto [a, b, c] = corners(piece, piece.first + t);
      nearest = std::min(nearest, distanceToTriangle(originW, dirW, a, b, c));
    }
  }
  return nearest;
}

double Sight::distanceToNearest(const glm::dvec3& pointW, double enough) const {
  double nearest = kNoEntry;
  for (const Piece& piece : pieces_) {
    if (!(distanceToBox(pointW, piece.low, piece.high) < nearest)) continue;
    for (uint32_t t = 0; t < piece.count; ++t) {
      const auto [a, b, c] = corners(piece, piece.first + t);
      nearest = std::min(nearest, distanceToTriangle(pointW, a, b, c));
    }
    if (nearest < enough) break;
  }
  return nearest;
}

std::array<glm::dvec3, 2> Sight::boundsWithin(const glm::dvec3& pointW, double reach) const {
  std::array<glm::dvec3, 2> bounds{glm::dvec3(kNoEntry), glm::dvec3(-kNoEntry)};
  const auto add = [&](const glm::dvec3& p) {
    if (!(largestComponent(glm::abs(p - pointW)) <= reach)) return;
    bounds[0] = glm::min(bounds[0], p);
    bounds[1] = glm::max(bounds[1], p);
  };
  for (const Piece& piece : pieces_) {
    const bool isWhole = std::max(largestComponent(glm::abs(piece.low - pointW)),
                                  largestComponent(glm::abs(piece.high - pointW))) <= reach;
    if (isWhole) {
      add(piece.low);
      add(piece.high);
    } else if (distanceToBox(pointW, piece.low, piece.high) <= std::sqrt(3.0) * reach) {
      for (uint32_t t = 0; t < piece.count; ++t)
        for (const glm::dvec3& p : corners(piece, piece.first + t)) add(p);
    }
  }
  return bounds;
}

}  // namespace restlab
