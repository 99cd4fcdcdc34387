#include "core/scene/crease.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace restlab {
namespace {

struct PositionLess {
  bool operator()(const glm::vec3& a, const glm::vec3& b) const {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
  }
};

// Place of each vertex: a number that all vertices in one position share.
std::vector<uint32_t> placesOf(const MeshGeometry& mesh) {
  std::vector<uint32_t> order(mesh.positions.size()), places(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const PositionLess less;
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return less(mesh.positions[a], mesh.positions[b]); });
  for (size_t i = 0; i < order.size(); ++i) {
    const bool isNew = i == 0 || less(mesh.positions[order[i - 1]], mesh.positions[order[i]]);
    places[order[i]] = isNew ? order[i] : places[order[i - 1]];
  }
  return places;
}

// Sets of corners (3 a triangle) that share a normal.
class CornerSets {
 public:
  explicit CornerSets(size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }
  uint32_t find(uint32_t corner) {
    while (parents_[corner] != corner) corner = parents_[corner] = parents_[parents_[corner]];
    return corner;
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parents_;
};

glm::dvec3 faceNormal(const MeshGeometry& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]);
  const glm::dvec3 n =
      glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
  const double length = glm::length(n);
  return length > 0.0 ? n / length : glm::dvec3(0.0);
}

double angleAt(const MeshGeometry& mesh, const glm::uvec3& t, int corner) {
  const glm::dvec3 p(mesh.positions[t[corner]]);
  const glm::dvec3 u = glm::dvec3(mesh.positions[t[(corner + 1) % 3]]) - p;
  const glm::dvec3 v = glm::dvec3(mesh.positions[t[(corner + 2) % 3]]) - p;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

bool isSlim(const glm::dvec3& faceNormal) { return faceNormal == glm::dvec3(0.0); }

// The angle of directions about an axis.
class Turn {
 public:
  explicit Turn(const glm::dvec3& axis) {
    const double length = glm::length(axis);
    if (!(length > 0.0)) return;
    const glm::dvec3 z = axis / length;
    x_ = glm::normalize(
        glm::cross(z, std::abs(z.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    y_ = glm::cross(z, x_);
  }
  double angle(const glm::dvec3& direction) const {
    return std::atan2(glm::dot(direction, y_), glm::dot(direction, x_));
  }

 private:
  glm::dvec3 x_{1, 0, 0}, y_{0, 1, 0};
};

// Gives each corner of a face without an area the normal of another face at its vertex, or else in
// its place.
void joinSlimCorners(const MeshGeometry& mesh, const std::vector<glm::dvec3>& faces,
                     const std::vector<uint32_t>& places, CornerSets& sets) {
  constexpr uint32_t kNone = ~0u;
  std::vector<uint32_t> atVertex(mesh.positions.size(), kNone), atPlace(atVertex);
  const auto count = uint32_t(3 * mesh.triangles.size());
  const auto vertexOf = [&](uint32_t corner) {
    return mesh.triangles[corner / 3][int(corner % 3)];
  };
  for (uint32_t corner = 0; corner < count; ++corner) {
    if (isSlim(faces[corner / 3])) continue;
    const uint32_t vertex = vertexOf(corner);
    if (atVertex[vertex] == kNone) atVertex[vertex] = corner;
    if (atPlace[places[vertex]] == kNone) atPlace[places[vertex]] = corner;
  }
  for (uint32_t corner = 0; corner < count; ++corner) {
    if (!isSlim(faces[corner / 3])) continue;
    const uint32_t vertex = vertexOf(corner);
    const uint32_t other = atVertex[vertex] != kNone ? atVertex[vertex] : atPlace[places[vertex]];
    if (other != kNone) sets.join(corner, other);
  }
}

// Joins the corners at both ends of every edge that is not sharper than the angle.
CornerSets joinedCorners(const MeshGeometry& mesh, const std::vector<glm::dvec3>& faces,
                         double degrees) {
  CornerSets sets(3 * mesh.triangles.size());
  const double least = std::cos(degrees * std::numbers::pi / 180.0);
  const std::vector<uint32_t> places = placesOf(mesh);
  struct Edge {
    uint32_t low, high;      // places
    uint32_t atLow, atHigh;  // corners
  };
  std::vector<Edge> edges;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (isSlim(faces[t])) continue;  // it would join its neighbours through itself
    for (uint32_t c = 0; c < 3; ++c) {
      const uint32_t next = (c + 1) % 3;
      Edge edge{places[mesh.triangles[t][int(c)]], places[mesh.triangles[t][int(next)]], 3 * t + c,
                3 * t + next};
      if (edge.low > edge.high) {
        std::swap(edge.low, edge.high);
        std::swap(edge.atLow, edge.atHigh);
      }
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.atLow) < std::tie(b.low, b.high, b.atLow);
  });
  // Rounding: faces of one plane, and faces at exactly the angle, are joined.
  constexpr double kRounding = 1e-6;
  std::vector<std::pair<double, Edge>> around;
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    const glm::dvec3 low(mesh.positions[edges[i].low]), high(mesh.positions[edges[i].high]);
    const Turn turn(high - low);
    around.clear();
    for (end = i;
         end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high;
         ++end)
      around.emplace_back(turn.angle(faces[edges[end].atLow / 3]), edges[end]);
    // Normals of the faces at an edge lie on a circle: where two of them are near, so are all
    // between them, and joining neighbours joins all that joining every pair would.
    std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second.atLow) < std::tie(b.first, b.second.atLow);
    });
    for (size_t k = 0; k < around.size() && around.size() > 1; ++k) {
      const Edge &a = around[k].second, &b = around[(k + 1) % around.size()].second;
      if (glm::dot(faces[a.atLow / 3], faces[b.atLow / 3]) < least - kRounding) continue;
      sets.join(a.atLow, b.atLow);
      sets.join(a.atHigh, b.atHigh);
    }
  }
  joinSlimCorners(mesh, faces, places, sets);
  return sets;
}

