#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scene/mitsuba/mesh_files.h"

namespace restlab::mitsuba {
namespace {

glm::dvec3 corner(const MeshGeometry& mesh, uint32_t vertex) {
  return glm::dvec3(mesh.positions[vertex]);
}

glm::dvec3 areaVector(const MeshGeometry& mesh, const glm::uvec3& t) {
  const glm::dvec3 a = corner(mesh, t.x);
  return glm::cross(corner(mesh, t.y) - a, corner(mesh, t.z) - a);
}

bool hasLength(const glm::vec3& v) { return glm::length(glm::dvec3(v)) > 1e-20; }

}  // namespace

void checkMesh(const MeshGeometry& mesh, const std::string& file, const Report& report) {
  if (mesh.positions.size() >= rl::RL_INVALID)
    report.fail(file, fmt::format("{} vertices; fewer than {} expected", mesh.positions.size(),
                                  rl::RL_INVALID));
  const auto isFinite = [](const auto& v) {
    for (int c = 0; c < v.length(); ++c)
      if (!std::isfinite(v[c])) return false;
    return true;
  };
  const auto check = [&](const auto& values, const char* what) {
    for (size_t i = 0; i < values.size(); ++i)
      if (!isFinite(values[i]))
        report.fail(file, fmt::format("vertex {} has a {} that is not finite", i, what));
  };
  check(mesh.positions, "position");
  check(mesh.normals, "normal");
  check(mesh.uvs[0], "texture coordinate");
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const uint32_t most = std::max({t.x, t.y, t.z});
    if (most >= mesh.positions.size())
      report.fail(file, fmt::format("triangle {} names vertex {}; there are {}", i, most,
                                    mesh.positions.size()));
  }
}

void completeNormals(MeshGeometry& mesh) {
  std::vector<char> isGiven(mesh.positions.size(), 0);
  for (size_t i = 0; i < mesh.normals.size(); ++i) isGiven[i] = hasLength(mesh.normals[i]);
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 area = areaVector(mesh, t);
    if (!(glm::length(area) > 0.0)) continue;
    const glm::dvec3 normal = glm::normalize(area);
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 p = corner(mesh, t[c]);
      const glm::dvec3 u = corner(mesh, t[(c + 1) % 3]) - p, v = corner(mesh, t[(c + 2) % 3]) - p;
      const double angle = std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
      sums[t[c]] += angle * normal;
    }
  }
  mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    const glm::dvec3 n = isGiven[i] != 0 ? glm::dvec3(mesh.normals[i]) : sums[i];
    const double length = glm::length(n);
    mesh.normals[i] = length > 0.0 ? glm::vec3(n / length) : glm::vec3(0.0f, 0.0f, 1.0f);
  }
  for (glm::uvec3& t : mesh.triangles) {
    const glm::vec3 n = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    if (glm::dot(areaVector(mesh, t), glm::dvec3(n)) < 0.0) std::swap(t.y, t.z);
  }
}

void addTangents(MeshGeometry& mesh) {
  if (mesh.normals.empty() || mesh.uvs[0].empty()) return;
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 e1 = corner(mesh, t.y) - corner(mesh, t.x),
                     e2 = corner(mesh, t.z) - corner(mesh, t.x);
    const glm::dvec2 d1(mesh.uvs[0][t.y] - mesh.uvs[0][t.x]),
        d2(mesh.uvs[0][t.z] - mesh.uvs[0][t.x]);
    const double area = d1.x * d2.y - d1.y * d2.x;
    if (area == 0.0) continue;
    const glm::dvec3 alongU = (e1 * d2.y - e2 * d1.y) / area;
    if (!(glm::length(alongU) > 0.0)) continue;
    for (int c = 0; c < 3; ++c) sums[t[c]] += glm::normalize(alongU);
  }
  mesh.tangents.resize(mesh.positions.size());
  for (size_t i = 0; i < sums.size(); ++i) {
    const glm::dvec3 n(mesh.normals[i]);
    glm::dvec3 tangent = sums[i] - n * glm::dot(n, sums[i]);
    if (!(glm::length(tangent) > 1e-9)) {
      const glm::dvec3 axis = std::abs(n.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
      tangent = glm::cross(axis, n);
    }
    mesh.tangents[i] = glm::vec4(glm::vec3(glm::normalize(tangent)), 1.0f);
  }
}

}  // namespace restlab::mitsuba
