#include "core/scene/compiled/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/shapes/shape_info.h"
#include "core/transport/walk.h"

namespace restlab {
namespace {

bool meet(const BodyBox& a, const BodyBox& b) {
  return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

double volumeOf(const BodyBox& box) {
  const glm::dvec3 size = box.high - box.low;
  return size.x * size.y * size.z;
}

glm::dvec3 toWorld(const MeshInstance& instance, const glm::vec3& p) {
  return glm::dvec3(instance.objectToWorld * glm::dvec4(glm::dvec3(p), 1.0));
}

// Computes the world box of an instance, widened by the float32 rounding of a corner: bodies that
// touch exactly must also touch after rounding.
BodyBox boxOf(const MeshGeometry& mesh, const MeshInstance& instance) {
  BodyBox box{glm::dvec3(std::numeric_limits<double>::infinity()),
              glm::dvec3(-std::numeric_limits<double>::infinity())};
  const auto add = [&](const glm::vec3& p) {
    const glm::dvec3 w = toWorld(instance, p);
    box.low = glm::min(box.low, w);
    box.high = glm::max(box.high, w);
  };
  if (mesh.shape != nullptr) {
    const std::array<glm::vec3, 2> own = mesh.shape->info->box(*mesh.shape);
    for (size_t corner = 0; corner < 8; ++corner)
      add({own[corner & 1].x, own[corner >> 1 & 1].y, own[corner >> 2].z});
  } else {
    for (const glm::vec3& p : mesh.positions) add(p);
  }
  const glm::dvec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
  const double margin = 1e-5 * std::max({far.x, far.y, far.z});
  box.low -= margin;
  box.high += margin;
  return box;
}

bool anyMeet(std::vector<BodyBox> boxes) {
  std::sort(boxes.begin(), boxes.end(),
            [](const BodyBox& a, const BodyBox& b) { return a.low.x < b.low.x; });
  for (size_t i = 0; i < boxes.size(); ++i) {
    for (size_t j = i + 1; j < boxes.size() && boxes[j].low.x <= boxes[i].high.x; ++j) {
      if (meet(boxes[i], boxes[j])) return true;
    }
  }
  return false;
}

// Counts the surfaces where the ray leaves the mesh minus those where it enters; above 0 if `posW`
// is inside.
int leavesOf(const MeshGeometry& mesh, const MeshInstance& instance, const glm::dvec3& posW,
             const glm::dvec3& dirW) {
  const bool isMirrored = glm::determinant(glm::dmat3(instance.objectToWorld)) < 0.0;
  int leaves = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    // Decide by signs of volumes: an edge shared by two triangles has one value for both.
    const glm::dvec3 a = toWorld(instance, mesh.positions[t.x]) - posW,
                     b = toWorld(instance, mesh.positions[t.y]) - posW,
                     c = toWorld(instance, mesh.positions[t.z]) - posW;
    const double u = glm::dot(dirW, glm::cross(b, c)), v = glm::dot(dirW, glm::cross(c, a)),
                 w = glm::dot(dirW, glm::cross(a, b));
    const bool isAlong = (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0);
    const double sum = u + v + w;
    if (!isAlong || !(glm::dot(a, glm::cross(b, c)) / sum > 0.0)) continue;
    const bool isLeft = (sum > 0.0) != isMirrored;
    leaves += isLeft ? 1 : -1;
  }
  return leaves;
}

// Counts the shells of the mesh around the point: bodies of one mesh may overlap.
int shellsAround(const MeshGeometry& mesh, const MeshInstance& instance, const glm::dvec3& posW) {
  if (mesh.shape != nullptr) {
    const glm::dvec4 posL = glm::inverse(instance.objectToWorld) * glm::dvec4(posW, 1.0);
    const ShapeInfo& info = *mesh.shape->info;
    if (!info.isClosed(*mesh.shape)) return 0;
    return info.isInside(*mesh.shape, glm::dvec3(posL)) ? 1 : 0;
  }
  // Directions along which no modeller aligns edges; the median of the three answers counts.
  constexpr std::array<glm::dvec3, 3> kDirs{glm::dvec3{0.5773, 0.2113, 0.7887},
                                            glm::dvec3{-0.3141, 0.8347, -0.4523},
                                            glm::dvec3{0.1193, -0.6871, 0.7167}};
  std::array<int, 3> leaves{};
  for (size_t i = 0; i < 3; ++i) leaves[i] = leavesOf(mesh, instance, posW, kDirs[i]);
  std::sort(leaves.begin(), leaves.end());
  return std::max(leaves[1], 0);
}

}  // namespace

bool isBody(const rl::Material& m) {
  constexpr uint32_t kNone = rl::RL_MATERIAL_UNLIT | rl::RL_MATERIAL_BLACK | rl::RL_MATERIAL_THIN;
  return (m.flags & kNone) == 0 && m.transmission > 0.0f && m.metallic < 1.0f && m.ior > 0.0f;
}

Bodies findBodies(const Scene& scene) {
  struct Body {
    uint32_t instance;
    int priority;
    double volume;
  };
  Bodies bodies;
  bodies.rank.assign(scene.instances.size(), 0u);
  bodies.boxes.resize(scene.instances.size());
  std::vector<Body> order;
  std::vector<BodyBox> boxes;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    const MeshGeometry& mesh = scene.geometries[instance.geometry];
    const SceneMaterial& material = scene.materials[instance.material];
    if (mesh.triangles.empty() || !isBody(material.data)) continue;
    boxes.push_back(boxOf(mesh, instance));
    bodies.boxes[i] = boxes.back();
    order.push_back({i, material.priority, volumeOf(boxes.back())});
  }
  if (order.empty()) return bodies;
  bodies.meet = anyMeet(std::move(boxes));
  std::stable_sort(order.begin(), order.end(), [](const Body& a, const Body& b) {
    if (a.priority != b.priority) return a.priority < b.priority;
    return a.volume > b.volume;
  });
  bodies.media = {{0.0f, 0.0f, 0.0f, 1.0f}, glm::vec4(0.0f)};
  for (const Body& body : order) {
    bodies.rank[body.instance] = static_cast<uint32_t>(bodies.media.size() / 2);
    const SceneMaterial& m = scene.materials[scene.instances[body.instance].material];
    // A profile knows no directions: it takes the medium that scatters to all sides and spreads
    // light as far (similarity).
    const bool hasDiffusion = m.hasDiffusion && m.sigmaScattering != glm::vec3(0.0f);
    const glm::vec3 scattering = m.sigmaScattering * (hasDiffusion ? 1.0f - m.phase : 1.0f);
    bodies.media.emplace_back(m.data.sigmaAbsorption + scattering, m.data.ior);
    bodies.media.emplace_back(scattering, hasDiffusion ? rl::RL_PHASE_DIFFUSION : m.phase);
  }
  return bodies;
}

bool bodyMeetsAnother(const Bodies& bodies, size_t instance) {
  for (size_t i = 0; i < bodies.rank.size(); ++i) {
    if (i != instance && bodies.rank[i] != 0u && meet(bodies.boxes[i], bodies.boxes[instance]))
      return true;
  }
  return false;
}

glm::uvec4 bodiesAt(const Scene& scene, const Bodies& bodies, const glm::dvec3& posW) {
  std::vector<uint32_t> ranks;
  for (size_t i = 0; i < bodies.rank.size(); ++i) {
    if (bodies.rank[i] == 0u) continue;
    const MeshInstance& instance = scene.instances[i];
    const MeshGeometry& mesh = scene.geometries[instance.geometry];
    if (!bodies.boxes[i].holds(posW)) continue;
    ranks.insert(ranks.end(), shellsAround(mesh, instance, posW), bodies.rank[i]);
  }
  std::sort(ranks.rbegin(), ranks.rend());
  ranks.resize(4, 0u);
  return {ranks[0], ranks[1], ranks[2], ranks[3]};
}

}  // namespace restlab
