// The kernel with the mask from the feature scan gives the same results as the general kernel, over
// random materials: factors and texels that are 0, 1 or between, beside other materials whose needs
// switch a feature on for all.
#include <gtest/gtest.h>

#include <cstring>

#include "core/dialect/order.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/unit/random_materials.h"

#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) ((void)0)

namespace restlab::unit {
namespace {

using namespace rl;

// The dialect's functions under a mask that is known only at run time.
struct MaskedContext {
  const FeatureMask kFeatures;
  const SceneData& gScene;
  const FrameData& gFrame;

#include "core/dialect/order.glsl"
  // Tests trace no rays: they load surfaces from hand-made hits.
  float traceRay(const Ray&, uint, uint, Hit&) { return 0.0f; }
};

// Compares all that a path reads from a surface, and the values of its BSDF for two directions.
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
  const BsdfSample drawA = own.bsdfSample(a.bsdf, a.nGeoW, a.nShadeW, a.wo, uLobe, u),
                   drawB = general.bsdfSample(b.bsdf, b.nGeoW, b.nShadeW, b.wo, uLobe, u);
  ASSERT_EQ(drawA.lobe, drawB.lobe) << seed;
  if (drawA.lobe == 0u) return;
  ASSERT_EQ(drawA.weight, drawB.weight) << seed;
  ASSERT_EQ(drawA.wi, drawB.wi) << seed;
}

// Features that the scenes needed, one bit each.
FeatureMask compareScenes(uint32_t count, bool hasLayers) {
  FeatureMask masks = 0;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    Inputs inputs(seed);
    const auto scene = CompiledScene::build(randomSquares(inputs, 1 + inputs.below(3), hasLayers));
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
      if (testing::Test::HasFatalFailure()) return masks;
    }
  }
  return masks;
}

TEST(FeatureMask, OwnKernelsSeeWhatTheGeneralOneSees) {
  const FeatureMask masks = compareScenes(3000, false);
  constexpr FeatureMask expected = RL_FEATURE_AREA_LIGHTS | RL_FEATURE_GLOSSY |
                                   RL_FEATURE_TEXTURES | RL_FEATURE_TRANSMISSION |
                                   RL_FEATURE_VOLUME | RL_FEATURE_EMISSIVE_TEXTURES;
  EXPECT_EQ(masks & expected, expected) << "some feature was never needed";
}

TEST(FeatureMask, OwnKernelsSeeTheLayersThatTheGeneralOneSees) {
  const FeatureMask masks = compareScenes(2000, true);
  EXPECT_EQ(masks & RL_FEATURE_LAYERS, RL_FEATURE_LAYERS) << "some layer was never there";
}

}  // namespace
}  // namespace restlab::unit
