// Delta lobes: mirror and smooth dielectric. Weights, frequencies, directions, energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/scene/builtin/builder.h"
#include "tests/unit/bsdf_cases.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/ggx_reference.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

struct LobeSum {
  uint64_t draws = 0;
  glm::dvec3 weight{0.0};  // weight of a draw; equal for all draws
  glm::vec3 wi{0.0f};
  float pdf = 0.0f;
};

// Draws many times; every draw of one delta lobe must be the same.
std::map<uint32_t, LobeSum> drawLobes(const rl::Bsdf& bsdf, const glm::vec3& wo, uint64_t samples) {
  Dialect<> d;
  Inputs inputs(9);
  std::map<uint32_t, LobeSum> lobes;
  for (uint64_t i = 0; i < samples; ++i) {
    const float uLobe = inputs.uniform();
    const rl::BsdfSample draw = d->bsdfSample(bsdf, kUp, kUp, wo, uLobe, inputs.square());
    LobeSum& lobe = lobes[draw.lobe];
    ++lobe.draws;
    if ((draw.lobe & rl::RL_LOBE_ANY_DELTA) == 0) continue;
    if (lobe.draws > 1) {
      EXPECT_EQ(lobe.wi, draw.wi);
      EXPECT_EQ(lobe.weight, glm::dvec3(draw.weight));
    }
    lobe.wi = draw.wi;
    lobe.weight = draw.weight;
    lobe.pdf = draw.pdfSolidAngle;
  }
  return lobes;
}

// Radiance factor of a delta lobe: its weight times the probability of drawing it.
glm::dvec3 factor(const std::map<uint32_t, LobeSum>& lobes, uint32_t lobe) {
  const auto it = lobes.find(lobe);
  return it == lobes.end() ? glm::dvec3(0.0) : it->second.weight * double(it->second.pdf);
}

TEST(BsdfDelta, FrequencyIsTheDeclaredProbability) {
  constexpr uint64_t n = 200'000;
  for (const BsdfCase& c : deltaBsdfs()) {
    for (double angle : kAngles) {
      for (const auto& [lobe, sum] : drawLobes(c.bsdf, directionAt(angle), n)) {
        if ((lobe & rl::RL_LOBE_ANY_DELTA) == 0) continue;
        const double p = sum.pdf, sigma = std::sqrt(std::max(p * (1.0 - p), 1e-12) / n);
        EXPECT_NEAR(double(sum.draws) / n, p, 5.0 * sigma)
            << c.name << " at " << angle << ", lobe " << lobe;
      }
    }
  }
}

// An index of refraction of 1 is no surface: light is neither bent, blurred nor lost, thin or
// solid, from either side.
TEST(BsdfDelta, AnIndexOfOneIsNotThere) {
  for (const float roughness : {0.0f, 0.5f, 1.0f}) {
    for (const uint32_t flags : {0u, rl::RL_MATERIAL_THIN}) {
      rl::Material m = builtin::glass(roughness, glm::vec3(0.0f));
      m.baseColor = glm::vec3(0.5f);  // colourless, the surface would be removed from the scene
      m.ior = 1.0f;
      m.flags |= flags;
      for (const bool front : {true, false}) {
        const rl::Bsdf bsdf = bsdfOf(m, front);
        for (double angle : kAngles) {
          const glm::vec3 wo = directionAt(angle);
          const auto lobes = drawLobes(bsdf, wo, 1000);
          ASSERT_EQ(lobes.size(), 1u) << roughness;
          const LobeSum& lobe = lobes.begin()->second;
          EXPECT_EQ(lobes.begin()->first, rl::RL_LOBE_TRANSMISSION_DELTA);
          EXPECT_LT(glm::distance(lobe.wi, -wo), 1e-6f);
          EXPECT_NEAR(lobe.weight.x, m.baseColor.x, 1e-6);
        }
      }
    }
  }
}

TEST(BsdfDelta, MirrorReflectsAllOfItsFresnelTerm) {
  const glm::vec3 f0(0.9f, 0.6f, 0.2f);
  const rl::Bsdf bsdf = bsdfOf(builtin::metal(f0, 0.0f), true);
  ASSERT_EQ(bsdf.lobes, rl::RL_LOBE_SPECULAR_DELTA);
  for (double angle : kAngles) {
    const glm::vec3 wo = directionAt(angle);
    const auto lobes = drawLobes(bsdf, wo, 1000);
    ASSERT_EQ(lobes.size(), 1u);
    const LobeSum& mirror = lobes.at(rl::RL_LOBE_SPECULAR_DELTA);
    EXPECT_LT(glm::distance(mirror.wi, glm::vec3(-wo.x, -wo.y, wo.z)), 1e-6f);
    EXPECT_EQ(mirror.pdf, 1.0f);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mirror.weight[c], reference::fresnelSchlick(wo.z, f0[c], 1.0), 1e-5);
    }
  }
}

