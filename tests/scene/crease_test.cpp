// Normals from faces: creases stay sharp, round meshes get the normals of the round surface.
#include "core/scene/crease.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/mesh.h"

namespace restlab {
namespace {

// Eight vertices that its faces share.
MeshGeometry sharedCube() {
  MeshGeometry mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2);
    mesh.uvs[0].emplace_back(0.125f * float(corner), 0.5f);
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

glm::vec3 faceOf(const MeshGeometry& mesh, const glm::uvec3& t) {
  return glm::normalize(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                   mesh.positions[t.z] - mesh.positions[t.x]));
}

TEST(Crease, ACubeStaysFlatBelowItsEdges) {
  const MeshGeometry before = sharedCube();
  for (const double degrees : {0.0, 30.0, 89.0}) {
    MeshGeometry mesh = before;
    smoothNormals(mesh, degrees);
    // Three faces meet in a corner; the two triangles of a face share their vertices.
    EXPECT_EQ(mesh.positions.size(), 24u);
    EXPECT_EQ(mesh.uvs[0].size(), 24u);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const uint32_t vertex = mesh.triangles[t][c], old = before.triangles[t][c];
        EXPECT_EQ(mesh.positions[vertex], before.positions[old]);
        EXPECT_EQ(mesh.uvs[0][vertex], before.uvs[0][old]);
        EXPECT_LT(glm::distance(mesh.normals[vertex], faceOf(mesh, mesh.triangles[t])), 1e-6f);
      }
    }
  }
}

TEST(Crease, ACubeIsSmoothAboveThem) {
  for (const double degrees : {90.0, 180.0}) {
    MeshGeometry mesh = sharedCube();
    smoothNormals(mesh, degrees);
    EXPECT_EQ(mesh.positions.size(), 8u);
    // By angle each face counts alike, whichever way it is cut into triangles.
    for (size_t i = 0; i < 8; ++i)
      EXPECT_LT(glm::distance(mesh.normals[i], glm::normalize(mesh.positions[i] - 0.5f)), 1e-6f);
  }
}

// Vertices in one place are one corner, as where a texture has a seam.
TEST(Crease, SeamsAreNoEdges) {
  MeshGeometry mesh;
  const MeshGeometry shared = sharedCube();
  for (const glm::uvec3& t : shared.triangles) {
    for (int c = 0; c < 3; ++c) mesh.positions.push_back(shared.positions[t[c]]);
    const auto n = uint32_t(mesh.positions.size());
    mesh.triangles.emplace_back(n - 3, n - 2, n - 1);
  }
  smoothNormals(mesh, 180.0);
  EXPECT_EQ(mesh.positions.size(), 36u);
  for (size_t i = 0; i < 36; ++i)
    EXPECT_LT(glm::distance(mesh.normals[i], glm::normalize(mesh.positions[i] - 0.5f)), 1e-6f);
}

TEST(Crease, AFineSphereHasTheNormalsOfASphere) {
  MeshGeometry mesh = builtin::sphere("ball", glm::dvec3(0.0), 1.0, 4, false);
  const size_t vertices = mesh.positions.size();
  smoothNormals(mesh, 30.0);
  EXPECT_EQ(mesh.positions.size(), vertices);
  float worst = 0.0f;
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    worst = std::max(worst, glm::distance(mesh.normals[i], glm::normalize(mesh.positions[i])));
  EXPECT_LT(worst, 3e-3f);  // radians
}

// Pairs of a million faces would take days.
TEST(Crease, ManyFacesAtOneEdge) {
  constexpr uint32_t kFaces = 200000;
  MeshGeometry mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (uint32_t i = 0; i < kFaces; ++i) {
    const double angle = (i % 2 == 0 ? 0.0 : 1.5) + 1e-6 * double(i);
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    mesh.triangles.emplace_back(0u, 1u, i + 2);
  }
  smoothNormals(mesh, 30.0);
  EXPECT_EQ(mesh.positions.size(), kFaces + 4) << "two fans, each with its ends of the edge";
}

// A triangle that has collapsed to an edge has both faces there as neighbours.
TEST(Crease, FacesWithoutAnAreaDoNotBridgeCreases) {
  MeshGeometry mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {1, 0, 3}};
  smoothNormals(mesh, 30.0);
  for (const size_t t : {size_t{0}, size_t{2}})
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(glm::distance(mesh.normals[mesh.triangles[t][c]], faceOf(mesh, mesh.triangles[t])),
                1e-6f);
  EXPECT_EQ(mesh.positions.size(), 6u);
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n.z, 0.0f) << "a neighbour's normal";
}

TEST(Crease, FacesThatCancelOutKeepANormal) {
  MeshGeometry mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 1}};
  smoothNormals(mesh, 180.0);
  for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(std::abs(n.z), 1.0f, 1e-6f);
  flattenNormals(mesh);
  EXPECT_TRUE(mesh.normals.empty());
}

}  // namespace
}  // namespace restlab
