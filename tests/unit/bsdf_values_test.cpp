// Known values of the BSDF's parts: Fresnel, refraction, GGX, and their albedos, against formulas
// in double precision; reciprocity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "tests/unit/bsdf_cases.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/ggx_reference.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"
#include "experiments/statistics/sphere_grid.h"

namespace restlab::unit {
namespace {

float cosine(double degrees) { return static_cast<float>(std::cos(degrees * kPi / 180.0)); }

TEST(Fresnel, KnownValuesOfGlass) {
  Dialect<> d;
  EXPECT_NEAR(d->fresnelDielectric(1.0f, 1.5f), 0.04f, 1e-7f);
  EXPECT_NEAR(d->fresnelDielectric(1.0f, 1.0f / 1.5f), 0.04f, 1e-7f);
  EXPECT_NEAR(d->fresnelDielectric(0.0f, 1.5f), 1.0f, 1e-7f);
  // At Brewster's angle, tan = n, no light is reflected in the plane of incidence: half of ((n^2 -
  // 1) / (n^2 + 1))^2 remains.
  const double brewster = std::atan(1.5) * 180.0 / kPi;
  EXPECT_NEAR(d->fresnelDielectric(cosine(brewster), 1.5f), 0.5 * std::pow(1.25 / 3.25, 2.0), 1e-6);
  // Total internal reflection begins at 41.81 degrees.
  const double critical = std::asin(1.0 / 1.5) * 180.0 / kPi;
  EXPECT_LT(d->fresnelDielectric(cosine(critical - 0.1), 1.0f / 1.5f), 0.9f);
  for (double degrees : {critical + 0.01, 60.0, 89.0}) {
    EXPECT_EQ(d->fresnelDielectric(cosine(degrees), 1.0f / 1.5f), 1.0f);
  }
  for (float cosI : {0.01f, 0.3f, 1.0f}) EXPECT_NEAR(d->fresnelDielectric(cosI, 1.0f), 0.0f, 1e-6f);
}

TEST(Fresnel, MatchesComplexAmplitudes) {
  Dialect<> d;
  for (float eta : {0.4f, 0.66f, 0.9f, 1.1f, 1.33f, 1.5f, 2.4f}) {
    for (float cosI = 0.01f; cosI <= 1.0f; cosI += 0.01f) {
      EXPECT_NEAR(d->fresnelDielectric(cosI, eta), reference::fresnel(cosI, eta), 2e-5)
          << cosI << " " << eta;
      const double sin2T = (1.0 - double(cosI) * cosI) / (double(eta) * eta);
      if (sin2T < 0.999) {  // the same interface from the other side
        const auto cosT = static_cast<float>(std::sqrt(1.0 - sin2T));
        EXPECT_NEAR(d->fresnelDielectric(cosT, 1.0f / eta), d->fresnelDielectric(cosI, eta), 1e-4);
      }
    }
  }
}

TEST(Fresnel, SchlickWeight) {
  Dialect<> d;
  for (float cosI = 0.0f; cosI <= 1.0f; cosI += 0.01f) {
    EXPECT_NEAR(d->fresnelSchlickWeight(cosI), std::pow(1.0 - double(cosI), 5.0), 1e-6);
  }
}

TEST(Refraction, SnellsLawInThePlaneOfIncidence) {
  Dialect<> d;
  Inputs inputs(1);
  int total = 0, refracted = 0;
  for (int i = 0; i < 100'000; ++i) {
    const glm::vec3 h = inputs.direction(), wo = inputs.directionAbove(h);
    const float eta = inputs.scale(0.4f, 2.5f);
    glm::vec3 wi;
    const bool passes = d->transmissionRefract(wo, h, eta, wi);
    const double sinO = glm::length(glm::cross(glm::dvec3(wo), glm::dvec3(h)));
    if (std::abs(sinO / eta - 1.0) < 1e-5) continue;
    ASSERT_EQ(passes, sinO / eta < 1.0);
    if (!passes) {
      ++total;
      continue;
    }
    ++refracted;
    ASSERT_NEAR(glm::length(glm::dvec3(wi)), 1.0, 2e-6);
    ASSERT_LT(glm::dot(wi, h), 0.0f);
    // sin_o = eta sin_i, with the tangential parts opposite: wo_t = -eta wi_t.
    const glm::dvec3 woT = glm::dvec3(wo) - glm::dvec3(h) * glm::dot(glm::dvec3(wo), glm::dvec3(h));
    const glm::dvec3 wiT = glm::dvec3(wi) - glm::dvec3(h) * glm::dot(glm::dvec3(wi), glm::dvec3(h));
    ASSERT_LT(glm::length(woT + double(eta) * wiT), 4e-6);
    // The half vector must find the facet again.
    if (std::abs(eta - 1.0f) > 0.05f && h.z > 0.1f) {
      ASSERT_LT(glm::distance(d->transmissionHalfVector(wo, wi, eta), h),
                1e-3f / std::abs(eta - 1.0f) * 0.02f);
    }
  }
  EXPECT_GT(total, 5000);
  EXPECT_GT(refracted, 50'000);
}

// float32 must keep its digits at small alpha, where 1 - cos^2 would lose all of them.
TEST(Ggx, DistributionAndMaskingInFloat) {
  Dialect<> d;
  Inputs inputs(2);
  for (float alpha : {0.001f, 0.002f, 0.02f, 0.3f, 1.0f}) {
    for (int i = 0; i < 20'000; ++i) {
      const double tangent =
          alpha * std::sqrt(double(inputs.uniform()) / (1.0 - inputs.uniform() * 0.9999));
      const double phi = 2.0 * kPi * inputs.uniform(), c = 1.0 / std::sqrt(1.0 + tangent * tangent);
      const glm::vec3 h(glm::dvec3(tangent * c * std::cos(phi), tangent * c * std::sin(phi), c));
      ASSERT_NEAR(d->ggxD(h, alpha) / reference::ggxD(c, alpha), 1.0, 2e-5) << "alpha " << alpha;
      const glm::vec3 w = inputs.directionAbove(kUp);
      const double cosW = w.z;
      if (cosW < 1e-3) continue;
      const double expected = reference::ggxLambda(cosW, alpha);
      ASSERT_NEAR(d->ggxLambda(w, alpha), expected, 1e-6 + 1e-4 * expected);
    }
  }
}

TEST(Ggx, VisibleNormalsFollowTheirDensity) {
  Dialect<> d;
  for (float alpha : {0.001f, 0.05f, 0.4f, 1.0f}) {
    for (double angle : kAngles) {
      const glm::vec3 wo = directionAt(angle);
      // The mode lies between the normal and wo.
      const stats::SphereGrid grid({{glm::dvec3(0, 0, 1), alpha}});
      const auto density = [&](const glm::dvec3& h) {
        return glm::dvec4(h.z > 0.0 ? d->ggxPdfVisibleNormal(wo, glm::vec3(h), alpha) : 0.0f, 0.0,
                          0.0, 0.0);
      };
      std::vector<double> probabilities;
      double total = 0.0;
      for (const glm::dvec4& cell : grid.integrate(density)) {
        probabilities.push_back(cell.x);
        total += cell.x;
      }
      EXPECT_NEAR(total, 1.0, 2e-3) << "alpha " << alpha << " at " << angle;
      std::vector<uint64_t> counts(grid.size());
      Inputs inputs(3);
      for (int i = 0; i < 1'000'000; ++i) {
        const glm::vec3 h = d->ggxDrawVisibleNormal(wo, alpha, inputs.square());
        if (const auto cell = grid.find(glm::dvec3(h))) ++counts[*cell];
      }
      expectFits(
          counts, probabilities, 1'000'000,
          "visible normals, alpha " + std::to_string(alpha) + " at " + std::to_string(int(angle)));
    }
  }
}

TEST(Ggx, ReflectionMatchesTheFormula) {
  Dialect<> d;
  Inputs inputs(4);
  const glm::vec3 f0(0.9f, 0.5f, 0.04f);
  for (float roughness : {0.1f, 0.3f, 0.7f, 1.0f}) {
    const rl::Bsdf bsdf = bsdfOf(builtin::metal(f0, roughness), true);
    for (int i = 0; i < 20'000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.directionAbove(kUp);
      if (wo.z < 1e-2f || wi.z < 1e-2f) continue;
      const glm::vec3 f = d->bsdfEval(bsdf, kUp, kUp, wo, wi);
      for (int c = 0; c < 3; ++c) {
        const double expected = reference::reflection(
            wo, wi, double(roughness) * roughness,
            [&](double cosH) { return reference::fresnelSchlick(cosH, f0[c], 1.0); });
        ASSERT_NEAR(f[c], expected, 1e-6 + 2e-4 * expected);
      }
    }
  }
}

// Integral of eval over the sphere, per channel and hemisphere.
struct Albedo {
  glm::dvec3 up{0.0}, down{0.0};
};

Albedo albedoOf(const rl::Bsdf& bsdf, const glm::vec3& wo) {
  Dialect<> d;
  const stats::SphereGrid grid({{{-wo.x, -wo.y, wo.z}, 2.0 * bsdf.alpha}});
  const std::vector<glm::dvec4> cells = grid.integrate([&](const glm::dvec3& wi) {
    return glm::dvec4(glm::dvec3(d->bsdfEval(bsdf, kUp, kUp, wo, glm::vec3(wi))), 0.0);
  });
  Albedo a;
  for (size_t i = 0; i < cells.size(); ++i)
    (grid.isBelow(i) ? a.down : a.up) += glm::dvec3(cells[i]);
  return a;
}

TEST(Albedo, MetalAgainstIntegralOverMicrofacets) {
  const glm::vec3 f0(1.0f, 0.5f, 0.04f);
  for (float alpha : {0.002f, 0.02f, 0.2f, 0.6f, 1.0f}) {
    const rl::Bsdf bsdf = bsdfOf(builtin::metal(f0, std::sqrt(alpha)), true);
    for (double angle : kAngles) {
      const glm::vec3 wo = directionAt(angle);
      const Albedo a = albedoOf(bsdf, wo);
      for (int c = 0; c < 3; ++c) {
        const double expected = reference::reflectedAlbedo(wo.z, bsdf.alpha, [&](double cosH) {
          return reference::fresnelSchlick(cosH, f0[c], 1.0);
        });
        EXPECT_NEAR(a.up[c], expected, 1e-3)
            << "alpha " << alpha << " at " << angle << ", channel " << c;
        EXPECT_LE(a.up[c], 1.0 + 1e-3);
      }
    }
  }
}

TEST(Albedo, RoughGlassAgainstIntegralOverMicrofacets) {
  for (const bool front : {true, false}) {
    for (float alpha : {0.02f, 0.1f, 0.5f}) {
      const rl::Bsdf bsdf = bsdfOf(builtin::glass(std::sqrt(alpha), glm::vec3(0.0f)), front);
      const double eta = bsdf.eta;
      ASSERT_NEAR(eta, front ? 1.5 : 1.0 / 1.5, 1e-6);
      const auto fresnel = [&](double cosH) { return reference::fresnel(cosH, eta); };
      for (double angle : kAngles) {
        const glm::vec3 wo = directionAt(angle);
        const Albedo a = albedoOf(bsdf, wo);
        const double reflected = reference::reflectedAlbedo(wo.z, bsdf.alpha, fresnel);
        const double transmitted = reference::transmittedAlbedo(wo.z, bsdf.alpha, eta, fresnel);
        const std::string where = (front ? "front, alpha " : "back, alpha ") +
                                  std::to_string(alpha) + " at " + std::to_string(angle);
        EXPECT_NEAR(a.up.x, reflected, 1e-3) << where;
        EXPECT_NEAR(a.down.x, transmitted, 2e-3 * std::max(1.0, transmitted)) << where;
        EXPECT_LE(a.up.x + a.down.x * eta * eta, 1.0 + 1e-3) << where;
      }
    }
  }
}

TEST(Albedo, LambertIsItsColour) {
  const glm::vec3 color(1.0f, 0.5f, 0.1f);
  const rl::Bsdf bsdf = bsdfOf(builtin::lambert(color), true);
  for (double angle : kAngles) {
    const Albedo a = albedoOf(bsdf, directionAt(angle));
    EXPECT_LT(glm::length(a.up - glm::dvec3(color)), 1e-5);
    EXPECT_EQ(glm::length(a.down), 0.0);
  }
}

// Reflection is symmetric, f(o, i) = f(i, o). Refraction has f(o, i) eta^2 = f(i, o), seen from the
// other side.
TEST(Reciprocity, OfEveryBsdf) {
  Dialect<> d;
  Inputs inputs(5);
  for (const BsdfCase& c : continuousBsdfs()) {
    rl::Bsdf other = c.bsdf;
    other.eta = (c.bsdf.lobes & rl::RL_LOBE_THIN) != 0 ? c.bsdf.eta : 1.0f / c.bsdf.eta;
    const double eta2 =
        (c.bsdf.lobes & rl::RL_LOBE_THIN) != 0 ? 1.0 : double(c.bsdf.eta) * c.bsdf.eta;
    int compared = 0;
    for (int i = 0; i < 20'000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.direction();
      const float cosO = wo.z, cosI = std::abs(wi.z);
      if (cosO < 0.02f || cosI < 0.02f) continue;
      const glm::dvec3 there = glm::dvec3(d->bsdfEval(c.bsdf, kUp, kUp, wo, wi)) / double(cosI);
      glm::dvec3 back;
      if (wi.z > 0.0f) {
        back = glm::dvec3(d->bsdfEval(c.bsdf, kUp, kUp, wi, wo)) / double(cosO);
      } else {
        back = glm::dvec3(d->bsdfEval(other, -kUp, -kUp, wi, wo)) / double(cosO) / eta2;
      }
      // Far from its peak a lobe is a difference of nearly equal numbers: values there are below
      // 1e-2.
      const double scale = std::max({there.x, there.y, there.z, 1e-2});
      ASSERT_LT(glm::length(there - back), 3e-3 * scale)
          << c.name << ", " << wo.z << " -> " << wi.z;
      if (scale > 1e-2) ++compared;
    }
    EXPECT_GT(compared, 50) << c.name;
  }
}

}  // namespace
}  // namespace restlab::unit
