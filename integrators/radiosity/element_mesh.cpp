#include "integrators/radiosity/element_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <tuple>

#include "core/base/error.h"
#include "core/scene/compiled/compiled_scene.h"
#include "integrators/radiosity/radiosity.h"

namespace restlab {

namespace {

using Point = glm::dvec3;

// Vertices are put this share of the way to the middle of an element: one on the edge of a wall
// would lie in the next wall.
constexpr double kInward = 1.0 / 32.0;
// Two shading normals of one smooth surface: the cosine of 3 degrees.
constexpr double kSmoothCosine = 0.99863;
// Triangles that share vertices by cells, and those cells, over the size of elements; the cosine of
// 25 degrees.
constexpr double kFine = 0.25, kCell = 0.25, kCellCosine = 0.9063;
// Divisions of an edge: their number has 15 bits.
constexpr double kMostDivisions = 32767.0;

struct WorldTriangle {
  std::array<Point, 3> corners, normals;  // normals: unit, on the side of the front
  double area = 0.0, longest = 0.0;
};

// Triangles of one instance in world space.
class InstanceTriangles {
 public:
  InstanceTriangles(const rl::SceneData& scene, uint32_t instance)
      : scene_(scene),
        inst_(scene.instances.data[instance]),
        geometry_(scene.geometries.data[inst_.geometry]) {}

  bool isShape() const { return geometry_.shape != rl::RL_SHAPE_TRIANGLES; }
  uint32_t count() const { return isShape() ? 0 : geometry_.triangleCount; }
  const rl::Material& material() const { return scene_.materials.data[inst_.material]; }

  WorldTriangle at(uint32_t primitive) const {
    const glm::uvec3 corners = scene_.triangles.data[geometry_.firstTriangle + primitive];
    WorldTriangle t;
    for (int k = 0; k < 3; ++k)
      t.corners[k] = point(Point(scene_.positions.data[geometry_.firstVertex + corners[k]]));
    Point face = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    if ((inst_.flags & rl::RL_INSTANCE_FLIPPED) != 0) face = -face;
    const double length = glm::length(face);
    t.area = 0.5 * length;
    for (int k = 0; k < 3; ++k)
      t.longest = std::max(t.longest, glm::distance(t.corners[k], t.corners[(k + 1) % 3]));
    face = length > 0.0 ? face / length : Point(0.0, 0.0, 1.0);
    for (int k = 0; k < 3; ++k) {
      Point n = face;
      if (geometry_.normalOffset != rl::RL_INVALID)
        n = normal(Point(scene_.normals.data[geometry_.normalOffset + corners[k]]));
      const double own = glm::length(n);
      n = own > 0.0 ? n / own : face;
      t.normals[k] = glm::dot(n, face) < 0.0 ? -n : n;
    }
    return t;
  }

 private:
  bool isWorld() const { return (inst_.flags & rl::RL_INSTANCE_IDENTITY) != 0; }
  Point point(const Point& p) const {
    if (isWorld()) return p;
    const glm::dvec4 h(p, 1.0);
    return {glm::dot(glm::dvec4(inst_.objectToWorldRow0), h),
            glm::dot(glm::dvec4(inst_.objectToWorldRow1), h),
            glm::dot(glm::dvec4(inst_.objectToWorldRow2), h)};
  }
  Point normal(const Point& n) const {
    if (isWorld()) return n;
    return Point(glm::vec3(inst_.worldToObjectRow0)) * n.x +
           Point(glm::vec3(inst_.worldToObjectRow1)) * n.y +
           Point(glm::vec3(inst_.worldToObjectRow2)) * n.z;
  }

