// Lamps without light samples: scattered rays alone find them. Nothing is lost, and nothing is
// counted twice, by `path` and by reuse.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/field/expression.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

MeshGeometry fieldLamp(const std::string& expression, const glm::vec3& reach) {
  ShapeGeometry shape{findShape("implicit"), {}};
  shape.words = fieldWords(readExpression(expression, -reach, reach));
  return makeShape(shape, "lamp");
}

// A room with a box, and a lamp of half a metre in its middle that shines to its outside.
std::shared_ptr<const CompiledScene> room(const MeshGeometry& lampShape) {
  using namespace builtin;
  SceneBuilder scene("room");
  const uint32_t wall = scene.addMaterial("wall", lambert({0.7f, 0.6f, 0.5f}));
  const uint32_t lamp = scene.addMaterial("lamp", builtin::lamp({3.0f, 2.5f, 2.0f}));
  scene.add(insideOut(box("room", {-2.0, 0.0, -3.0}, {2.0, 3.0, 2.0})), wall);
  scene.add(box("block", {-1.5, 0.01, -1.6}, {-0.7, 1.2, -0.8}), wall);
  scene.place(
      "lamp", scene.addGeometry(lampShape), lamp,
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 1.8, -0.8)), glm::dvec3(0.5)));
  scene.addCamera("front", {0.3, 1.6, 1.7}, {0.0, 1.2, -1.5}, 60.0);
  return CompiledScene::build(scene.finish());
}

void expectMeansOf(const std::shared_ptr<const CompiledScene>& scene,
                   const std::shared_ptr<const CompiledScene>& truthScene, size_t runs,
                   const std::vector<std::string>& integrators) {
  const stats::Truth truth = stats::truthOf(independentRuns(truthScene, pathMethod(32), 1, runs));
  const auto expectUnbiased = [&](const Method& method) {
    const stats::BiasReport report = testMethod(scene, method, truth, runs);
    EXPECT_FALSE(report.failed()) << report.text();
  };
  if (scene != truthScene) expectUnbiased(pathMethod(32));
  for (const std::string& integrator : integrators)
    expectUnbiased(restirMethod(16, 2, {}, integrator));
}

void expectBall(size_t runs, const std::vector<std::string>& integrators) {
  const auto scene = room(fieldLamp("x^2 + y^2 + z^2 - 1", glm::vec3(1.1f)));
  EXPECT_EQ(scene->lampCount(), 0u);
  const auto truth = room(makeShape({findShape("sphere"), {}}, "lamp"));
  EXPECT_EQ(truth->lampCount(), 1u);
  expectMeansOf(scene, truth, runs, integrators);
}

// A sheet that shines to one side: a path that found its front does not reconnect to its back.
void expectSheet(size_t runs, const std::vector<std::string>& integrators) {
  const auto scene = room(fieldLamp("y - 0.5*(x^2 - z^2)", glm::vec3(1.0f)));
  EXPECT_EQ(scene->lampCount(), 0u);
  expectMeansOf(scene, scene, runs, integrators);
}

TEST(UndrawnLamps, LeaveTheMean) {
  expectBall(48, {"restir_gi"});
  expectSheet(48, {"restir_gi"});
}
TEST(UndrawnLamps, NightlyLeaveTheMean) {
  expectBall(256, {"restir_gi", "restir_di", "restir_pt"});
  expectSheet(256, {"restir_gi", "restir_di", "restir_pt"});
}

}  // namespace
}  // namespace restlab::bias
