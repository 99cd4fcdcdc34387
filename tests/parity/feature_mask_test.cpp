// Kernels with the mask from the feature scan against general ones, as shaders, over random
// materials. tests/unit/feature_mask_test.cpp compares many more materials in C++.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/mesh.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/unit/random_materials.h"

namespace restlab::parity {
namespace {

// Random squares that face the camera, between a lamp and a white floor.
Scene litSquares(uint32_t seed, uint32_t count, bool hasLayers = false) {
  unit::Inputs inputs(seed);
  Scene scene = unit::randomSquares(inputs, count, hasLayers);
  const auto add = [&scene](MeshGeometry mesh, const rl::Material& material) {
    const auto index = uint32_t(scene.geometries.size());
    scene.geometries.push_back(std::move(mesh));
    scene.materials.push_back({"material", material});
    scene.instances.push_back({"mesh", index, uint32_t(scene.materials.size() - 1), glm::dmat4(1)});
  };
  const double width = 3.0 * count;
  add(builtin::quad("floor", {-1, -0.1, 3}, {width, 0, 0}, {0, 0, -4}),
      builtin::lambert({0.8f, 0.8f, 0.8f}));
  add(builtin::quad("lamp", {0, 3, 2}, {0, 0, -1}, {width, 0, 0}), builtin::lamp(glm::vec3(5.0f)));
  SceneCamera camera;
  camera.cameraToWorld = glm::translate(glm::dmat4(1.0), {0.5 * width - 1.0, 1.0, 6.0});
  scene.cameras.push_back(camera);
  return scene;
}

TEST(FeatureMaskParity, OwnShadersSeeWhatGeneralOnesSee) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    const auto scene = CompiledScene::build(litSquares(seed, 4));
    const auto image = [&scene](const Machine& where) {
      Session session(scene, configOf({"path", "", ""}, where, 64, 32, 3));
      session.frame();
      return session.radiance();
    };
    const FrameDifference difference = countDifferent(image(kVulkanSpecialised), image(kVulkan));
    EXPECT_LE(difference.different, 4u) << "seed " << seed << ": " << difference.text();
  }
}

// Layers of glTF's extensions on both machines.
TEST(FeatureMaskParity, LayersAreTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (const uint32_t seed : {20u, 21u}) {
    const auto scene = CompiledScene::build(litSquares(seed, 4, /*hasLayers=*/true));
    const auto image = [&scene](const Machine& where) {
      Session session(scene, configOf({"path", "", ""}, where, 64, 32, 3));
      session.frame();
      return session.radiance();
    };
    const FrameDifference difference = countDifferent(image(kVulkanSpecialised), image(kCpuEmbree));
    EXPECT_LE(difference.different, 8u) << "seed " << seed << ": " << difference.text();
  }
}

}  // namespace
}  // namespace restlab::parity
