// Bodies that scatter: radiance of a half space by Chandrasekhar's H function, white bodies in a
// white furnace, and diffusion profiles beside the walk.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

using builtin::SceneBuilder;

// H(1) of isotropic scattering with albedo w (Chandrasekhar 1960, chapter 5), by iteration of
// 1/H(m) = sqrt(1 - w) + w/2 int n H(n) / (m + n) dn.
double hOfOne(double w) {
  constexpr int kNodes = 400;
  const auto node = [](int i) { return (i + 0.5) / kNodes; };
  std::vector<double> h(kNodes, 1.0);
  const auto next = [&](double m) {
    double sum = 0.0;
    for (int i = 0; i < kNodes; ++i) sum += node(i) * h[size_t(i)] / (m + node(i)) / kNodes;
    return 1.0 / (std::sqrt(1.0 - w) + 0.5 * w * sum);
  };
  for (int round = 0; round < 60; ++round) {
    std::vector<double> better(kNodes);
    for (int i = 0; i < kNodes; ++i) better[size_t(i)] = next(node(i));
    h = better;
  }
  return next(1.0);
}

struct Wax {
  glm::vec3 albedo{0.9f}, meanFreePath{0.05f};
  float g = 0.0f, ior = 1.0f;
  bool hasDiffusion = false;
};

void scatter(const Wax& wax, SceneMaterial& m) {
  const glm::vec3 extinction = 1.0f / wax.meanFreePath;
  m.sigmaScattering = extinction * wax.albedo;
  m.data.sigmaAbsorption = extinction - m.sigmaScattering;
  m.data.ior = wax.ior;
  m.phase = wax.g;
  m.hasDiffusion = wax.hasDiffusion;
}

// Half of the film's side in metres.
void lookAlongZ(Scene& scene, double extent) {
  SceneCamera camera;
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = extent;
  camera.cameraToWorld = glm::dmat4(1.0);
  scene.cameras = {camera};
}

// A box under a white sky, seen along the normal of its front at z = -1.
std::shared_ptr<const CompiledScene> boxOf(const Wax& wax, double halfWidth, double depth) {
  SceneBuilder builder("wax");
  const uint32_t material = builder.addMaterial("wax", builtin::glass(0.0f, glm::vec3(0.0f)));
  builder.add(
      builtin::box("box", {-halfWidth, -halfWidth, -1.0 - depth}, {halfWidth, halfWidth, -1.0}),
      material);
  EnvironmentMap sky;
  sky.width = 2;
  sky.height = 1;
  sky.radiance.assign(2, glm::vec3(1.0f));
  builder.setEnvironment(sky);
  Scene scene = builder.finish();
  scatter(wax, scene.materials[material]);
  lookAlongZ(scene, 0.05);
  return CompiledScene::build(std::move(scene));
}

struct Mean {
  glm::dvec3 value{0.0}, error{0.0};
  uint64_t longWalks = 0;
};

// The mean of independent runs of `frames` frames each.
Mean meanOf(const std::shared_ptr<const CompiledScene>& scene, const char* integrator,
            uint32_t frames, uint32_t runs) {
  Mean mean;
  glm::dvec3 squares(0.0);
  for (uint32_t run = 0; run < runs; ++run) {
    SessionConfig config;
    config.integrator = integrator;
    config.width = config.height = 16;
    config.maxBounces = 16;
    config.seed = 100 + run;
    Session session(scene, config);
    glm::dvec3 sum(0.0);
    for (uint32_t i = 0; i < frames; ++i) {
      mean.longWalks += session.frame().health.counts[rl::RL_HEALTH_LONG_WALKS];
      for (const glm::vec3& pixel : session.radiance().pixels)
        sum += glm::dvec3(pixel) / (256.0 * frames);
    }
    mean.value += sum;
    squares += sum * sum;
  }
  const double n = runs;
  mean.value /= n;
  mean.error =
      glm::sqrt(glm::max(squares / n - mean.value * mean.value, glm::dvec3(0.0)) / (n - 1.0));
  return mean;
}

// The methods that resample have the mean of path.
void expectMethodsAgree(const std::shared_ptr<const CompiledScene>& compiled) {
  const Mean path = meanOf(compiled, "path", 16, 60);
  for (const char* integrator : {"restir_di", "restir_gi", "restir_pt"}) {
    const Mean other = meanOf(compiled, integrator, 8, 120);
    for (int c = 0; c < 3; ++c) {
      const double error = std::hypot(path.error[c], other.error[c]);
      EXPECT_NEAR(other.value[c], path.value[c], 4.0 * error) << integrator << ", channel " << c;
      EXPECT_LT(error, 0.04 * path.value[c]) << "too noisy to tell";
    }
  }
}

