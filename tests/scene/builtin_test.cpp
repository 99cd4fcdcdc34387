// The built-in scenes with a known answer: the Cornell box, the furnaces, the quad light, the sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/constants.hpp>

#include "core/scene/builtin/sky.h"
#include "core/scene/scene.h"
#include "tests/scene/mesh_checks.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;
using test::WorldTriangle;

// A scene file outside the project; empty if the folder is absent.
fs::path sharedScene(const std::string& path) {
  const char* variable = std::getenv("RESTLAB_SCENES");
  const fs::path root =
      variable != nullptr ? fs::path(variable) : fs::path(RESTLAB_SOURCE_DIR) / "../shared/scenes";
  return fs::exists(root / path) ? root / path : fs::path();
}

const rl::Material& builtinMaterialOf(const Scene& scene, const std::string& instance) {
  return scene.materials.at(test::instanceNamed(scene, instance).material).data;
}

TEST(CornellBox, IsThePublishedOne) {
  const Scene scene = makeBuiltinScene("cornell-box");
  EXPECT_EQ(test::worldTriangles(scene).size(), 38u);
  EXPECT_EQ(builtinMaterialOf(scene, "Floor").baseColor, glm::vec3(0.725f, 0.71f, 0.68f));
  EXPECT_EQ(builtinMaterialOf(scene, "LeftWall").baseColor, glm::vec3(0.63f, 0.065f, 0.05f));
  EXPECT_EQ(builtinMaterialOf(scene, "RightWall").baseColor, glm::vec3(0.14f, 0.45f, 0.091f));
  EXPECT_EQ(builtinMaterialOf(scene, "Light").emission, glm::vec3(17.0f, 12.0f, 4.0f));
  EXPECT_EQ(builtinMaterialOf(scene, "Light").baseColor, glm::vec3(0.0f));
  for (const SceneMaterial& m : scene.materials) {
    EXPECT_EQ(m.data.specular, 0.0f) << m.name;
    EXPECT_EQ(m.data.metallic, 0.0f) << m.name;
  }
  for (const MeshGeometry& mesh : scene.geometries) EXPECT_TRUE(mesh.normals.empty()) << "flat";

  // The light is 130 x 105 mm x 100 and fills a hole: ceiling and light together are 556 x 559.2.
  double ceiling = 0.0, light = 0.0;
  for (const WorldTriangle& t : test::worldTriangles(scene, "Ceiling"))
    ceiling += glm::length(t.areaNormal());
  for (const WorldTriangle& t : test::worldTriangles(scene, "Light")) {
    light += glm::length(t.areaNormal());
    EXPECT_LT(t.areaNormal().y, 0.0) << "shines down";
  }
  EXPECT_NEAR(light, 1.30 * 1.05, 1e-6);
  EXPECT_NEAR(ceiling + light, 5.56 * 5.592, 1e-5);
  // The two triangles of the left wall are not coplanar.
  const std::vector<WorldTriangle> left = test::worldTriangles(scene, "LeftWall");
  ASSERT_EQ(left.size(), 2u);
  const double cosine =
      glm::dot(glm::normalize(left[0].areaNormal()), glm::normalize(left[1].areaNormal()));
  EXPECT_GT(std::acos(cosine), 0.005);
}

// Triangles sorted by position, so that neither order nor names matter.
std::vector<std::array<glm::dvec3, 3>> sortedSoup(const Scene& scene) {
  std::vector<std::array<glm::dvec3, 3>> soup;
  const auto key = [](const glm::dvec3& p) {
    return std::array<long, 3>{std::lround(p.x * 1e4), std::lround(p.y * 1e4),
                               std::lround(p.z * 1e4)};
  };
  for (const WorldTriangle& t : test::worldTriangles(scene)) {
    std::array<glm::dvec3, 3> corners{t.p0, t.p1, t.p2};
    // Rotate, without mirroring, to start with the least corner: winding is compared too.
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end(),
                                 [&](const auto& a, const auto& b) { return key(a) < key(b); }),
                corners.end());
    soup.push_back(corners);
  }
  std::sort(soup.begin(), soup.end(), [&](const auto& a, const auto& b) {
    return std::array{key(a[0]), key(a[1]), key(a[2])} <
           std::array{key(b[0]), key(b[1]), key(b[2])};
  });
  return soup;
}

