// Rough metal with bumps: reuse evaluates its lobes for directions that the path did not come from,
// where other facets face away and other light is mirrored at the faces.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/analytic/inconsistent_normals.h"
#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

// A corridor, seen along its walls, with a lamp that lights floor and ceiling.
std::shared_ptr<const CompiledScene> corridor() {
  using namespace builtin;
  SceneBuilder builder("corridor");
  const uint32_t wall = builder.addMaterial("wall", metal({0.9f, 0.7f, 0.5f}, 0.6f));
  const uint32_t floor = builder.addMaterial("floor", lambert({0.5f, 0.6f, 0.7f}));
  const uint32_t light = builder.addMaterial("lamp", lamp({3.0f, 2.5f, 2.0f}));
  const glm::dvec3 up(0.0, 2.0, 0.0), along(0.0, 0.0, -6.0), across(2.0, 0.0, 0.0);
  const auto mapped = [](MeshGeometry mesh) {
    mesh.uvs[0] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 0.5f}, {0.0f, 0.5f}};
    return mesh;
  };
  builder.add(mapped(quad("left", {-1.0, 0.0, 0.0}, along, up)), wall);
  builder.add(mapped(quad("right", {1.0, 0.0, -6.0}, -along, up)), wall);
  builder.add(mapped(quad("end", {-1.0, 0.0, -6.0}, across, up)), wall);
  builder.add(quad("floor", {-1.0, 0.0, 0.0}, across, along), floor);
  builder.add(quad("ceiling", {-1.0, 2.0, -6.0}, across, -along), floor);
  builder.add(quad("lamp", {-0.5, 1.99, -4.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.5}), light);
  builder.addCamera("front", {0.6, 1.0, 0.5}, {0.0, 0.9, -5.0}, 50.0);
  Scene scene = builder.finish();
  scene.materials.at(wall).data.textures[rl::RL_TEX_NORMAL] = analytic::addBumps(scene, 0.6f);
  return CompiledScene::build(scene);
}

TEST(BentNormals, NightlyLeaveTheMean) {
  constexpr size_t kRuns = 512;
  const auto scene = corridor();
  for (const uint32_t component : {rl::RL_COMPONENT_INDIRECT, rl::RL_COMPONENT_DIRECT}) {
    const auto adapted = [&](Method method) {
      method.config.components = component;
      method.config.threads = 0;
      method.name += component == rl::RL_COMPONENT_DIRECT ? ", direct" : ", indirect";
      return method;
    };
    const stats::Truth truth =
        stats::truthOf(independentRuns(scene, adapted(pathMethod(64)), 1, kRuns));
    const stats::BiasReport report = testMethod(scene, adapted(restirMethod(32, 4)), truth, kRuns);
    EXPECT_FALSE(report.failed()) << report.text();
  }
}

}  // namespace
}  // namespace restlab::bias
