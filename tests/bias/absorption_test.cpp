// Absorbing bodies: rough glass, and overlapping boxes.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

// A slab of rough blue glass between the camera and a lamp.
std::shared_ptr<const CompiledScene> blueSlab() {
  using namespace builtin;
  SceneBuilder scene("blue-slab");
  const uint32_t light = scene.addMaterial("lamp", lamp({4.0f, 4.0f, 4.0f}));
  const uint32_t blue = scene.addMaterial("blue", glass(0.6f, {3.0f, 1.5f, 0.2f}));
  scene.add(quad("lamp", {-1.0, -1.0, -2.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}), light);
  scene.add(box("slab", {-1.5, -1.5, -0.6}, {1.5, 1.5, -0.1}), blue);
  scene.addCamera("front", {0.0, 0.0, 1.5}, {0.0, 0.0, -1.0}, 45.0);
  return CompiledScene::build(scene.finish());
}

Method weighted(double misExponent) {
  Method method = pathMethod(16);
  method.name = "template, mis_exponent " + std::to_string(misExponent);
  method.config.integrator = "template";
  method.config.parameters = {{"mis_exponent", misExponent}};
  return method;
}

// A light sample may leave through the surface that it is drawn at, and then travels in another
// medium than the path did. `path` is the truth of all bias tests, so its own techniques are
// compared with each other: MIS weights that favour light samples with weights that do not.
TEST(Absorption, NightlyTechniquesAgreeOnRoughGlass) {
  constexpr size_t kRuns = 64;
  const auto scene = blueSlab();
  const stats::Truth truth = stats::truthOf(independentRuns(scene, weighted(1.0), 1, kRuns));
  for (const Method& method : {weighted(8.0), pathMethod(16)}) {
    const stats::BiasReport report = testMethod(scene, method, truth, kRuns);
    EXPECT_FALSE(report.failed()) << method.name << ": " << report.text();
  }
}

// Two overlapping tinted boxes on a floor under a lamp as wide as the room. Shifts end inside of
// them, pass them, and reach them from neighbours that see past them. Their sides do not refract,
// so there are no caustics.
std::shared_ptr<const CompiledScene> tintedBoxes() {
  using namespace builtin;
  SceneBuilder scene("tinted-boxes");
  const uint32_t wall = scene.addMaterial("wall", lambert({0.7f, 0.6f, 0.5f}));
  const uint32_t light = scene.addMaterial("lamp", lamp({2.0f, 2.0f, 2.0f}));
  const auto tinted = [&scene](const char* name, const glm::vec3& sigma) {
    rl::Material material = glass(0.0f, sigma);
    material.ior = 1.0f;
    return scene.addMaterial(name, material);
  };
  const uint32_t red = tinted("red", {0.2f, 1.0f, 1.5f}), blue = tinted("blue", {1.5f, 0.8f, 0.1f});
  scene.add(insideOut(box("room", {-2.0, 0.0, -3.0}, {2.0, 3.0, 2.0})), wall);
  scene.add(quad("lamp", {-1.8, 2.9, -2.8}, {3.6, 0.0, 0.0}, {0.0, 0.0, 4.6}), light);
  scene.add(box("red", {-1.2, -0.1, -2.0}, {0.3, 1.4, -0.4}), red);
  scene.add(box("blue", {-0.2, -0.1, -1.6}, {1.1, 1.0, 0.2}), blue);
  scene.addCamera("front", {0.3, 1.6, 1.7}, {0.0, 0.8, -1.5}, 60.0);
  return CompiledScene::build(scene.finish());
}

void expectUnbiasedReuse(size_t runs) {
  const auto scene = tintedBoxes();
  const stats::Truth truth = stats::truthOf(independentRuns(scene, pathMethod(12), 1, runs));
  const stats::BiasReport report = testMethod(scene, restirMethod(8, 2), truth, runs);
  EXPECT_FALSE(report.failed()) << report.text();
  EXPECT_LE(report.untestableShare, 0.1);
}

TEST(Absorption, ReuseLeavesTheMeanAroundTintedBoxes) { expectUnbiasedReuse(64); }
TEST(Absorption, NightlyReuseLeavesTheMeanAroundTintedBoxes) { expectUnbiasedReuse(1024); }

}  // namespace
}  // namespace restlab::bias
