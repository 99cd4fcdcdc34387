// Lamps that are chosen by a hierarchy leave the mean as it is: beside a sky and glass, for
// receivers of every kind, and where a ray finds the lamp that a light sample might have drawn.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

// A room that is open to a sky, under rows of tilted lamps, spots and points; a metal, a plastic
// and a glass block.
std::shared_ptr<const CompiledScene> hall() {
  using namespace builtin;
  SceneBuilder scene("hall");
  const uint32_t wall = scene.addMaterial("wall", lambert({0.7f, 0.6f, 0.5f}));
  scene.add(quad("floor", {-3.0, 0.0, -4.0}, {0.0, 0.0, 6.0}, {6.0, 0.0, 0.0}), wall);
  scene.add(quad("back", {-3.0, 0.0, -4.0}, {6.0, 0.0, 0.0}, {0.0, 3.0, 0.0}), wall);
  scene.add(quad("side", {-3.0, 0.0, 2.0}, {0.0, 0.0, -6.0}, {0.0, 3.0, 0.0}), wall);
  scene.add(box("metal", {-1.6, 0.001, -1.5}, {-0.8, 0.9, -0.7}),
            scene.addMaterial("metal", metal({0.9f, 0.7f, 0.5f}, 0.4f)));
  scene.add(box("plastic", {-0.3, 0.001, -2.0}, {0.5, 0.7, -1.2}),
            scene.addMaterial("plastic", plastic({0.2f, 0.4f, 0.7f}, 0.3f)));
  scene.add(box("glass", {0.9, 0.001, -1.4}, {1.6, 0.8, -0.7}),
            scene.addMaterial("glass", glass(0.3f, glm::vec3(0.0f))));
  for (int i = 0; i < 12; ++i) {
    const float power = 1.0f + 3.0f * float(i % 4);
    const double x = -2.4 + 0.4 * i, z = i % 2 == 0 ? -2.6 : -0.4;
    rl::Material light = lamp({power, 0.8f * power, 0.6f * power});
    if (i % 3 == 0) light.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    scene.add(quad("lamp", {x, 2.2, z}, {0.35, 0.1 * (i % 5), 0.0}, {0.0, 0.15, 0.35}),
              scene.addMaterial("lamp", light));
  }
  for (int i = 0; i < 6; ++i) {
    PunctualLight light;
    light.kind = i % 2 == 0 ? rl::RL_LIGHT_SPOT : rl::RL_LIGHT_POINT;
    light.posW = {-2.0 + 0.8 * i, 2.5, -1.5};
    light.dirW = glm::normalize(glm::dvec3(0.2 * i - 0.5, -1.0, 0.1));
    light.intensity = glm::vec3(0.5f + 0.2f * float(i));
    light.outerConeAngle = 0.6f;
    light.innerConeAngle = 0.3f;
    scene.addLight(light);
  }
  scene.setEnvironment({"sky", 4, 2, std::vector<glm::vec3>(8, glm::vec3(0.15f, 0.2f, 0.3f))});
  scene.addCamera("front", {0.4, 1.5, 2.6}, {-0.2, 0.8, -1.5}, 60.0);
  return CompiledScene::build(scene.finish());
}

void expectSameMean(const std::string& integrator, size_t runs, uint32_t frames) {
  const auto scene = hall();
  const auto adapted = [&](Method method, uint32_t choice) {
    method.config.lightChoice = choice;
    method.config.threads = 0;
    method.name += choice == kLightChoiceTree ? ", by the hierarchy" : ", by power";
    return method;
  };
  const stats::Truth truth = stats::truthOf(
      independentRuns(scene, adapted(pathMethod(2 * frames), kLightChoicePower), 1, runs));
  const Method method =
      integrator == "path" ? pathMethod(frames) : restirMethod(frames, 2, {}, integrator);
  const stats::BiasReport report =
      testMethod(scene, adapted(method, kLightChoiceTree), truth, runs);
  EXPECT_FALSE(report.failed()) << report.text();
}

TEST(LightChoice, TheHierarchyLeavesTheMeanOfPath) { expectSameMean("path", 192, 8); }
TEST(LightChoice, TheHierarchyLeavesTheMeanOfDirectReuse) { expectSameMean("restir_di", 128, 8); }
TEST(LightChoice, TheHierarchyLeavesTheMeanOfPathReuse) { expectSameMean("restir_pt", 128, 8); }

TEST(LightChoice, NightlyTheHierarchyLeavesTheMean) {
  for (const char* integrator : {"path", "restir_di", "restir_gi", "restir_pt"})
    expectSameMean(integrator, 512, 32);
}

}  // namespace
}  // namespace restlab::bias
