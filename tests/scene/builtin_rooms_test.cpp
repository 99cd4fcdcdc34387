// The built-in scenes made for experiments: the promised properties of light and surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/scene/scene.h"
#include "tests/scene/mesh_checks.h"

namespace restlab {
namespace {

using test::WorldTriangle;

bool isEmitter(const Scene& scene, const WorldTriangle& t) {
  const uint32_t material = scene.instances.at(t.instance).material;
  return scene.materials.at(material).data.emission != glm::vec3(0.0f);
}

// Emitted power of one side over pi, W; luminance weights do not matter here.
double powerOf(const Scene& scene, const WorldTriangle& t) {
  const uint32_t material = scene.instances.at(t.instance).material;
  const glm::vec3& e = scene.materials.at(material).data.emission;
  return (double(e.x) + e.y + e.z) / 3.0 * glm::length(t.areaNormal());
}

TEST(DoorAjar, ShellIsClosed) {
  const Scene scene = makeBuiltinScene("door-ajar");
  const std::vector<WorldTriangle> shell = test::worldTriangles(scene, "shell-");
  EXPECT_EQ(test::openEdge(shell), "");
  // Air of both rooms and the doorway; negative, as faces look into the air.
  const double air = 5.0 * 2.7 * 5.0 + 5.0 * 2.7 * 3.5 + 0.9 * 2.05 * 0.15;
  EXPECT_NEAR(test::signedVolume(shell), -air, 1e-5);
  const std::vector<WorldTriangle> door = test::worldTriangles(scene, "door");
  EXPECT_EQ(test::openEdge(door), "");
  EXPECT_GT(test::signedVolume(door), 0.05);
}

TEST(DoorAjar, AnOpenSurfaceWouldBeNoticed) {
  const Scene scene = makeBuiltinScene("door-ajar");
  std::vector<WorldTriangle> shell = test::worldTriangles(scene, "shell-");
  shell.pop_back();
  EXPECT_NE(test::openEdge(shell), "");
  shell = test::worldTriangles(scene, "shell-");
  std::swap(shell[5].p1, shell[5].p2);
  EXPECT_NE(test::openEdge(shell), "") << "a face turned over";
}

TEST(DoorAjar, GapIsThirtyCentimetres) {
  const Scene scene = makeBuiltinScene("door-ajar");
  const glm::dvec2 jamb(1.4, 0.0);
  double gap = 10.0;
  for (const WorldTriangle& t : test::worldTriangles(scene, "door")) {
    for (const glm::dvec3& p : {t.p0, t.p1, t.p2}) {
      gap = std::min(gap, glm::distance(jamb, glm::dvec2(p.x, p.z)));
      EXPECT_GT(p.z, -1e-6) << "the door has not left the doorway";
    }
  }
  EXPECT_NEAR(gap, 0.30, 1e-5);
}

TEST(DoorAjar, TheOnlyLightIsNextDoorAndUnseen) {
  const Scene scene = makeBuiltinScene("door-ajar");
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_FALSE(scene.environment.has_value());
  const std::vector<WorldTriangle> all = test::worldTriangles(scene);
  double area = 0.0;
  for (const WorldTriangle& t : all) {
    if (!isEmitter(scene, t)) continue;
    area += glm::length(t.areaNormal());
    EXPECT_LT(t.areaNormal().y, 0.0);
    EXPECT_LT(std::max({t.p0.z, t.p1.z, t.p2.z}), -0.15) << "stands in the near room";
  }
  EXPECT_NEAR(area, 1.4, 1e-5);
  const SceneCamera& camera = scene.cameras.at(0);
  const glm::dvec3 eye(camera.cameraToWorld[3]);
  EXPECT_GT(eye.z, 0.0) << "the camera stands in the near room";
  for (int i = 0; i <= 32; ++i) {
    for (int j = 0; j <= 18; ++j) {
      const glm::dvec3 dir = test::cameraDirection(camera, i / 32.0, j / 18.0, 16.0 / 9.0);
      const auto hit = test::nearestHit(all, eye, dir);
      ASSERT_TRUE(hit.has_value()) << "the room has a hole";
      EXPECT_FALSE(isEmitter(scene, *hit->triangle)) << i << " " << j;
    }
  }
}

// Only a small part of the near room sees the panel; all other light there is indirect.
TEST(DoorAjar, DirectLightReachesLittleOfTheRoom) {
  const Scene scene = makeBuiltinScene("door-ajar");
  const std::vector<WorldTriangle> all = test::worldTriangles(scene);
  std::mt19937 random(3);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * double(random()) / 4294967296.0;
  };
  const auto seesPanel = [&](const glm::dvec3& posW) {
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 target(draw(-0.6, 0.8), 2.7, draw(-2.1, -1.1));
      const auto hit = test::nearestHit(all, posW, target - posW);
      if (hit && hit->t > 0.999) return true;
    }
    return false;
  };
  int lit = 0, wall = 0;
  constexpr int points = 600;
  for (int i = 0; i < points; ++i) {
    lit += seesPanel({draw(-2.4, 2.4), draw(0.05, 2.6), draw(0.4, 4.9)}) ? 1 : 0;
    if (i % 4 == 0) wall += seesPanel({2.45, draw(0.05, 1.2), draw(0.9, 2.0)}) ? 1 : 0;
  }
  EXPECT_LT(lit, points / 8);
  EXPECT_GT(wall, points / 4 / 5) << "no splash on the blue wall";
}