  const rl::SceneData& scene_;
  const rl::Instance& inst_;
  const rl::Geometry& geometry_;
};

uint32_t divisionsOf(const WorldTriangle& t, double size) {
  return static_cast<uint32_t>(
      std::clamp(std::ceil(t.longest / size * (1.0 - 1e-9)), 1.0, kMostDivisions));
}

bool isLambert(const rl::Material& m) {
  return m.closure == 0 && m.transmission == 0.0f && m.metallic == 0.0f && m.specular == 0.0f &&
         (m.flags & rl::RL_MATERIAL_LAYERS) == 0 && m.textures[rl::RL_TEX_NORMAL] == rl::RL_INVALID;
}

template <class Visit>
void forEachTriangle(const CompiledScene& scene, const Visit& visit) {
  const rl::SceneData& data = scene.data();
  for (uint32_t i = 0; i < data.instanceCount; ++i) {
    const InstanceTriangles triangles(data, i);
    for (uint32_t k = 0; k < triangles.count(); ++k) visit(triangles.at(k));
  }
}

uint32_t bitsOf(double x) { return std::bit_cast<uint32_t>(static_cast<float>(x)); }

// A point at a share of an edge, the same to the last bit from both of its triangles.
Point onEdge(const Point& a, const Point& b, uint32_t step, uint32_t steps) {
  const bool isOrdered = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  const Point& from = isOrdered ? a : b;
  const Point& to = isOrdered ? b : a;
  const uint32_t k = isOrdered ? step : steps - step;
  if (k == 0) return from;
  if (k == steps) return to;
  return from + (to - from) * (double(k) / double(steps));
}

// Adds the elements of one triangle after another.
class MeshBuilder {
 public:
  explicit MeshBuilder(ElementMesh& mesh) : mesh_(mesh) {}

  void beginInstance() {
    shared_.clear();
    cells_.clear();
    mesh_.instances.push_back(static_cast<uint32_t>(mesh_.triangles.size() / 2));
  }

  void add(uint32_t instance, uint32_t primitive, const WorldTriangle& t) {
    const uint32_t n = divisionsOf(t, mesh_.size);
    mesh_.triangles.push_back(static_cast<uint32_t>(mesh_.elementCount));
    mesh_.triangles.push_back(n);
    // By row, then along it.
    std::vector<uint32_t> grid;
    std::vector<size_t> rows;
    for (uint32_t j = 0; j <= n; ++j) {
      rows.push_back(grid.size());
      for (uint32_t i = 0; i + j <= n; ++i) grid.push_back(vertex(instance, primitive, t, i, j, n));
    }
    const auto at = [&](uint32_t i, uint32_t j) { return grid[rows[j] + i]; };
    for (uint32_t j = 0; j < n; ++j) {
      for (uint32_t i = 0; i + j < n; ++i) {
        element(instance, primitive, t, {at(i, j), at(i + 1, j), at(i, j + 1)}, {i, j, 0, n});
        if (i + j + 1 < n)
          element(instance, primitive, t, {at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)},
                  {i, j, 1, n});
      }
    }
  }

  void finish() {
    for (size_t v = 0; v < mesh_.vertexCount; ++v)
      mesh_.vertices[v * kVertexWords + 4] = bitsOf(areas_[v]);
  }

 private:
  static constexpr size_t kVertexWords = 4 * rl::RL_RADIOSITY_VERTEX_UVEC4S;
  struct Known {
    Point normal;
    uint32_t vertex;
  };
  using Key = std::tuple<double, double, double>;

