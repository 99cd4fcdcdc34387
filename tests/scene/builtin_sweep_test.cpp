// Properties of every built-in scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/scene.h"
#include "tests/scene/mesh_checks.h"

namespace restlab {
namespace {

class BuiltinScene : public testing::TestWithParam<std::string> {
 protected:
  const Scene scene_ = makeBuiltinScene(GetParam());
};

std::string testName(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, BuiltinScene, testing::ValuesIn(builtinSceneNames()), testName);

TEST(BuiltinScenes, NamesAndSummaries) {
  const std::vector<std::string>& names = builtinSceneNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const char* promised : {"cornell-box", "door-ajar", "many-lights", "glossy-gallery", "glass",
                               "courtyard", "furnace"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), promised), 1) << promised;
  }
  for (const std::string& name : names) {
    const std::string summary = builtinSceneSummary(name);
    EXPECT_FALSE(summary.empty()) << name;
    EXPECT_LE(summary.size(), 90u) << name;
    EXPECT_EQ(summary.find('\n'), std::string::npos) << name;
  }
}

TEST(BuiltinScenes, UnknownNameNamesTheNearest) {
  for (const auto& call : {+[] { makeBuiltinScene("door-ajra"); },
                           +[] { static_cast<void>(builtinSceneSummary("door-ajra")); }}) {
    try {
      call();
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      const std::string line = error.what();
      EXPECT_NE(line.find("'door-ajra'"), std::string::npos) << line;
      EXPECT_NE(line.find("'door-ajar'"), std::string::npos) << line;
    }
  }
}

TEST(BuiltinScenes, HashIsThatOfTheContent) {
  std::set<uint64_t> hashes;
  for (const std::string& name : builtinSceneNames()) {
    const Scene first = makeBuiltinScene(name), second = makeBuiltinScene(name);
    EXPECT_EQ(first.contentHash, second.contentHash) << name;
    EXPECT_EQ(first.contentHash, builtin::hashOf(first)) << name;
    EXPECT_TRUE(hashes.insert(first.contentHash).second) << name;
  }
}

TEST(BuiltinScenes, EveryPartIsInTheHash) {
  const Scene scene = makeBuiltinScene("courtyard");
  const auto changes = [&](auto&& change) {
    Scene other = scene;
    change(other);
    return builtin::hashOf(other) != scene.contentHash;
  };
  EXPECT_FALSE(changes([](Scene&) {}));
  EXPECT_TRUE(changes([](Scene& s) { s.geometries[1].positions[2].y += 1e-6f; }));
  EXPECT_TRUE(changes(
      [](Scene& s) { std::swap(s.geometries[0].triangles[0].y, s.geometries[0].triangles[0].z); }));
  EXPECT_TRUE(changes([](Scene& s) { s.materials[0].data.baseColor.z += 1e-6f; }));
  EXPECT_TRUE(changes([](Scene& s) { s.instances.back().objectToWorld[3].x += 1e-9; }));
  EXPECT_TRUE(changes([](Scene& s) { s.instances.back().material = 0; }));
  EXPECT_TRUE(changes([](Scene& s) { s.cameras[0].yfov += 1e-9; }));
  EXPECT_TRUE(changes([](Scene& s) { s.lights[0].intensity.x += 1.0f; }));
  EXPECT_TRUE(changes([](Scene& s) { s.environment->radiance[7].y += 1e-6f; }));
  EXPECT_TRUE(changes([](Scene& s) { s.environment.reset(); }));
}