TEST(ManyLights, TenThousandTrianglesOverThreeDecades) {
  const Scene scene = makeBuiltinScene("many-lights");
  std::vector<double> powers;
  for (const WorldTriangle& t : test::worldTriangles(scene)) {
    if (!isEmitter(scene, t)) continue;
    powers.push_back(powerOf(scene, t));
    for (const glm::dvec3& p : {t.p0, t.p1, t.p2}) {
      EXPECT_TRUE(std::abs(p.x) < 12.0 && p.y > 2.0 && p.y < 9.0 && p.z < 0.0 && p.z > -36.0)
          << p.x << " " << p.y << " " << p.z;
    }
  }
  ASSERT_EQ(powers.size(), 10000u);
  std::sort(powers.begin(), powers.end());
  EXPECT_GE(powers.back() / powers.front(), 1000.0);
  // Log-uniform powers: medians of the halves are a decade and a half apart; the top tenth has half
  // the light.
  EXPECT_NEAR(std::log10(powers[7500] / powers[2500]), 1.55, 0.15);
  double all = 0.0, top = 0.0;
  for (size_t i = 0; i < powers.size(); ++i) {
    all += powers[i];
    if (i >= 9000) top += powers[i];
  }
  EXPECT_NEAR(top / all, 0.5, 0.06);
}

TEST(GlossyGallery, RoughnessSpansTheRangeInMetalAndPlastic) {
  const Scene scene = makeBuiltinScene("glossy-gallery");
  float metalLow = 1.0f, metalHigh = 0.0f, plasticLow = 1.0f, plasticHigh = 0.0f;
  int lights = 0;
  for (const SceneMaterial& m : scene.materials) {
    if (m.data.emission != glm::vec3(0.0f)) ++lights;
    if (m.data.specular == 0.0f) continue;
    float& low = m.data.metallic == 1.0f ? metalLow : plasticLow;
    float& high = m.data.metallic == 1.0f ? metalHigh : plasticHigh;
    low = std::min(low, m.data.roughness);
    high = std::max(high, m.data.roughness);
  }
  EXPECT_EQ(metalLow, 0.05f);
  EXPECT_EQ(plasticLow, 0.05f);
  EXPECT_EQ(metalHigh, 0.8f);
  EXPECT_EQ(plasticHigh, 0.8f);
  EXPECT_EQ(lights, 5);
  EXPECT_EQ(test::openEdge(test::worldTriangles(scene, "room-")), "");
}

TEST(Glass, SolidsAreClosedOutwardAndApart) {
  const Scene scene = makeBuiltinScene("glass");
  EXPECT_EQ(test::openEdge(test::worldTriangles(scene, "room-")), "");
  int smooth = 0, rough = 0, absorbing = 0;
  for (const MeshInstance& instance : scene.instances) {
    const rl::Material& m = scene.materials.at(instance.material).data;
    if (m.transmission == 0.0f) continue;
    SCOPED_TRACE(instance.name);
    EXPECT_EQ(m.transmission, 1.0f);
    EXPECT_EQ(m.ior, 1.5f);
    ++(m.roughness == 0.0f ? smooth : rough);
    if (m.sigmaAbsorption != glm::vec3(0.0f)) ++absorbing;
    const std::vector<WorldTriangle> solid = test::worldTriangles(scene, instance.name);
    EXPECT_EQ(test::openEdge(solid), "");
    EXPECT_GT(test::signedVolume(solid), 0.0);
    for (const WorldTriangle& t : solid) {
      for (const glm::dvec3& p : {t.p0, t.p1, t.p2}) {
        EXPECT_TRUE(std::abs(p.x) < 2.0 && p.y > 5e-4 && p.y < 2.6 && std::abs(p.z) < 3.0);
      }
    }
  }
  EXPECT_GE(smooth, 3);
  EXPECT_GE(rough, 2);
  EXPECT_GE(absorbing, 3);
  const rl::Material& mirror =
      scene.materials.at(test::instanceNamed(scene, "mirror").material).data;
  EXPECT_EQ(mirror.metallic, 1.0f);
  EXPECT_EQ(mirror.roughness, 0.0f);
}

TEST(Courtyard, BaysAreInstancesAndTheCameraStandsUnderTheRoof) {
  const Scene scene = makeBuiltinScene("courtyard");
  std::vector<int> uses(scene.geometries.size(), 0);
  for (const MeshInstance& instance : scene.instances) ++uses[instance.geometry];
  EXPECT_EQ(*std::max_element(uses.begin(), uses.end()), 24);
  const std::vector<WorldTriangle> all = test::worldTriangles(scene);
  const glm::dvec3 eye(scene.cameras.at(0).cameraToWorld[3]);
  const auto roof = test::nearestHit(all, eye, {0.0, 1.0, 0.0});
  ASSERT_TRUE(roof.has_value());
  EXPECT_EQ(scene.instances[roof->triangle->instance].name, "roof");
  // The camera stands in the shade.
  EXPECT_TRUE(test::nearestHit(all, eye, -scene.lights.at(0).dirW).has_value());
  // The court sees the sun.
  EXPECT_FALSE(test::nearestHit(all, {0.0, 0.01, 3.0}, -scene.lights.at(0).dirW).has_value());
}

}  // namespace
}  // namespace restlab
