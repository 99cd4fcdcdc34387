// Multiple-scattering compensation of GGX (core/shading/bsdf/multiscatter.glsl): the table, white
// furnaces, coloured metal against the formula, reciprocity, and no effect when switched off.
// bsdf_sampling_test.cpp tests its sampling.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "tests/unit/bsdf_cases.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/ggx_reference.h"
#include "tests/unit/random_inputs.h"
#include "experiments/statistics/sphere_grid.h"

namespace restlab::unit {
namespace {

constexpr rl::FeatureMask kWithout = rl::RL_FEATURE_ALL & ~rl::RL_FEATURE_MULTISCATTER;

// Allowed interpolation error of the table in an albedo: for alpha from 0.02 on, and below. On
// smoother surfaces, the albedo turns closer to the horizon.
constexpr double kRoughError = 1e-3, kSmoothError = 5e-3;

double tableError(double alpha) { return alpha < 0.02 ? kSmoothError : kRoughError; }

double one(double) { return 1.0; }
double schlick(double cosH) { return std::pow(1.0 - cosH, 5.0); }

TEST(Multiscatter, TableAgainstIntegralsOverMicrofacets) {
  Dialect<> d;
  d.compensate();
  double worst = 0.0;
  // Most values lie between the nodes.
  for (const double alpha : {0.0015, 0.005, 0.012, 0.02, 0.1, 0.35, 0.71, 1.0}) {
    for (const double cosO : {0.01, 0.053, 0.2, 0.47, 1.0}) {
      glm::vec2 at, mean;
      d->multiscatterAlbedo(float(alpha), float(cosO), at, mean);
      const double loss = 1.0 - reference::reflectedAlbedo(cosO, alpha, one);
      const double part = reference::reflectedAlbedo(cosO, alpha, schlick);
      EXPECT_NEAR(at.x, loss, tableError(alpha)) << "alpha " << alpha << ", cosine " << cosO;
      EXPECT_NEAR(at.y, part, tableError(alpha)) << "alpha " << alpha << ", cosine " << cosO;
      worst = std::max({worst, std::abs(at.x - loss), std::abs(at.y - part)});
    }
  }
  std::printf("  largest error of the table: %.2g\n", worst);
  // Closed form: at alpha = 1 and normal incidence the loss is ln 2.
  glm::vec2 at, mean;
  d->multiscatterAlbedo(1.0f, 1.0f, at, mean);
  EXPECT_NEAR(at.x, std::log(2.0), 5e-4);
  d->multiscatterAlbedo(0.0f, 0.5f, at, mean);
  EXPECT_EQ(at.x, 0.0f) << "a smooth surface loses nothing";
  EXPECT_NEAR(mean.y, 1.0 / 21.0, 1e-4) << "and the mean of Schlick's weight is 1/21";
}

template <rl::FeatureMask FEATURES>
glm::dvec3 albedoOf(Dialect<FEATURES>& d, const rl::Bsdf& bsdf, const glm::vec3& wo) {
  const stats::SphereGrid grid({{{-wo.x, -wo.y, wo.z}, 2.0 * bsdf.alpha}});
  glm::dvec3 sum(0.0);
  for (const glm::dvec4& cell : grid.integrate([&](const glm::dvec3& wi) {
         return glm::dvec4(glm::dvec3(d->bsdfEval(bsdf, kUp, kUp, wo, glm::vec3(wi))), 0.0);
       })) {
    sum += glm::dvec3(cell);
  }
  return sum;
}

constexpr float kAlphas[] = {0.002f, 0.02f, 0.1f, 0.3f, 0.6f, 1.0f};

void expectWhiteFurnace(const std::string& what, rl::Material (*make)(float roughness)) {
  Dialect<> on, off;
  on.compensate();
  for (const float alpha : kAlphas) {
    const rl::Bsdf bsdf = bsdfOf(make(std::sqrt(alpha)), true);
    std::printf("  %s, alpha %.3f, albedo off -> on:", what.c_str(), double(alpha));
    for (const double angle : kAngles) {
      const glm::vec3 wo = directionAt(angle);
      const double before = albedoOf(off, bsdf, wo).x, after = albedoOf(on, bsdf, wo).x;
      std::printf("  %.4f -> %.4f", before, after);
      // Allow 1e-3 more for the numeric integral.
      EXPECT_NEAR(after, 1.0, tableError(alpha) + 1e-3)
          << what << ", alpha " << alpha << " at " << angle;
    }
    std::printf("\n");
  }
}

TEST(Multiscatter, WhiteMetalIsAWhiteFurnace) {
  expectWhiteFurnace("white metal", [](float r) { return builtin::metal(glm::vec3(1.0f), r); });
  // Check that the test would detect the loss.
  Dialect<> off;
  const rl::Bsdf rough = bsdfOf(builtin::metal(glm::vec3(1.0f), 1.0f), true);
  EXPECT_NEAR(albedoOf(off, rough, kUp).x, 1.0 - std::log(2.0), 2e-3);
}

TEST(Multiscatter, WhiteBaseUnderARoughCoatIsAWhiteFurnace) {
  expectWhiteFurnace("white coat", [](float r) { return builtin::plastic(glm::vec3(1.0f), r); });
}

// Half metal, half coated base.
TEST(Multiscatter, WhiteMixtureMakesNoEnergy) {
  Dialect<> on;
  on.compensate();
  for (const float alpha : kAlphas) {
    rl::Material m = builtin::plastic(glm::vec3(1.0f), std::sqrt(alpha));
    m.metallic = 0.5f;
    const rl::Bsdf bsdf = bsdfOf(m, true);
    for (const double angle : kAngles) {
      EXPECT_LE(albedoOf(on, bsdf, directionAt(angle)).x, 1.0 + tableError(alpha) + 1e-3)
          << "alpha " << alpha << " at " << angle;
    }
  }
}

// Compares with the formula in double precision, over integrals that do not use the table.
TEST(Multiscatter, ColouredMetalFollowsTheFormula) {
  const glm::vec3 f0(1.0f, 0.5f, 0.04f);
  Dialect<> on, off;
  on.compensate();
  for (const float alpha : {0.3f, 1.0f}) {
    const rl::Bsdf bsdf = bsdfOf(builtin::metal(f0, std::sqrt(alpha)), true);
    double mean = 0.0;  // cosine-weighted mean of E
    for (int i = 0; i < 5; ++i) {
      const double x = 0.5 + 0.5 * stats::kGauss5X[i];
      mean += stats::kGauss5W[i] * x * reference::reflectedAlbedo(x, bsdf.alpha, one);
    }
    for (const double angle : kAngles) {
      const glm::vec3 wo = directionAt(angle);
      const glm::dvec3 albedo = albedoOf(on, bsdf, wo), single = albedoOf(off, bsdf, wo);
      const double loss = 1.0 - reference::reflectedAlbedo(wo.z, bsdf.alpha, one);
      for (int c = 0; c < 3; ++c) {
        const double average = f0[c] + (1.0 - f0[c]) / 21.0;
        const double expected = average * average * mean / (1.0 - average * (1.0 - mean)) * loss;
        EXPECT_NEAR(albedo[c] - single[c], expected, 2e-3)
            << "alpha " << alpha << " at " << angle << ", channel " << c;
      }
      // More bounces give more saturated colour.
      EXPECT_LT(albedo.y / albedo.x, single.y / single.x);
    }
  }
}

TEST(Multiscatter, Reciprocity) {
  Dialect<> d;
  d.compensate();
  Inputs inputs(5);
  for (const BsdfCase& c : continuousBsdfs()) {
    if ((c.bsdf.lobes & rl::RL_LOBE_ANY_TRANSMISSION) != 0) continue;
    int compared = 0;
    for (int i = 0; i < 20'000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.directionAbove(kUp);
      if (wo.z < 0.02f || wi.z < 0.02f) continue;
      const glm::dvec3 there = glm::dvec3(d->bsdfEval(c.bsdf, kUp, kUp, wo, wi)) / double(wi.z);
      const glm::dvec3 back = glm::dvec3(d->bsdfEval(c.bsdf, kUp, kUp, wi, wo)) / double(wo.z);
      const double scale = std::max({there.x, there.y, there.z, 1e-2});
      ASSERT_LT(glm::length(there - back), 3e-3 * scale)
          << c.name << ", " << wo.z << " -> " << wi.z;
      if (scale > 1e-2) ++compared;
    }
    EXPECT_GT(compared, 50) << c.name;
  }
}

bool sameBits(const glm::vec3& a, const glm::vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class A, class B>
void expectSameBits(A& a, B& b, const BsdfCase& c) {
  Inputs inputs(11);
  for (int i = 0; i < 20'000; ++i) {
    const glm::vec3 nShade = inputs.direction();
    const glm::vec3 nGeo = glm::normalize(nShade + 0.4f * inputs.direction());
    const glm::vec3 wo = inputs.directionAbove(nGeo), wi = inputs.direction();
    const float uLobe = inputs.uniform();
    const glm::vec2 u = inputs.square();
    const rl::BsdfSample x = a->bsdfSample(c.bsdf, nGeo, nShade, wo, uLobe, u);
    const rl::BsdfSample y = b->bsdfSample(c.bsdf, nGeo, nShade, wo, uLobe, u);
    ASSERT_EQ(x.lobe, y.lobe) << c.name;
    ASSERT_EQ(x.pdfSolidAngle, y.pdfSolidAngle) << c.name;
    ASSERT_TRUE(sameBits(x.wi, y.wi) && sameBits(x.weight, y.weight)) << c.name;
    ASSERT_EQ(a->bsdfPdf(c.bsdf, nGeo, nShade, wo, wi), b->bsdfPdf(c.bsdf, nGeo, nShade, wo, wi))
        << c.name;
    ASSERT_TRUE(sameBits(a->bsdfEval(c.bsdf, nGeo, nShade, wo, wi),
                         b->bsdfEval(c.bsdf, nGeo, nShade, wo, wi)))
        << c.name;
  }
}

// Switched off, the general kernel gives the bits of the kernel without the feature; switched on,
// mirrors, glass and Lambert stay unchanged.
TEST(Multiscatter, OffIsTheSameBits) {
  Dialect<> off, on;
  on.compensate();
  Dialect<kWithout> without;
  std::vector<BsdfCase> cases = continuousBsdfs();
  for (const BsdfCase& c : deltaBsdfs()) cases.push_back(c);
  size_t untouched = 0;
  for (const BsdfCase& c : cases) {
    expectSameBits(off, without, c);
    const bool isRough = (c.bsdf.lobes & rl::RL_LOBE_SPECULAR) != 0;
    if (isRough && (c.bsdf.lobes & rl::RL_LOBE_ANY_TRANSMISSION) == 0) continue;
    ++untouched;
    expectSameBits(on, without, c);
  }
  EXPECT_GE(untouched, 10u);
}

Image rendered(const std::shared_ptr<const CompiledScene>& scene, bool multiscatter,
               uint32_t expectedBit, KernelChoice kernels = KernelChoice::builtIn) {
  SessionConfig config;
  config.width = config.height = 24;
  config.threads = 1;
  config.multiscatter = multiscatter;
  config.kernels = kernels;
  Session session(scene, config);
  EXPECT_EQ(session.featuresNeeded() & rl::RL_FEATURE_MULTISCATTER, expectedBit);
  if (expectedBit != 0u) {
    EXPECT_NE(session.featuresUsed() & rl::RL_FEATURE_MULTISCATTER, 0u);
  }
  session.frame();
  return session.radiance();
}

// A session needs the feature if it is asked for and changes something; the general kernel has the
// code, controlled by the frame.
TEST(Multiscatter, SessionsNeedItWhereItChangesSomething) {
  constexpr rl::FeatureMask bit = rl::RL_FEATURE_MULTISCATTER;
  const auto box = CompiledScene::build(makeBuiltinScene("cornell-box"));
  EXPECT_EQ(rendered(box, true, 0u).pixels, rendered(box, false, 0u).pixels);
  EXPECT_EQ(box->data().ggxAlbedo.data, nullptr) << "no table without a use";
  const auto gallery = CompiledScene::build(makeBuiltinScene("glossy-gallery"));
  const Image off = rendered(gallery, false, 0u), on = rendered(gallery, true, bit);
  EXPECT_NE(off.pixels, on.pixels);
  EXPECT_EQ(off.pixels, rendered(gallery, false, 0u, KernelChoice::general).pixels)
      << "off in the general kernel, after another session of the scene had it on";
  EXPECT_EQ(on.pixels, rendered(gallery, true, bit, KernelChoice::general).pixels);
}

}  // namespace
}  // namespace restlab::unit