TEST_P(BuiltinScene, IsNamedAndComplete) {
  EXPECT_EQ(scene_.name, GetParam());
  EXPECT_TRUE(scene_.source.empty());
  EXPECT_TRUE(scene_.warnings.empty());
  EXPECT_NE(scene_.contentHash, 0u);
  ASSERT_FALSE(scene_.cameras.empty());
  for (const SceneCamera& camera : scene_.cameras) {
    EXPECT_FALSE(camera.name.empty());
    EXPECT_EQ(camera.aspect, 0.0) << "any aspect ratio";
  }
  for (const MeshInstance& instance : scene_.instances) {
    EXPECT_FALSE(instance.name.empty());
    ASSERT_LT(instance.geometry, scene_.geometries.size());
    ASSERT_LT(instance.material, scene_.materials.size());
  }
  std::set<std::string> names;
  for (const SceneMaterial& material : scene_.materials) {
    EXPECT_TRUE(names.insert(material.name).second) << material.name << " twice";
    for (const rl::uint slot : material.data.textures) EXPECT_EQ(slot, rl::RL_INVALID);
  }
}

TEST_P(BuiltinScene, MaterialsArePhysical) {
  for (const SceneMaterial& m : scene_.materials) {
    const rl::Material& d = m.data;
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(d.baseColor[c], 0.0f) << m.name;
      EXPECT_LE(d.baseColor[c], 1.0f) << m.name;
      EXPECT_GE(d.emission[c], 0.0f) << m.name;
      EXPECT_GE(d.sigmaAbsorption[c], 0.0f) << m.name;
    }
    EXPECT_EQ(d.alpha, 1.0f) << m.name;
    EXPECT_TRUE(d.ior == 1.5f || (d.ior == 1.0f && d.transmission > 0.0f)) << m.name;
    EXPECT_GE(d.roughness, 0.0f) << m.name;
    EXPECT_LE(d.roughness, 1.0f) << m.name;
  }
}

TEST_P(BuiltinScene, TrianglesAreSound) {
  for (const MeshGeometry& mesh : scene_.geometries) {
    SCOPED_TRACE(mesh.name);
    ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
    double size = 0.0;
    for (const glm::vec3& p : mesh.positions) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
    for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
    for (const glm::uvec3& t : mesh.triangles) {
      ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
      const glm::dvec3 p(mesh.positions[t.x]);
      const glm::dvec3 e1 = glm::dvec3(mesh.positions[t.y]) - p;
      const glm::dvec3 e2 = glm::dvec3(mesh.positions[t.z]) - p;
      const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
      const glm::dvec3 face = glm::cross(e1, e2);
      // A sliver is thinner than a hundredth of its length.
      ASSERT_GT(glm::length(face), 1e-2 * longest * longest * 0.1);
      size = std::max(size, longest);
      if (mesh.normals.empty()) continue;
      for (const uint32_t corner : {t.x, t.y, t.z}) {
        ASSERT_GT(glm::dot(glm::dvec3(mesh.normals[corner]), glm::normalize(face)), 0.7)
            << "the normal leaves its face";
      }
    }
    EXPECT_GT(size, 0.0);
  }
}

TEST_P(BuiltinScene, CameraIsUprightAndSeesTheScene) {
  const std::vector<test::WorldTriangle> triangles = test::worldTriangles(scene_);
  for (const SceneCamera& camera : scene_.cameras) {
    const glm::dmat3 frame(camera.cameraToWorld);
    EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-12);
    EXPECT_NEAR(frame[0].y, 0.0, 1e-12) << "tilted sideways";
    EXPECT_GT(frame[1].y, 0.5);
    const glm::dvec3 eye(camera.cameraToWorld[3]);
    // No surface within 20 cm of the camera may fill the image.
    for (const double x : {0.1, 0.5, 0.9}) {
      for (const double y : {0.1, 0.5, 0.9}) {
        const glm::dvec3 dir = glm::normalize(test::cameraDirection(camera, x, y, 16.0 / 9.0));
        const auto hit = test::nearestHit(triangles, eye, dir);
        if (hit) {
          EXPECT_GT(hit->t, 0.2) << x << " " << y;
        }
        if (x == 0.5 && y == 0.5) {
          EXPECT_TRUE(hit.has_value()) << "the middle is empty";
        }
      }
    }
  }
}

}  // namespace
}  // namespace restlab
