// Lights that light samples were drawn from, as a session counts them.
#include "core/frame/drawn_lights.h"

#include <gtest/gtest.h>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::unit {
namespace {

// A floor under a square lamp of two triangles, a strong point and one that is hardly ever drawn.
std::shared_ptr<const CompiledScene> underThreeLights() {
  using namespace builtin;
  SceneBuilder scene("three-lights");
  scene.add(quad("floor", {-1.0, 0.0, -1.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0}),
            scene.addMaterial("floor", lambert({0.5f, 0.5f, 0.5f})));
  scene.add(quad("square", {-0.1, 1.0, -0.1}, {0.2, 0.0, 0.0}, {0.0, 0.0, 0.2}),
            scene.addMaterial("square", lamp({9.0f, 9.0f, 9.0f})));
  for (const float intensity : {1.0f, 1e-9f}) {
    PunctualLight light;
    light.name = intensity == 1.0f ? "strong" : "weak";
    light.posW = {0.0, 0.8, 0.0};
    light.intensity = glm::vec3(intensity);
    scene.addLight(light);
  }
  scene.addCamera("front", {0.0, 0.5, 2.0}, {0.0, 0.0, 0.0}, 45.0);
  return CompiledScene::build(scene.finish());
}

TEST(DrawnLights, NamesThoseThatNoSampleWasDrawnFrom) {
  const auto scene = underThreeLights();
  for (const char* backend : {"cpu", "vulkan"}) {
    SessionConfig config;
    config.width = config.height = 32;
    config.backend = backend;
    std::optional<Session> session;
    try {
      session.emplace(scene, config);
    } catch (const Error&) {
      ASSERT_STRNE(backend, "cpu");
      continue;  // no Vulkan device
    }
    EXPECT_EQ(session->drawnLights().undrawn.size(), 3u) << "before the first frame";
    session->frame();
    EXPECT_EQ(session->drawnLights().text(), "lights: 1 of 3 never drawn: weak") << backend;
  }
}

TEST(DrawnLights, AMeshIsDrawnIfATriangleIs) {
  const auto scene = underThreeLights();
  ASSERT_EQ(scene->lightRecords(), 4u);
  EXPECT_EQ(drawnLights(*scene, {0, 1, 1, 1}).text(), "");
  EXPECT_EQ(drawnLights(*scene, {1, 0, 0, 1}).text(), "lights: 1 of 3 never drawn: strong");
  EXPECT_EQ(drawnLights(*scene, {0, 0, 0, 0}).text(),
            "lights: 3 of 3 never drawn: square, strong, weak");
}

}  // namespace
}  // namespace restlab::unit
