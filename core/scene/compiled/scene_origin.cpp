#include "core/scene/compiled/scene_origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/camera_path/sight.h"

namespace restlab {

namespace {

constexpr int kRaysASide = 7;  // rays per side of the view

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Size that must be resolved at a distance (SceneOrigin::viewSize), metres.
double sizeAt(const SceneCamera& camera, double distance) {
  if (camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC) return 2.0 * camera.ymag;
  return std::min(distance, 2.0 * distance * std::tan(0.5 * camera.yfov));
}

struct Seen {
  double distance;
  glm::dvec3 pointW;
};

// Finds the first surfaces on a grid of rays, nearest first. The aspect ratio is taken as 1.
std::vector<Seen> seenBy(const Sight& sight, const SceneCamera& camera) {
  const glm::dmat4& m = camera.cameraToWorld;
  const glm::dvec3 eye(m[3]), back = glm::normalize(glm::dvec3(m[2]));
  const glm::dvec3 up = glm::normalize(glm::cross(back, glm::dvec3(m[0])));
  const glm::dvec3 right = glm::cross(up, back);
  const bool isParallel = camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC;
  const double half = isParallel ? camera.ymag : std::tan(0.5 * camera.yfov);
  std::vector<Seen> seen;
  for (int i = 0; i < kRaysASide * kRaysASide; ++i) {
    const double x = (2.0 * (i % kRaysASide + 0.5) / kRaysASide - 1.0) * half + camera.shift.x;
    const double y = (2.0 * (i / kRaysASide + 0.5) / kRaysASide - 1.0) * half + camera.shift.y;
    const glm::dvec3 film = right * x + up * y;
    const glm::dvec3 from = isParallel ? eye + film : eye;
    const glm::dvec3 dir = isParallel ? -back : glm::normalize(film - back);
    const double distance = sight.distanceTo(from, dir);
    if (std::isfinite(distance)) seen.push_back({distance, from + distance * dir});
  }
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return a.distance < b.distance; });
  return seen;
}

}  // namespace

SceneOrigin originOf(const Scene& scene, uint32_t cameraIndex) {
  SceneOrigin origin;
  const auto bounds = worldBounds(scene);
  origin.originW = 0.5 * (bounds[0] + bounds[1]);
  if (cameraIndex >= scene.cameras.size()) return origin;
  const SceneCamera& camera = scene.cameras[cameraIndex];
  const glm::dvec3 eye(camera.cameraToWorld[3]);
  const double reach = largest(0.5 * (bounds[1] - bounds[0]));
  const auto isHarmless = [&](double coordinate, double distance) {
    return coordinate <= kHarmlessReach * sizeAt(camera, distance);
  };
  const Sight sight(scene);
  // Lower bound on the distance of anything that the camera sees.
  const double nearest =
      sight.distanceToNearest(eye, reach / (kHarmlessReach * sizeAt(camera, 1.0)));
  if (isHarmless(reach, nearest)) return origin;
  const std::vector<Seen> seen = seenBy(sight, camera);
  const Seen median = seen.empty() ? Seen{nearest, eye} : seen[seen.size() / 2];
  origin.viewSize = sizeAt(camera, median.distance);
  if (!(origin.viewSize > 0.0) || !std::isfinite(origin.viewSize)) {
    origin.viewSize = 0.0;
    return origin;
  }
  origin.eyeW = eye;
  origin.focusW = median.pointW;
  std::vector<double> coordinates;  // over the size to be resolved at that point
  for (const Seen& one : seen.empty() ? std::vector<Seen>{median} : seen)
    coordinates.push_back(largest(one.pointW - origin.originW) / sizeAt(camera, one.distance));
  std::nth_element(coordinates.begin(), coordinates.begin() + ptrdiff_t(coordinates.size() / 2),
                   coordinates.end());
  if (coordinates[coordinates.size() / 2] <= kHarmlessReach) return origin;
  origin.followsCamera = true;
  const auto around = sight.boundsWithin(origin.focusW, kHarmlessReach * origin.viewSize);
  origin.originW = around[0].x <= around[1].x ? 0.5 * (around[0] + around[1]) : origin.focusW;
  return origin;
}

std::vector<std::string> farFromOrigin(const Scene& scene, const SceneOrigin& origin) {
  std::vector<std::string> lines;
  if (!origin.followsCamera) return lines;
  const auto spacing = [](double coordinate) {
    const auto at = static_cast<float>(std::min(coordinate, 1e38));
    return double(std::nextafter(at, std::numeric_limits<float>::infinity())) - double(at);
  };
  constexpr double kVisible = 1e-3;  // fraction of an object's size
  double most = 0.0, mostDistance = 0.0, mostRounding = 0.0;
  size_t count = 0;
  std::string name;
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& mesh = scene.geometries[instance.geometry];
    if (mesh.positions.empty()) continue;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::vec3& p : mesh.positions) {
      const glm::dvec3 at(instance.objectToWorld * glm::dvec4(p, 1.0));
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    const double size = glm::length(high - low);
    const double distance =
        glm::length(glm::max(glm::max(low - origin.originW, origin.originW - high), 0.0));
    const double rounding = spacing(distance);
    if (!(rounding > kVisible * size)) continue;
    ++count;
    if (rounding <= most * size) continue;
    most = rounding / std::max(size, 1e-300);
    mostDistance = distance;
    mostRounding = rounding;
    name = instance.name;
  }
  const std::string& camera = scene.cameras.at(scene.mainCamera).name;
  if (count > 0) {
    lines.push_back(
        fmt::format("{}: {}: lies {:.2g} m from what camera '{}' sees: float32 rounds its vertices "
                    "to {:.2g} m, "
                    "{:.2g} of its size{}; move it nearer or leave it out",
                    scene.name, name, mostDistance, camera, mostRounding, most,
                    count > 1 ? fmt::format(" (and {} more objects)", count - 1) : ""));
  }
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const SceneCamera& other = scene.cameras[i];
    const double distance = largest(glm::dvec3(other.cameraToWorld[3]) - origin.originW);
    if (distance <= kHarmlessReach * origin.viewSize) continue;
    if (i == scene.mainCamera) {
      // Narrow view from afar: float32 rounds the camera's own position.
      if (!(spacing(distance) > kVisible * origin.viewSize)) continue;
      lines.push_back(fmt::format(
          "{}: camera '{}' stands {:.2g} m from what it sees, {:.2g} m of it: float32 rounds its "
          "place to {:.2g} m; move it nearer",
          scene.name, other.name, distance, origin.viewSize, spacing(distance)));
      break;
    }
    lines.push_back(fmt::format(
        "{}: camera '{}' stands {:.2g} m from what camera '{}' sees, whose numbers hold best: "
        "float32 rounds points there to {:.2g} m; render it by --camera",
        scene.name, other.name, distance, camera, spacing(distance)));
    break;
  }
  return lines;
}

}  // namespace restlab