TEST(CornellBox, AgreesWithTheGateScene) {
  const fs::path file = sharedScene("gates/cornell-d8/cornell.gltf");
  if (file.empty()) GTEST_SKIP() << "gates/cornell-d8 is absent (set RESTLAB_SCENES)";
  const Scene gate = loadGltf(file), scene = makeBuiltinScene("cornell-box");
  const auto theirs = sortedSoup(gate), ours = sortedSoup(scene);
  ASSERT_EQ(ours.size(), theirs.size());
  for (size_t i = 0; i < ours.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_LT(glm::distance(ours[i][c], theirs[i][c]), 1e-5) << "triangle " << i;
    }
  }
  for (const MeshInstance& instance : gate.instances) {
    SCOPED_TRACE(instance.name);
    const rl::Material& a = gate.materials.at(instance.material).data;
    const rl::Material& b = builtinMaterialOf(scene, instance.name);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(a.baseColor[c], b.baseColor[c], 1e-6);
      EXPECT_NEAR(a.emission[c], b.emission[c], 1e-5);
    }
    EXPECT_EQ(a.specular, b.specular);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.flags & rl::RL_MATERIAL_DOUBLE_SIDED, b.flags & rl::RL_MATERIAL_DOUBLE_SIDED);
  }
  ASSERT_EQ(gate.cameras.size(), 1u);
  EXPECT_NEAR(gate.cameras[0].yfov, scene.cameras[0].yfov, 1e-6);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      EXPECT_NEAR(gate.cameras[0].cameraToWorld[column][row],
                  scene.cameras[0].cameraToWorld[column][row], 1e-12);
    }
  }
}

TEST(Furnace, IsClosedAndUniform) {
  const Scene scene = makeBuiltinScene("furnace");
  const std::vector<WorldTriangle> room = test::worldTriangles(scene, "room");
  EXPECT_EQ(test::openEdge(room), "");
  EXPECT_NEAR(test::signedVolume(room), -4.0 * 3.0 * 5.0, 1e-5) << "looks inwards";
  const std::vector<WorldTriangle> block = test::worldTriangles(scene, "block");
  EXPECT_EQ(test::openEdge(block), "");
  EXPECT_NEAR(test::signedVolume(block), 1.2 * 1.0 * 1.0, 1e-5) << "looks outwards";
  for (const MeshInstance& instance : scene.instances) {
    const rl::Material& m = scene.materials.at(instance.material).data;
    EXPECT_EQ(m.baseColor, glm::vec3(0.5f));
    EXPECT_EQ(m.emission, glm::vec3(0.5f));
    EXPECT_EQ(m.specular, 0.0f);
    EXPECT_EQ(m.metallic, 0.0f);
  }
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_FALSE(scene.environment.has_value());
}

TEST(SphereFurnace, IsConvexWhiteAndEvenlyLit) {
  const Scene scene = makeBuiltinScene("sphere-furnace");
  const std::vector<WorldTriangle> solid = test::worldTriangles(scene);
  EXPECT_EQ(test::openEdge(solid), "");
  EXPECT_GT(test::signedVolume(solid), 4.0);
  // Convex: no vertex lies above the plane of any face.
  const std::vector<glm::vec3>& vertices = scene.geometries.at(0).positions;
  for (size_t i = 0; i < solid.size(); i += 37) {
    const glm::dvec3 normal = glm::normalize(solid[i].areaNormal());
    for (const glm::vec3& v : vertices) {
      ASSERT_LT(glm::dot(normal, glm::dvec3(v) - solid[i].p0), 1e-6);
    }
  }
  EXPECT_EQ(builtinMaterialOf(scene, "solid").baseColor, glm::vec3(1.0f));
  EXPECT_TRUE(scene.geometries.at(0).normals.empty());
  ASSERT_TRUE(scene.environment.has_value());
  for (const glm::vec3& texel : scene.environment->radiance) EXPECT_EQ(texel, glm::vec3(1.0f));
}

