// A kernel of the mask that the feature scan asks for sees what the general kernel sees, over
// random materials: factors and texels that are 0, 1 or between, and other materials beside them,
// whose needs switch a feature on for all.
#include <gtest/gtest.h>

#include <cstring>
#include <iterator>

#include "core/dialect/order.h"
#include "core/scene/builtin_builder.h"
#include "core/scene/builtin_mesh.h"
#include "core/scene/compiled_scene.h"
#include "tests/unit/random_inputs.h"

#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) ((void)0)

namespace restlab::unit {
namespace {

using namespace rl;

// The dialect's functions under a mask that is known at run time only.
struct MaskedContext {
  const uint kFeatures;
  const SceneData& gScene;
  const FrameData& gFrame;

#include "core/dialect/order.glsl"
  // No ray is traced: surfaces are asked for by their hits.
  float traceRay(const Ray&, uint, uint, Hit&) { return 0.0f; }
};

float factorOf(Inputs& inputs) {
  const uint32_t kind = inputs.below(3);
  return kind == 0 ? 0.0f : kind == 1 ? 1.0f : inputs.uniform();
}

// A 2 x 1 image whose channels are 0 or 255 throughout, or differ between its texels.
uint32_t addTexture(Scene& scene, Inputs& inputs) {
  TextureImage image{"image", 2, 1, {0u, 0u}};
  for (uint32_t channel = 0; channel < 4; ++channel) {
    const uint32_t kind = inputs.below(3);
    for (uint32_t& texel : image.texels) {
      const uint32_t value = kind == 0 ? 0u : kind == 1 ? 255u : inputs.below(256);
      texel |= value << (8u * channel);
    }
  }
  scene.images.push_back(image);
  TextureUse use;
  use.image = uint32_t(scene.images.size() - 1);
  use.srgb = inputs.below(2) == 0;
  scene.textureUses.push_back(use);
  return uint32_t(scene.textureUses.size() - 1);
}

Material randomMaterial(Scene& scene, Inputs& inputs) {
  Material m = builtin::lambert({factorOf(inputs), factorOf(inputs), factorOf(inputs)});
  m.metallic = factorOf(inputs);
  m.roughness = factorOf(inputs);
  m.ior = inputs.below(4) == 0 ? 1.0f : inputs.uniform(1.1f, 2.0f);
  m.transmission = inputs.below(2) == 0 ? 0.0f : factorOf(inputs);
  m.specular = factorOf(inputs);
  m.specularColor = {factorOf(inputs), factorOf(inputs), factorOf(inputs)};
  if (inputs.below(2) == 0) m.emission = {factorOf(inputs), factorOf(inputs), factorOf(inputs)};
  if (inputs.below(2) == 0) m.sigmaAbsorption = {factorOf(inputs), 0.0f, factorOf(inputs)};
  constexpr uint32_t kFlags[] = {0u, 0u, RL_MATERIAL_THIN, RL_MATERIAL_BLACK, RL_MATERIAL_UNLIT};
  m.flags |= kFlags[inputs.below(std::size(kFlags))];
  for (uint32_t slot = 0; slot < RL_TEX_COUNT; ++slot) {
    if (slot != RL_TEX_NORMAL && inputs.below(3) == 0) m.textures[slot] = addTexture(scene, inputs);
  }
  return m;
}

Scene randomScene(Inputs& inputs, uint32_t materials) {
  Scene scene;
  for (uint32_t i = 0; i < materials; ++i) {
    MeshGeometry mesh = builtin::quad("square", {3.0 * i, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.geometries.push_back(mesh);
    scene.materials.push_back({"material", randomMaterial(scene, inputs)});
    scene.instances.push_back({"square", i, i, glm::dmat4(1.0)});
  }
  return scene;
}

// Everything that a path reads of a surface, and what its BSDF makes of two directions.
void expectSameSurface(MaskedContext& own, MaskedContext& general, const Hit& hit, Inputs& inputs,
                       uint32_t seed) {
  const glm::vec3 dir = inputs.direction();
  const Surface a = own.surfaceLoad(hit, dir), b = general.surfaceLoad(hit, dir);
  ASSERT_EQ(a.emission, b.emission) << seed;
  ASSERT_EQ(own.bsdfIsBlack(a.bsdf), general.bsdfIsBlack(b.bsdf)) << seed;
  if (own.bsdfIsBlack(a.bsdf)) return;  // the path ends there
  const glm::vec3 wi = inputs.direction();
  float pdfA, pdfB;
  const glm::vec3 fA = own.bsdfEvalAndPdf(a.bsdf, a.nGeoW, a.nShadeW, a.wo, wi, pdfA);
  const glm::vec3 fB = general.bsdfEvalAndPdf(b.bsdf, b.nGeoW, b.nShadeW, b.wo, wi, pdfB);
  ASSERT_EQ(fA, fB) << seed;
  ASSERT_EQ(pdfA, pdfB) << seed;
  const float uLobe = inputs.uniform();
  const glm::vec2 u = inputs.square();
  const BsdfDraw drawA = own.bsdfDraw(a.bsdf, a.nGeoW, a.nShadeW, a.wo, uLobe, u),
                 drawB = general.bsdfDraw(b.bsdf, b.nGeoW, b.nShadeW, b.wo, uLobe, u);
  ASSERT_EQ(drawA.lobe, drawB.lobe) << seed;
  if (drawA.lobe == 0u) return;
  ASSERT_EQ(drawA.weight, drawB.weight) << seed;
  ASSERT_EQ(drawA.wi, drawB.wi) << seed;
}

TEST(FeatureMask, OwnKernelsSeeWhatTheGeneralOneSees) {
  uint32_t masks = 0;
  for (uint32_t seed = 1; seed <= 3000; ++seed) {
    Inputs inputs(seed);
    const auto scene = CompiledScene::build(randomScene(inputs, 1 + inputs.below(3)));
    const FrameData frame{};
    MaskedContext own{scene->features(false), scene->data(), frame};
    MaskedContext general{RL_FEATURE_ALL & ~RL_FEATURE_MULTISCATTER, scene->data(), frame};
    masks |= scene->features(false);
    for (uint32_t i = 0; i < 16; ++i) {
      Hit hit{};
      hit.instance = inputs.below(uint32_t(scene->source().instances.size()));
      hit.primitive = inputs.below(2);
      hit.bary = 0.5f * inputs.square();
      expectSameSurface(own, general, hit, inputs, seed);
      if (HasFatalFailure()) return;
    }
  }
  constexpr uint32_t expected = RL_FEATURE_AREA_LIGHTS | RL_FEATURE_GLOSSY | RL_FEATURE_TEXTURES |
                                RL_FEATURE_TRANSMISSION | RL_FEATURE_VOLUME |
                                RL_FEATURE_EMISSIVE_TEXTURES;
  EXPECT_EQ(masks & expected, expected) << "some feature was never needed";
}

}  // namespace
}  // namespace restlab::unit