// Channels differ in albedo and in mean free path: distances are drawn for one and weighed for all.
TEST(Wax, AHalfSpaceIsAsBrightAsChandrasekharSays) {
  Wax wax;
  wax.albedo = {0.5f, 0.9f, 0.97f};
  wax.meanFreePath = {0.05f, 0.1f, 0.03f};
  const auto scene = boxOf(wax, 8.0, 5.0);
  const Mean mean = meanOf(scene, "path", 20, 20);
  for (int c = 0; c < 3; ++c) {
    const double w = wax.albedo[c];
    const double expected = 1.0 - hOfOne(w) * std::sqrt(1.0 - w);
    EXPECT_NEAR(mean.value[c], expected, 4.0 * mean.error[c] + 1e-4) << "albedo " << w;
    EXPECT_LT(mean.error[c], 0.01 * expected) << "too noisy to tell";
  }
  EXPECT_EQ(mean.longWalks, 0u);
}

// No light is lost or made inside, whatever the index and the phase function.
TEST(Wax, AWhiteBodyIsAWhiteFurnace) {
  for (const float ior : {1.0f, 1.4f}) {
    for (const float g : {0.0f, 0.8f, -0.5f}) {
      Wax wax;
      wax.albedo = glm::vec3(1.0f);
      wax.meanFreePath = glm::vec3(0.2f, 0.3f, 0.5f);
      wax.g = g;
      wax.ior = ior;
      const auto scene = boxOf(wax, 0.5, 0.4);
      for (const char* integrator : {"path", "restir_gi", "restir_pt"}) {
        const Mean mean = meanOf(scene, integrator, 4, 24);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(mean.value[c], 1.0, 4.0 * mean.error[c] + 1e-3)
              << integrator << ", index " << ior << ", g " << g;
          EXPECT_LT(mean.error[c], 0.02) << "too noisy to tell";
        }
      }
    }
  }
}

// The profile's albedo is an approximation within 1 % of Chandrasekhar's.
TEST(Wax, AProfileIsAsBrightAsAHalfSpace) {
  Wax wax;
  wax.hasDiffusion = true;
  wax.albedo = {0.5f, 0.9f, 0.97f};
  wax.meanFreePath = {0.05f, 0.1f, 0.03f};
  const Mean mean = meanOf(boxOf(wax, 8.0, 5.0), "path", 20, 20);
  for (int c = 0; c < 3; ++c) {
    const double w = wax.albedo[c];
    const double expected = 1.0 - hOfOne(w) * std::sqrt(1.0 - w);
    EXPECT_NEAR(mean.value[c], expected, 4.0 * mean.error[c] + 0.01 * expected) << "albedo " << w;
    EXPECT_LT(mean.error[c], 0.01 * expected) << "too noisy to tell";
  }
  wax.albedo = glm::vec3(1.0f);
  wax.meanFreePath = {0.05f, 0.1f, 1e-5f};  // also so short that rounding of positions would show
  for (const float ior : {1.0f, 1.4f, 3.0f}) {
    wax.ior = ior;
    const Mean white = meanOf(boxOf(wax, 8.0, 5.0), "path", 20, 20);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(white.value[c], 1.0, 4.0 * white.error[c] + 1e-3) << "index " << ior;
      EXPECT_LT(white.error[c], 0.02) << "too noisy to tell";
    }
  }
}

// The tint counts on the way in and on the way out.
TEST(Wax, AProfileIsTintedAsTheWalk) {
  Wax wax;
  wax.albedo = glm::vec3(1.0f);
  wax.hasDiffusion = true;
  Scene scene = boxOf(wax, 8.0, 5.0)->source();
  scene.materials[0].data.baseColor = {0.5f, 0.8f, 1.0f};
  const Mean mean = meanOf(CompiledScene::build(std::move(scene)), "path", 20, 20);
  const double expected[3] = {0.25, 0.64, 1.0};
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(mean.value[c], expected[c], 4.0 * mean.error[c] + 1e-3) << "channel " << c;
}

// A small lamp on a half space, seen from above: its light in a ring of pixels after another.
std::vector<double> ringsAround(const Wax& wax, const char* integrator, uint32_t frames) {
  SceneBuilder builder("spot");
  const uint32_t material = builder.addMaterial("wax", builtin::glass(0.4f, glm::vec3(0.0f)));
  builder.add(builtin::box("box", {-8.0, -8.0, -6.0}, {8.0, 8.0, -1.0}), material);
  builder.add(builtin::quad("lamp", {-0.03, -0.03, -0.999}, {0.0, 0.06, 0.0}, {0.06, 0.0, 0.0}),
              builder.addMaterial("lamp", builtin::lamp(glm::vec3(100.0f))));
  Scene scene = builder.finish();
  scatter(wax, scene.materials[material]);
  lookAlongZ(scene, 0.48);
  SessionConfig config;
  config.integrator = integrator;
  config.width = config.height = 16;
  config.maxBounces = 16;
  Session session(CompiledScene::build(std::move(scene)), config);
  std::vector<double> rings(3);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    session.frame();
    const Image& image = session.radiance();
    for (int i = 0; i < 256; ++i) {
      const double r = std::hypot(i % 16 - 7.5, i / 16 - 7.5);
      if (r < 6.0) rings[size_t(r / 2.0)] += image.pixels[size_t(i)].x / frames;
    }
  }
  return rings;
}