// Checks both cameras; the second one also below lights of every size.
TEST(QuadLight, FloorFillsThePictureInFrontOfTheLight) {
  for (const auto& [name, camera] :
       {std::pair("quad-light", 0), {"quad-light", 1}, {"quad-light?edge=1e3", 1}}) {
    const Scene scene = makeBuiltinScene(name);
    const SceneCamera& view = scene.cameras.at(size_t(camera));
    const std::vector<WorldTriangle> all = test::worldTriangles(scene);
    const std::vector<WorldTriangle> light = test::worldTriangles(scene, "light");
    ASSERT_EQ(light.size(), 2u);
    const glm::dvec3 eye(view.cameraToWorld[3]);
    for (const double aspect : {1.0, 16.0 / 9.0}) {
      for (int i = 0; i <= 32; ++i) {
        for (int j = 0; j <= 32; ++j) {
          const glm::dvec3 dir = test::cameraDirection(view, i / 32.0, j / 32.0, aspect);
          const auto hit = test::nearestHit(all, eye, dir);
          ASSERT_TRUE(hit.has_value()) << i << " " << j;
          EXPECT_EQ(scene.instances[hit->triangle->instance].name, "floor") << i << " " << j;
          const glm::dvec3 posW = eye + hit->t * dir;
          EXPECT_GT(glm::dot(light[0].areaNormal(), posW - light[0].p0), 0.0) << "behind the light";
        }
      }
    }
  }
}

TEST(Sky, IsNormalisedAndBrightestAtTheSun) {
  const Scene scene = makeBuiltinScene("courtyard");
  ASSERT_TRUE(scene.environment.has_value());
  const EnvironmentMap& map = *scene.environment;
  ASSERT_EQ(map.radiance.size(), size_t(map.width) * map.height);
  double irradiance = 0.0, brightest = 0.0;
  glm::dvec3 brightestDir(0.0);
  const double pi = glm::pi<double>();
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      const glm::vec3& texel = map.radiance[size_t(y) * map.width + x];
      ASSERT_TRUE(texel.x > 0.0f && texel.y > 0.0f && texel.z > 0.0f && texel.z < 100.0f);
      const double theta = pi * (y + 0.5) / map.height;
      const double phi = 2.0 * pi * (x + 0.5) / map.width;  // u = 1/2 along -Z, 3/4 along +X
      const glm::dvec3 dir(-std::sin(theta) * std::sin(phi), std::cos(theta),
                           std::sin(theta) * std::cos(phi));
      const double luminance = 0.2126 * texel.x + 0.7152 * texel.y + 0.0722 * texel.z;
      const double solidAngle = 2.0 * pi * pi * std::sin(theta) / (double(map.width) * map.height);
      if (dir.y > 0.0) irradiance += luminance * dir.y * solidAngle;
      if (luminance > brightest) {
        brightest = luminance;
        brightestDir = dir;
      }
    }
  }
  EXPECT_NEAR(irradiance, pi, 1e-5);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, rl::RL_LIGHT_DIRECTIONAL);
  EXPECT_NEAR(glm::length(scene.lights[0].dirW), 1.0, 1e-12);
  EXPECT_LT(scene.lights[0].dirW.y, -0.3) << "the sun stands high";
  EXPECT_GT(glm::dot(brightestDir, -scene.lights[0].dirW), std::cos(0.02)) << "glow and sun agree";
}

}  // namespace
}  // namespace restlab
