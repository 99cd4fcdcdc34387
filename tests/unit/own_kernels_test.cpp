// A kernel that was compiled for the features of a scene renders what the general one does, to the
// bit: over random scenes, whose materials, lights, textures, closures and meshes differ in what
// they need.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "core/frame/session.h"
#include "tests/unit/closure_cases.h"
#include "tests/unit/random_materials.h"

namespace restlab::unit {
namespace {

// A closure that needs no table and no other material.
SceneMaterial randomClosure(Inputs& inputs) {
  std::vector<const ClosureInfo*> plain;
  for (const ClosureInfo& info : closureRegistry()) {
    const bool isPlain = std::none_of(info.parameters.begin(), info.parameters.end(),
                                      [](const ClosureParameter& parameter) {
                                        return parameter.kind == ClosureParameter::Kind::table ||
                                               parameter.kind == ClosureParameter::Kind::material;
                                      });
    if (isPlain) plain.push_back(&info);
  }
  const ClosureInfo& info = *plain[inputs.below(uint32_t(plain.size()))];
  const ClosureCase made = closureCaseOf(defaultText(info));
  for (const SceneMaterial& material : made.scene->source().materials)
    if (material.data.closure == info.kind) return material;
  throw std::logic_error("no material of " + info.name);
}

SceneMaterial randomSurface(Scene& scene, Inputs& inputs, bool hasLayers) {
  if (inputs.below(4) == 0) return randomClosure(inputs);
  SceneMaterial material{"material", randomMaterial(scene, inputs)};
  if (hasLayers) addRandomLayers(scene, material, inputs);
  material.data.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
  if (inputs.below(4) == 0) {
    material.data.flags |=
        inputs.below(2) == 0 ? rl::RL_MATERIAL_ALPHA_BLEND : rl::RL_MATERIAL_ALPHA_MASK;
    material.data.alpha = inputs.uniform();
    material.data.alphaCutoff = 0.5f;
  }
  return material;
}

PunctualLight randomLight(Inputs& inputs) {
  PunctualLight light;
  light.kind =
      std::array{rl::RL_LIGHT_POINT, rl::RL_LIGHT_SPOT, rl::RL_LIGHT_DIRECTIONAL}[inputs.below(3)];
  light.posW = {0.5, 1.5, 0.5};
  light.dirW = glm::dvec3(0.0, -1.0, 0.0);
  light.intensity = glm::vec3(1.0f);
  return light;
}

// A lit floor and wall, with a few random things before them.
Scene randomScene(Inputs& inputs, bool hasLayers = false) {
  Scene scene;
  scene.name = "random";
  const auto add = [&](MeshGeometry mesh, const SceneMaterial& material, const glm::dmat4& place) {
    scene.geometries.push_back(std::move(mesh));
    scene.materials.push_back(material);
    scene.instances.push_back({"thing", uint32_t(scene.geometries.size() - 1),
                               uint32_t(scene.materials.size() - 1), place});
  };
  const auto square = [&](const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    MeshGeometry mesh = builtin::quad("square", corner, u, v);
    mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (inputs.below(4) == 0)
      mesh.colors.assign(mesh.positions.size(), glm::vec4(inputs.uniform(), 1.0f, 0.5f, 1.0f));
    return mesh;
  };
  const glm::dmat4 here(1.0);
  add(square({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), randomSurface(scene, inputs, hasLayers), here);
  add(square({-2, 0, -2}, {4, 0, 0}, {0, 4, 0}), randomSurface(scene, inputs, hasLayers), here);
  add(square({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}), {"lamp", builtin::lamp(glm::vec3(4.0f))}, here);
  if (inputs.below(2) == 0) {
    add(builtin::sphere("ball", {-0.5, 0.6, 0.0}, 0.5, 2, inputs.below(2) == 0),
        randomSurface(scene, inputs, hasLayers), here);
    // The same mesh twice: an instance.
    if (inputs.below(2) == 0)
      scene.instances.push_back({"second", uint32_t(scene.geometries.size() - 1), 0,
                                 glm::translate(here, glm::dvec3(1.3, 0.0, 0.3))});
  }
  if (inputs.below(2) == 0) scene.lights.push_back(randomLight(inputs));
  if (inputs.below(3) == 0)
    scene.environment = EnvironmentMap{"sky", 2, 1, {glm::vec3(0.2f), glm::vec3(1.0f)}};
  if (inputs.below(4) == 0) scene.ambient = glm::vec3(0.1f);
  SceneCamera camera;
  camera.cameraToWorld = glm::translate(here, glm::dvec3(0.0, 1.2, 4.0));
  scene.cameras = {camera};
  return scene;
}

// Image after three frames, the last of them with another camera.
Image imageOf(const std::shared_ptr<const CompiledScene>& scene, const std::string& integrator,
              KernelChoice kernels, rl::FeatureMask& used) {
  SessionConfig config;
  config.integrator = integrator;
  config.width = 40;
  config.height = 24;
  config.kernels = kernels;
  Session session(scene, config);
  used = session.featuresUsed();
  session.frames(2);
  SceneCamera camera = scene->source().cameras[0];
  camera.cameraToWorld = glm::translate(camera.cameraToWorld, glm::dvec3(0.02, 0.0, 0.0));
  session.setCamera(camera);
  session.frame();
  return session.radiance();
}

void expectSameBits(uint32_t firstSeed, uint32_t count, const std::vector<std::string>& methods,
                    bool hasLayers = false) {
  std::set<rl::FeatureMask> masks;
  for (uint32_t seed = firstSeed; seed < firstSeed + count; ++seed) {
    Inputs inputs(seed);
    const auto scene = CompiledScene::build(randomScene(inputs, hasLayers));
    for (const std::string& method : methods) {
      rl::FeatureMask own = 0, general = 0;
      const Image a = imageOf(scene, method, KernelChoice::exact, own);
      const Image b = imageOf(scene, method, KernelChoice::general, general);
      EXPECT_EQ(own, scene->features());
      EXPECT_EQ(general, rl::RL_FEATURE_ALL);
      masks.insert(own);
      EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)),
                0)
          << method << ", seed " << seed << ": " << featureNames(own);
    }
  }
  EXPECT_GT(masks.size(), count / 2) << "scenes need the same";
}

TEST(OwnKernels, RenderWhatTheGeneralOnesDo) {
  expectSameBits(1, 4, {"path"});
  // Glass without media: light samples of paths that are replayed once depended on the kernel.
  constexpr uint32_t seed = 4;
  Inputs inputs(seed);
  const rl::FeatureMask needed = CompiledScene::build(randomScene(inputs))->features();
  EXPECT_NE(needed & rl::RL_FEATURE_TRANSMISSION, 0u);
  EXPECT_EQ(needed & rl::RL_FEATURE_VOLUME, 0u);
  expectSameBits(seed, 1, {"restir_pt"});
}

TEST(OwnKernels, RenderTheLayersThatTheGeneralOnesDo) {
  expectSameBits(50, 4, {"path"}, /*hasLayers=*/true);
}

TEST(OwnKernels, RenderWhatTheGeneralOnesDoNightly) {
  expectSameBits(200, 20, {"path", "restir_di", "restir_gi", "restir_pt"}, /*hasLayers=*/true);
  expectSameBits(100, 40, {"path", "restir_di", "restir_gi", "restir_pt"});
}

}  // namespace
}  // namespace restlab::unit
