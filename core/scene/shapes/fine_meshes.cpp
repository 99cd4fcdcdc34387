#include "core/scene/shapes/fine_meshes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/scene/shapes/shape_info.h"

namespace restlab {
namespace {

constexpr uint32_t kSegments = 128;  // about the axis: off the circle by 0.03 % of the radius
constexpr uint32_t kRows = 64;       // of a sphere, and around the tube of a torus

void addVertex(MeshGeometry& mesh, const glm::dvec3& p, const glm::dvec3& n, const glm::dvec2& uv) {
  mesh.positions.push_back(p);
  mesh.normals.push_back(n);
  mesh.uvs[0].push_back(uv);
}

// Direction in the plane; the last segment ends exactly where the first begins.
glm::dvec2 around(double segment) {
  const double phi = 2.0 * std::numbers::pi * std::fmod(segment, double(kSegments)) / kSegments;
  return {std::cos(phi), std::sin(phi)};
}

// Corners at n +- u +- v, with texture coordinates along u and v.
void addSquare(MeshGeometry& mesh, const glm::dvec3& centre, const glm::dvec3& normal,
               const glm::dvec3& u, const glm::dvec3& v) {
  const uint32_t first = uint32_t(mesh.positions.size());
  for (int i = 0; i < 4; ++i) {
    const glm::dvec2 uv(i == 1 || i == 2 ? 1.0 : 0.0, i >= 2 ? 1.0 : 0.0);
    addVertex(mesh, centre + u * (2.0 * uv.x - 1.0) + v * (2.0 * uv.y - 1.0), normal, uv);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

MeshGeometry rectangleMesh() {
  MeshGeometry mesh;
  addSquare(mesh, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  return mesh;
}

MeshGeometry cubeMesh() {
  MeshGeometry mesh;
  constexpr double kFaces[6][9] = {// normal, axis of u, axis of v
                                   {1, 0, 0, 0, 1, 0, 0, 0, -1},  {-1, 0, 0, 0, 1, 0, 0, 0, 1},
                                   {0, 1, 0, -1, 0, 0, 0, 0, -1}, {0, -1, 0, 0, 0, 1, 1, 0, 0},
                                   {0, 0, 1, 0, 1, 0, 1, 0, 0},   {0, 0, -1, 0, -1, 0, 1, 0, 0}};
  for (const auto& f : kFaces) {
    const glm::dvec3 normal(f[0], f[1], f[2]);
    addSquare(mesh, normal, normal, {f[3], f[4], f[5]}, {f[6], f[7], f[8]});
  }
  return mesh;
}

void addDisk(MeshGeometry& mesh, double z, double side) {
  const glm::dvec3 normal(0.0, 0.0, side);
  for (uint32_t i = 0; i < kSegments; ++i) {
    const uint32_t first = uint32_t(mesh.positions.size());
    addVertex(mesh, {0, 0, z}, normal, {0.0, (i + 0.5) / kSegments});
    for (uint32_t k = i; k <= i + 1; ++k)
      addVertex(mesh, glm::dvec3(around(k), z), normal, {1.0, double(k) / kSegments});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

MeshGeometry diskMesh() {
  MeshGeometry mesh;
  addDisk(mesh, 0.0, 1.0);
  return mesh;
}

MeshGeometry cylinderMesh(bool hasEnds) {
  MeshGeometry mesh;
  for (uint32_t i = 0; i <= kSegments; ++i) {
    const glm::dvec2 d = around(i);
    for (int end = 0; end < 2; ++end)
      addVertex(mesh, {d.x, d.y, double(end)}, glm::dvec3(d, 0.0),
                {double(i) / kSegments, double(end)});
  }
  for (uint32_t i = 0; i < kSegments; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  if (hasEnds) addDisk(mesh, 0.0, -1.0);
  if (hasEnds) addDisk(mesh, 1.0, 1.0);
  return mesh;
}

// The tip is a vertex for each segment, with the normal of its middle.
MeshGeometry coneMesh(bool hasBase) {
  MeshGeometry mesh;
  const double slope = std::sqrt(0.5);
  for (uint32_t i = 0; i < kSegments; ++i) {
    const uint32_t first = uint32_t(mesh.positions.size());
    for (uint32_t k = i; k <= i + 1; ++k)
      addVertex(mesh, glm::dvec3(around(k), 0.0), glm::dvec3(around(k) * slope, slope),
                {double(k) / kSegments, 1.0});
    addVertex(mesh, {0, 0, 1}, glm::dvec3(around(i + 0.5) * slope, slope),
              {(i + 0.5) / kSegments, 0.0});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  if (hasBase) addDisk(mesh, 0.0, -1.0);
  return mesh;
}

MeshGeometry sphereMesh() {
  MeshGeometry mesh;
  for (uint32_t row = 0; row <= kRows; ++row) {
    const double v = double(row) / kRows;
    const bool isPole = row == 0 || row == kRows;
    const double ring = isPole ? 0.0 : std::sin(std::numbers::pi * v);
    const double z = row == 0 ? 1.0 : row == kRows ? -1.0 : std::cos(std::numbers::pi * v);
    for (uint32_t i = 0; i <= kSegments; ++i) {
      const glm::dvec3 p(ring * around(i), z);
      addVertex(mesh, p, p, {(i + (isPole ? 0.5 : 0.0)) / kSegments, v});
    }
  }
  constexpr uint32_t kWidth = kSegments + 1;
  for (uint32_t row = 0; row < kRows; ++row) {
    for (uint32_t i = 0; i < kSegments; ++i) {
      const uint32_t a = row * kWidth + i, b = a + 1, c = a + kWidth, d = c + 1;
      if (row > 0) mesh.triangles.push_back({a, c, b});
      if (row + 1 < kRows) mesh.triangles.push_back({b, c, d});
    }
  }
  return mesh;
}

MeshGeometry torusMesh(double minor) {
  MeshGeometry mesh;
  for (uint32_t row = 0; row <= kRows; ++row) {
    const glm::dvec2 tube = around(double(row) * kSegments / kRows);
    for (uint32_t i = 0; i <= kSegments; ++i) {
      const glm::dvec2 d = around(i);
      addVertex(mesh, glm::dvec3(d * (1.0 + minor * tube.x), minor * tube.y),
                glm::dvec3(d * tube.x, tube.y), {double(i) / kSegments, double(row) / kRows});
    }
  }
  constexpr uint32_t kWidth = kSegments + 1;
  for (uint32_t row = 0; row < kRows; ++row) {
    for (uint32_t i = 0; i < kSegments; ++i) {
      const uint32_t a = row * kWidth + i, b = a + 1, c = a + kWidth, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

// Its texture coordinates are metres.
MeshGeometry planeMesh(double size) {
  MeshGeometry mesh;
  addSquare(mesh, {0, 0, 0}, {0, 0, 1}, {size, 0, 0}, {0, size, 0});
  for (glm::vec2& uv : mesh.uvs[0]) uv = glm::vec2(size * (2.0 * glm::dvec2(uv) - 1.0));
  return mesh;
}

}  // namespace

MeshGeometry fineMesh(const ShapeGeometry& shape) {
  const std::string& kind = shape.info->name;
  const auto isSet = [&] { return shape.values.at(0) > 0.0f; };
  MeshGeometry mesh = kind == "rectangle"  ? rectangleMesh()
                      : kind == "cube"     ? cubeMesh()
                      : kind == "disk"     ? diskMesh()
                      : kind == "cylinder" ? cylinderMesh(isSet())
                      : kind == "cone"     ? coneMesh(isSet())
                      : kind == "sphere"   ? sphereMesh()
                      : kind == "torus"    ? torusMesh(shape.values.at(0))
                      : kind == "plane"    ? planeMesh(shape.values.at(0))
                                           : shape.info->standIn(shape);
  mesh.name = kind;
  if (mesh.normals.empty()) return mesh;
  for (glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x];
    const glm::vec3 face = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    const glm::vec3 n = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    if (glm::dot(face, n) < 0.0f) std::swap(t.y, t.z);
  }
  return mesh;
}

}  // namespace restlab
