#include "core/scene/compiled/body_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace restlab {
namespace {

constexpr size_t kListed = 4;  // capacity of a list of media (core/transport/media.glsl)

// Returns whether the mesh is closed and its faces point inwards. The area vectors of a closed mesh
// sum to 0, and its signed volume is negative if faces point inwards.
bool facesInwards(const MeshGeometry& mesh) {
  glm::dvec3 sum(0.0);
  double area = 0.0, volume = 0.0;
  const glm::dvec3 base(mesh.positions.at(mesh.triangles.front().x));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - base,
                     b = glm::dvec3(mesh.positions[t.y]) - base,
                     c = glm::dvec3(mesh.positions[t.z]) - base;
    const glm::dvec3 twice = glm::cross(b - a, c - a);
    sum += twice;
    area += glm::length(twice);
    volume += glm::dot(a, glm::cross(b, c));
  }
  return volume < 0.0 && glm::length(sum) < 1e-4 * area;
}

// Returns the largest number of boxes that contain the centre of one of them.
size_t deepest(const std::vector<BodyBox>& boxes) {
  size_t most = 0;
  for (const BodyBox& inner : boxes) {
    const glm::dvec3 centre = 0.5 * (inner.low + inner.high);
    const auto depth = std::count_if(boxes.begin(), boxes.end(),
                                     [&](const BodyBox& box) { return box.holds(centre); });
    most = std::max(most, size_t(depth));
  }
  return most;
}

bool filmLiesInOneMedium(const Scene& scene, const Bodies& bodies, const SceneCamera& camera) {
  const auto at = [&](double x, double y) {
    return bodiesAt(scene, bodies,
                    glm::dvec3(camera.cameraToWorld *
                               glm::dvec4(x + camera.shift.x, y + camera.shift.y, 0.0, 1.0)));
  };
  const glm::uvec4 centre = at(0.0, 0.0);
  for (const double x : {-camera.xmag, camera.xmag}) {
    for (const double y : {-camera.ymag, camera.ymag}) {
      if (at(x, y) != centre) return false;
    }
  }
  return true;
}

// Returns a warning if the scene has punctual lights and a transmitting surface: shadow rays end at
// surfaces that transmit, and no path hits a light without area.
std::optional<std::string> unreachedLight(const Scene& scene) {
  const auto lamp =
      std::find_if(scene.lights.begin(), scene.lights.end(),
                   [](const PunctualLight& light) { return light.intensity != glm::vec3(0.0f); });
  if (lamp == scene.lights.end()) return std::nullopt;
  constexpr uint32_t kNone = rl::RL_MATERIAL_UNLIT | rl::RL_MATERIAL_BLACK;
  for (const MeshInstance& instance : scene.instances) {
    const rl::Material& m = scene.materials[instance.material].data;
    if ((m.flags & kNone) != 0 || !(m.transmission > 0.0f) || !(m.metallic < 1.0f)) continue;
    return fmt::format(
        "{}: light of '{}' and of other point, spot and directional lamps does not "
        "pass surfaces that transmit, as '{}'; behind them, only lamps with an area "
        "and the environment are seen",
        scene.name, lamp->name, instance.name);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> bodyWarnings(const Scene& scene, const Bodies& bodies) {
  std::vector<std::string> warnings;
  std::vector<BodyBox> boxes;
  std::vector<char> isMeshAsked(scene.geometries.size(), 0);
  for (size_t i = 0; i < bodies.rank.size(); ++i) {
    if (bodies.rank[i] == 0) continue;
    boxes.push_back(bodies.boxes[i]);
    const MeshInstance& instance = scene.instances[i];
    if (isMeshAsked[instance.geometry]++ != 0) continue;
    if (facesInwards(scene.geometries[instance.geometry])) {
      warnings.push_back(fmt::format(
          "{}: '{}' transmits light, and its faces point inwards: its medium is taken to be "
          "outside; turn its triangles over",
          scene.name, instance.name));
    }
  }
  if (bodies.meet && boxes.size() > kListed) {
    const size_t depth = deepest(boxes);
    if (depth > kListed) {
      warnings.push_back(fmt::format(
          "{}: up to {} bodies lie in each other; a path knows the {} of greatest rank there",
          scene.name, depth, kListed));
    }
  }
  for (const SceneCamera& camera : scene.cameras) {
    if (boxes.empty() || camera.kind != rl::RL_CAMERA_ORTHOGRAPHIC) continue;
    if (!filmLiesInOneMedium(scene, bodies, camera)) {
      warnings.push_back(
          fmt::format("{}: the film of camera '{}' lies in several bodies; all of "
                      "its rays begin in the medium at its centre",
                      scene.name, camera.name));
    }
  }
  if (std::optional<std::string> line = unreachedLight(scene)) warnings.push_back(*line);
  return warnings;
}

}  // namespace restlab