// Reflected and transmitted flux of clear glass sum to one; radiance is scaled by 1 / eta^2.
TEST(BsdfDelta, SmoothGlassKeepsEnergy) {
  for (const bool front : {true, false}) {
    const rl::Bsdf bsdf = bsdfOf(builtin::glass(0.0f, glm::vec3(0.0f)), front);
    const double eta = front ? 1.5 : 1.0 / 1.5;
    for (double angle : kAngles) {
      const glm::vec3 wo = directionAt(angle);
      const auto lobes = drawLobes(bsdf, wo, 20'000);
      const double reflected = factor(lobes, rl::RL_LOBE_SPECULAR_DELTA).x;
      const double transmitted = factor(lobes, rl::RL_LOBE_TRANSMISSION_DELTA).x;
      EXPECT_NEAR(reflected, reference::fresnel(wo.z, eta), 1e-5) << angle;
      EXPECT_NEAR(reflected + transmitted * eta * eta, 1.0, 1e-5) << angle;
      const bool isTotal = std::sqrt(1.0 - double(wo.z) * wo.z) / eta >= 1.0;
      EXPECT_EQ(lobes.count(rl::RL_LOBE_TRANSMISSION_DELTA), isTotal ? 0u : 1u) << angle;
      if (isTotal) continue;
      // Snell's law; the azimuth goes straight through.
      const glm::vec3 wi = lobes.at(rl::RL_LOBE_TRANSMISSION_DELTA).wi;
      EXPECT_LT(wi.z, 0.0f);
      EXPECT_NEAR(-wi.x * eta, wo.x, 1e-5);
      EXPECT_NEAR(-wi.y * eta, wo.y, 1e-5);
    }
  }
}

TEST(BsdfDelta, ThinGlassLetsLightStraightThrough) {
  rl::Material material = builtin::glass(0.0f, glm::vec3(0.0f));
  material.flags |= rl::RL_MATERIAL_THIN;
  for (const bool front : {true, false}) {
    const rl::Bsdf bsdf = bsdfOf(material, front);
    for (double angle : kAngles) {
      const glm::vec3 wo = directionAt(angle);
      const auto lobes = drawLobes(bsdf, wo, 20'000);
      const double reflected = factor(lobes, rl::RL_LOBE_SPECULAR_DELTA).x;
      EXPECT_NEAR(reflected, reference::fresnel(wo.z, 1.5), 1e-5) << angle;
      EXPECT_NEAR(reflected + factor(lobes, rl::RL_LOBE_TRANSMISSION_DELTA).x, 1.0, 1e-5) << angle;
      EXPECT_LT(glm::distance(lobes.at(rl::RL_LOBE_TRANSMISSION_DELTA).wi, -wo), 1e-6f);
    }
  }
}

// A white base under a smooth layer returns everything: the reflected light and the light that
// passes the layer twice sum to one at every angle.
TEST(BsdfDelta, WhiteBaseUnderASmoothLayerIsAWhiteFurnace) {
  Dialect<> d;
  const rl::Bsdf bsdf = bsdfOf(builtin::plastic(glm::vec3(1.0f), 0.0f), true);
  for (double angle : kAngles) {
    const glm::vec3 wo = directionAt(angle);
    Inputs inputs(10);
    double sum = 0.0;
    constexpr int n = 400'000;
    for (int i = 0; i < n; ++i) {
      const float uLobe = inputs.uniform();
      sum += d->bsdfSample(bsdf, kUp, kUp, wo, uLobe, inputs.square()).weight.x;
    }
    EXPECT_NEAR(sum / n, 1.0, 3e-3) << angle;
  }
}

// Roughness below the floor becomes a delta lobe, and is counted.
TEST(BsdfDelta, AlphaFloorIsCounted) {
  builtin::SceneBuilder builder("floor");
  const float below = std::sqrt(0.999f * rl::RL_ALPHA_FLOOR),
              above = std::sqrt(1.001f * rl::RL_ALPHA_FLOOR);
  MeshGeometry mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  builder.add(mesh, builder.addMaterial("below", builtin::metal(glm::vec3(1.0f), below)));
  builder.add(mesh, builder.addMaterial("above", builtin::metal(glm::vec3(1.0f), above)));
  Dialect<> d(CompiledScene::build(builder.finish()));
  const glm::vec3 down(0.0f, 0.0f, -1.0f);
  EXPECT_EQ(d->surfaceLoad({1, 0, {0.2f, 0.2f}, 1.0f}, down).bsdf.lobes, rl::RL_LOBE_SPECULAR);
  EXPECT_EQ(d.counters.health[rl::RL_HEALTH_DELTA_LOBES], 0u);
  EXPECT_EQ(d->surfaceLoad({0, 0, {0.2f, 0.2f}, 1.0f}, down).bsdf.lobes,
            rl::RL_LOBE_SPECULAR_DELTA);
  EXPECT_EQ(d.counters.health[rl::RL_HEALTH_DELTA_LOBES], 1u);
}

}  // namespace
}  // namespace restlab::unit
