#include "core/scene/builtin/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <stdexcept>
#include <utility>

namespace restlab::builtin {
namespace {

// Returns unit vectors and faces of an icosahedron, from the three golden rectangles.
void icosahedron(std::vector<glm::dvec3>& directions, std::vector<glm::uvec3>& faces) {
  const double g = glm::golden_ratio<double>();
  directions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::dvec3& d : directions) d = glm::normalize(d);
  faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
}

// Splits every face into four; the two faces of an edge share the new vertex, so no crack opens.
void subdivide(std::vector<glm::dvec3>& directions, std::vector<glm::uvec3>& faces) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto key = std::minmax(a, b);
    const auto [entry, isNew] =
        middles.try_emplace({key.first, key.second}, uint32_t(directions.size()));
    if (isNew) directions.push_back(glm::normalize(directions[a] + directions[b]));
    return entry->second;
  };
  std::vector<glm::uvec3> split;
  split.reserve(faces.size() * 4);
  for (const glm::uvec3& f : faces) {
    const uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
    split.insert(split.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
  }
  faces = std::move(split);
}

}  // namespace

MeshGeometry quads(const std::string& name, const std::vector<glm::dvec3>& corners) {
  if (corners.empty() || corners.size() % 4 != 0)
    throw std::logic_error("quads: not a multiple of four corners");
  MeshGeometry mesh;
  mesh.name = name;
  for (uint32_t first = 0; first < corners.size(); first += 4) {
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  for (const glm::dvec3& p : corners) mesh.positions.push_back(glm::vec3(p));
  return mesh;
}

MeshGeometry quad(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                  const glm::dvec3& v) {
  return quads(name, {corner, corner + u, corner + u + v, corner + v});
}

MeshGeometry grid(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                  const glm::dvec3& v, uint32_t columns, uint32_t rows) {
  MeshGeometry mesh;
  mesh.name = name;
  mesh.positions.reserve(size_t(columns + 1) * (rows + 1));
  mesh.triangles.reserve(size_t(columns) * rows * 2);
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i <= columns; ++i) {
      mesh.positions.push_back(
          glm::vec3(corner + u * (double(i) / columns) + v * (double(j) / rows)));
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

MeshGeometry box(const std::string& name, const glm::dvec3& low, const glm::dvec3& high) {
  if (!(low.x < high.x && low.y < high.y && low.z < high.z))
    throw std::logic_error("box: low is not below high");
  MeshGeometry mesh;
  mesh.name = name;
  for (uint32_t i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        glm::vec3((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z));
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

MeshGeometry sphere(const std::string& name, const glm::dvec3& center, double radius, int level,
                    bool smooth) {
  std::vector<glm::dvec3> directions;
  MeshGeometry mesh;
  mesh.name = name;
  icosahedron(directions, mesh.triangles);
  for (int i = 0; i < level; ++i) subdivide(directions, mesh.triangles);
  for (const glm::dvec3& d : directions) {
    mesh.positions.push_back(glm::vec3(center + radius * d));
    if (smooth) mesh.normals.push_back(glm::vec3(d));
  }
  return mesh;
}

MeshGeometry cylinder(const std::string& name, const glm::dvec3& baseCenter, double radius,
                      double height, int segments) {
  MeshGeometry mesh;
  mesh.name = name;
  const auto vertex = [&](const glm::dvec3& offset, const glm::dvec3& normal) {
    mesh.positions.push_back(glm::vec3(baseCenter + offset));
    mesh.normals.push_back(glm::vec3(normal));
  };
  const uint32_t n = uint32_t(segments);
  // Four rings: side below and above, bottom cap, top cap; then the two centres.
  for (int ring = 0; ring < 4; ++ring) {
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * glm::pi<double>() * double(i) / double(n);
      const glm::dvec3 out(std::cos(angle), 0.0, -std::sin(angle));
      const bool isTop = ring == 1 || ring == 3;
      const glm::dvec3 cap(0.0, isTop ? 1.0 : -1.0, 0.0);
      vertex(radius * out + glm::dvec3(0.0, isTop ? height : 0.0, 0.0), ring < 2 ? out : cap);
    }
  }
  vertex({0, 0, 0}, {0, -1, 0});
  vertex({0, height, 0}, {0, 1, 0});
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
    mesh.triangles.push_back({4 * n, 2 * n + j, 2 * n + i});
    mesh.triangles.push_back({4 * n + 1, 3 * n + i, 3 * n + j});
  }
  return mesh;
}

void append(MeshGeometry& mesh, const MeshGeometry& part) {
  if (!mesh.positions.empty() && mesh.normals.empty() != part.normals.empty()) {
    throw std::logic_error("append: only one of '" + mesh.name + "' and '" + part.name +
                           "' has normals");
  }
  const uint32_t first = uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
  for (const glm::uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
}

MeshGeometry transformed(MeshGeometry mesh, const glm::dmat4& transform) {
  const glm::dmat3 normalTransform = glm::inverseTranspose(glm::dmat3(transform));
  for (glm::vec3& p : mesh.positions) p = glm::vec3(transform * glm::dvec4(p, 1.0));
  for (glm::vec3& n : mesh.normals) n = glm::vec3(glm::normalize(normalTransform * glm::dvec3(n)));
  if (glm::determinant(glm::dmat3(transform)) < 0.0) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  }
  return mesh;
}

MeshGeometry insideOut(MeshGeometry mesh) {
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : mesh.normals) n = -n;
  return mesh;
}

glm::dmat4 turnAbout(const glm::dvec3& pivot, double degrees) {
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), pivot);
  m = glm::rotate(m, glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0));
  return glm::translate(m, -pivot);
}

}  // namespace restlab::builtin