// Rings of 2.4 mean free paths: measured 0.9 to 1.25 times the walk's light.
TEST(Wax, AProfileSpreadsLightAsFarAsTheWalk) {
  for (const float ior : {1.0f, 1.4f}) {
    Wax wax;
    wax.albedo = glm::vec3(0.95f);
    wax.ior = ior;
    const std::vector<double> walk = ringsAround(wax, "path", 1000);
    wax.hasDiffusion = true;
    const std::vector<double> profile = ringsAround(wax, "path", 1000);
    for (size_t ring = 0; ring < walk.size(); ++ring) {
      EXPECT_GT(walk[ring], 0.05) << "nothing to compare";
      EXPECT_NEAR(profile[ring] / walk[ring], 1.0, 0.35) << "index " << ior << ", ring " << ring;
    }
    EXPECT_NEAR((profile[0] + profile[1] + profile[2]) / (walk[0] + walk[1] + walk[2]), 1.0, 0.12)
        << "index " << ior;
  }
}

// A profile is biased beside the walk, but all methods show the same one.
TEST(Wax, MethodsAgreeOnAProfile) {
  SceneBuilder builder("blocks");
  Wax wax;
  wax.hasDiffusion = true;
  wax.albedo = {0.95f, 0.9f, 0.7f};
  wax.meanFreePath = {0.1f, 0.05f, 0.03f};
  wax.ior = 1.4f;
  const auto makeWax = [&](const char* name, float roughness) {
    return builder.addMaterial(name, builtin::glass(roughness, glm::vec3(0.0f)));
  };
  const uint32_t smooth = makeWax("smooth", 0.0f), rough = makeWax("rough", 0.7f);
  builder.add(builtin::box("left", {-0.4, -0.3, -1.6}, {-0.05, 0.3, -1.2}), smooth);
  builder.add(builtin::box("right", {0.05, -0.3, -1.6}, {0.4, 0.3, -1.2}), rough);
  builder.add(builtin::quad("wall", {-1.0, -1.0, -1.7}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}),
              builder.addMaterial("wall", builtin::lambert({0.8f, 0.4f, 0.3f})));
  builder.add(builtin::quad("lamp", {-0.3, 0.6, -1.4}, {0.6, 0.0, 0.0}, {0.0, 0.0, 0.4}),
              builder.addMaterial("lamp", builtin::lamp(glm::vec3(4.0f))));
  Scene scene = builder.finish();
  scatter(wax, scene.materials[smooth]);
  scatter(wax, scene.materials[rough]);
  lookAlongZ(scene, 0.5);
  expectMethodsAgree(CompiledScene::build(std::move(scene)));
}

// A lamp and a matte red wall inside of wax: restir_pt agrees with path, though it resamples the
// light that reaches the wall without a collision.
TEST(Wax, BodiesInsideOfItAreLit) {
  SceneBuilder builder("inside");
  const uint32_t material = builder.addMaterial("wax", builtin::glass(0.0f, glm::vec3(0.0f)));
  builder.add(builtin::box("box", {-1.0, -1.0, -3.0}, {1.0, 1.0, -1.0}), material);
  builder.add(builtin::quad("wall", {-0.6, -0.6, -2.4}, {1.2, 0.0, 0.0}, {0.0, 1.2, 0.0}),
              builder.addMaterial("wall", builtin::lambert({0.8f, 0.4f, 0.1f})));
  builder.add(builtin::quad("lamp", {0.3, 0.3, -1.6}, {0.0, 0.5, 0.0}, {0.5, 0.0, 0.0}),
              builder.addMaterial("lamp", builtin::lamp(glm::vec3(4.0f))));
  Scene scene = builder.finish();
  SceneMaterial& m = scene.materials[material];
  m.sigmaScattering = {1.0f, 0.5f, 2.0f};
  m.data.sigmaAbsorption = {0.2f, 0.3f, 0.1f};
  m.data.ior = 1.0f;
  lookAlongZ(scene, 0.3);
  expectMethodsAgree(CompiledScene::build(std::move(scene)));
}

// Light that does not come out in 1023 collisions is lost, and said.
TEST(Wax, WalksThatDoNotEndAreCounted) {
  Wax wax;
  wax.albedo = glm::vec3(1.0f);
  wax.meanFreePath = glm::vec3(0.001f);
  const Mean mean = meanOf(boxOf(wax, 8.0, 5.0), "path", 4, 2);
  EXPECT_GT(mean.longWalks, 4u);
  EXPECT_LT(mean.value.x, 1.0);
  EXPECT_GT(mean.value.x, 0.9);
}

}  // namespace
}  // namespace restlab
