// Rough glass that absorbs: a light sample may leave through the surface that it is taken at, and
// then travels in another medium than the path did. `path` is the truth of all bias tests, so its
// own techniques are held against each other here: MIS weights that favour light samples against
// weights that do not.
#include <gtest/gtest.h>

#include "core/scene/builtin_builder.h"
#include "core/scene/builtin_mesh.h"
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

TEST(Absorption, TechniquesAgreeOnRoughGlass) {
  constexpr size_t kRuns = 64;
  const auto scene = blueSlab();
  const stats::Truth truth = stats::truthOf(independentRuns(scene, weighted(1.0), 1, kRuns));
  for (const Method& method : {weighted(8.0), pathMethod(16)}) {
    const stats::BiasReport report = testMethod(scene, method, truth, kRuns);
    EXPECT_FALSE(report.failed()) << method.name << ": " << report.text();
  }
}

}  // namespace
}  // namespace restlab::bias