template <class T>
void repeatVertex(std::vector<T>& values, uint32_t vertex) {
  if (!values.empty()) values.push_back(T(values[vertex]));
}

}  // namespace

void flattenNormals(MeshGeometry& mesh) { mesh.normals.clear(); }

void smoothNormals(MeshGeometry& mesh, double degrees) {
  std::vector<glm::dvec3> faces;
  for (const glm::uvec3& t : mesh.triangles) faces.push_back(faceNormal(mesh, t));
  CornerSets sets = joinedCorners(mesh, faces, degrees);
  std::vector<glm::dvec3> sums(3 * mesh.triangles.size(), glm::dvec3(0.0));
  for (uint32_t corner = 0; corner < sums.size(); ++corner)
    sums[sets.find(corner)] +=
        angleAt(mesh, mesh.triangles[corner / 3], int(corner % 3)) * faces[corner / 3];
  // A vertex whose corners are in several sets becomes several vertices.
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  std::unordered_map<uint64_t, uint32_t> vertexOf;  // by vertex and set
  std::vector<char> isTaken(mesh.positions.size(), 0);
  for (uint32_t corner = 0; corner < sums.size(); ++corner) {
    uint32_t& vertex = mesh.triangles[corner / 3][int(corner % 3)];
    const uint32_t set = sets.find(corner), old = vertex;
    const auto [found, isNew] = vertexOf.try_emplace(uint64_t{old} << 32 | set, old);
    if (isNew && isTaken[old] != 0) {
      found->second = uint32_t(mesh.positions.size());
      repeatVertex(mesh.positions, old);
      repeatVertex(mesh.normals, old);
      repeatVertex(mesh.tangents, old);
      repeatVertex(mesh.colors, old);
      for (auto& uvs : mesh.uvs) repeatVertex(uvs, old);
    }
    if (isNew) {
      isTaken[old] = 1;
      const glm::dvec3 n = sums[set] != glm::dvec3(0.0) ? sums[set] : faces[corner / 3];
      if (n != glm::dvec3(0.0)) mesh.normals[found->second] = glm::vec3(glm::normalize(n));
    }
    vertex = found->second;
  }
}

}  // namespace restlab