  uint32_t vertex(uint32_t instance, uint32_t primitive, const WorldTriangle& t, uint32_t i,
                  uint32_t j, uint32_t n) {
    const auto& [a, b, c] = t.corners;
    const double u = double(i) / n, v = double(j) / n;
    Point p = a + (b - a) * u + (c - a) * v;
    const bool isInside = i > 0 && j > 0 && i + j < n;
    if (j == 0)
      p = onEdge(a, b, i, n);
    else if (i == 0)
      p = onEdge(a, c, j, n);
    else if (i + j == n)
      p = onEdge(b, c, j, n);
    const auto& [na, nb, nc] = t.normals;
    const Point normal = glm::normalize(na * (1.0 - u - v) + nb * u + nc * v);
    const bool isFine = t.longest < kFine * mesh_.size;
    std::vector<Known>* known = nullptr;
    if (!isInside) {
      const Point cell = glm::floor(p / (kCell * mesh_.size));
      const Point& key = isFine ? cell : p;
      known = &(isFine ? cells_ : shared_)[{key.x, key.y, key.z}];
      for (const Known& other : *known)
        if (glm::dot(other.normal, normal) > (isFine ? kCellCosine : kSmoothCosine))
          return other.vertex;
    }
    const uint32_t index = static_cast<uint32_t>(mesh_.vertexCount++);
    if (known != nullptr) known->push_back({normal, index});
    areas_.push_back(0.0);
    // The middle of an element at this corner.
    const double third = 1.0 / (3.0 * n);
    double middleU = u + third, middleV = v + third;
    if (i + j == n) {
      middleU = i > 0 ? u - 2.0 * third : u + third;
      middleV = i > 0 ? v + third : v - 2.0 * third;
    }
    for (const uint32_t word : {instance, primitive, bitsOf(u + (middleU - u) * kInward),
                                bitsOf(v + (middleV - v) * kInward), 0u, 0u, 0u, 0u})
      mesh_.vertices.push_back(word);
    return index;
  }

  struct Cell {
    uint32_t i, j, isTurned, divisions;
  };
  void element(uint32_t instance, uint32_t primitive, const WorldTriangle& t,
               const std::array<uint32_t, 3>& corners, const Cell& cell) {
    const double area = t.area / (double(cell.divisions) * cell.divisions);
    for (const uint32_t corner : corners) areas_[corner] += area / 3.0;
    for (const uint32_t word :
         {corners[0], corners[1], corners[2], bitsOf(area), instance, primitive,
          cell.i | cell.j << 15u | cell.isTurned << 30u, cell.divisions})
      mesh_.elements.push_back(word);
    ++mesh_.elementCount;
  }

  ElementMesh& mesh_;
  std::map<Key, std::vector<Known>> shared_, cells_;  // of this instance
  std::vector<double> areas_;
};

}  // namespace

void requireTriangles(const CompiledScene& scene) {
  const rl::SceneData& data = scene.data();
  for (uint32_t i = 0; i < data.instanceCount; ++i) {
    if (!InstanceTriangles(data, i).isShape()) continue;
    failInput(
        fmt::format("radiosity: scene {}: instance '{}' is a shape and has no triangles: "
                    "restlab convert writes shapes as meshes",
                    scene.source().name, scene.source().instances.at(i).name));
  }
}

size_t countElements(const CompiledScene& scene, double size) {
  size_t count = 0;
  forEachTriangle(scene, [&](const WorldTriangle& t) {
    const size_t n = divisionsOf(t, size);
    count += n * n;
  });
  return count;
}

double elementSizeOf(const CompiledScene& scene, size_t elements) {
  double area = 0.0;
  forEachTriangle(scene, [&](const WorldTriangle& t) { area += t.area; });
  if (!(area > 0.0)) {
    failInput(fmt::format("radiosity: scene {} has no triangle with an area", scene.source().name));
  }
  // Elements are half squares of that area, with the diagonal as their longest edge.
  return std::sqrt(4.0 * area / double(elements));
}

std::shared_ptr<const ElementMesh> makeElementMesh(const CompiledScene& scene, double size) {
  auto mesh = std::make_shared<ElementMesh>();
  mesh->size = size;
  const rl::SceneData& data = scene.data();
  MeshBuilder builder(*mesh);
  double other = 0.0;
  for (uint32_t i = 0; i < data.instanceCount; ++i) {
    const InstanceTriangles triangles(data, i);
    builder.beginInstance();
    for (uint32_t k = 0; k < triangles.count(); ++k) {
      const WorldTriangle t = triangles.at(k);
      builder.add(i, k, t);
      mesh->areaM2 += t.area;
      if (!isLambert(triangles.material())) other += t.area;
    }
  }
  builder.finish();
  mesh->otherThanLambert = mesh->areaM2 > 0.0 ? other / mesh->areaM2 : 0.0;
  return mesh;
}

}  // namespace restlab
