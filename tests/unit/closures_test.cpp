// Closures: laws that their files declare, and known values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/closure_cases.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

// Albedo for a direction: the mean weight of draws, stratified in both dimensions.
glm::dvec3 albedoOf(Dialect<>& d, const rl::Bsdf& b, const glm::vec3& wo, int side = 400) {
  Inputs inputs(5);
  glm::dvec3 sum(0.0);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::vec2 u((float(x) + inputs.uniform()) / float(side),
                        (float(y) + inputs.uniform()) / float(side));
      sum += glm::dvec3(d->bsdfSample(b, kUp, kUp, wo, inputs.uniform(), u).weight);
    }
  }
  return sum / double(side * side);
}

// f(wo, wi) = f(wi, wo), but where a file declares that it is not; and there it is not.
TEST(Closures, Reciprocity) {
  std::map<std::string, double> broken;  // by kind: the largest difference where it is declared
  for (const ClosureCase& c : closureCases()) {
    Dialect<> d(c.scene);
    Inputs inputs(11);
    double largest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp);
      glm::vec3 wi = inputs.directionAbove(kUp);
      // Half of them inside of a narrow lobe.
      if (i % 2 == 0) wi = glm::normalize(glm::vec3(-wo.x, -wo.y, wo.z) + 0.2f * c.bsdf.alpha * wi);
      if (wo.z < 0.02f || wi.z < 0.02f) continue;
      const glm::dvec3 there(d->bsdfEval(c.bsdf, kUp, kUp, wo, wi));
      const glm::dvec3 back(d->bsdfEval(c.bsdf, kUp, kUp, wi, wo));
      for (int channel = 0; channel < 3; ++channel) {
        const double a = there[channel] / wi.z, b = back[channel] / wo.z;
        ASSERT_GE(a, 0.0) << c.name;
        if (std::max(a, b) > 1e-6) largest = std::max(largest, std::abs(a - b) / std::max(a, b));
      }
    }
    if (c.breaksReciprocity) {
      double& most = broken[c.kind];
      most = std::max(most, largest);
    } else {
      EXPECT_LT(largest, 5e-3) << c.name;
    }
  }
  EXPECT_GE(broken.size(), 2u);
  for (const auto& [kind, largest] : broken)
    EXPECT_GT(largest, 0.5) << kind << ": declared not reciprocal, but it is";
}

// Closures that declare a gain of energy have one for some of the cases, and the normalised models
// have none.
TEST(Closures, DeclaredGainsOfEnergyAreThere) {
  Dialect<> d;
  std::map<std::string, double> most;  // by kind: the largest albedo where a gain is declared
  for (const ClosureCase& c : closureCases()) {
    if (!c.breaksEnergy) continue;
    for (const double angle : {45.0, 88.0})
      most[c.kind] = std::max(most[c.kind], albedoOf(d, c.bsdf, directionAt(angle), 60).x);
  }
  EXPECT_GE(most.size(), 4u);
  for (const auto& [kind, albedo] : most) EXPECT_GT(albedo, 1.02) << kind;
  for (const char* model : {"kind = \"phong\"\nmodel = \"modified\"\n",
                            "kind = \"blinn_phong\"\nmodel = \"normalised\"\n"}) {
    const std::string text = std::string(model) + "diffuse = 0.5\nspecular = 0.5\npower = 1.0\n";
    EXPECT_LE(albedoOf(d, closureOf(text), directionAt(60.0)).x, 1.0) << model;
  }
}

TEST(Closures, NormalisedLobesReflectTheirFactor) {
  Dialect<> d;
  const glm::vec3 wo = kUp;
  for (const std::string power : {"7.0", "100.0", "3000.0"}) {
    const std::string p = "power = " + power + "\n";
    EXPECT_NEAR(
        albedoOf(d, closureOf("kind = \"power_lobe\"\nmodel = \"normalised\"\ncolor = 0.6\n" + p),
                 wo)
            .x,
        0.6, 2e-3)
        << power;
    EXPECT_NEAR(
        albedoOf(d,
                 closureOf(
                     "kind = \"phong\"\nmodel = \"modified\"\ndiffuse = 0.0\nspecular = 0.6\n" + p),
                 wo)
            .x,
        0.6, 2e-3)
        << power;
    EXPECT_NEAR(
        albedoOf(
            d,
            closureOf(
                "kind = \"blinn_phong\"\nmodel = \"normalised\"\ndiffuse = 0.0\nspecular = 0.6\n" +
                p),
            wo)
            .x,
        0.6, 4e-3)
        << power;
  }
  // The raw one of the course: 2 pi / (7 + 2).
  EXPECT_NEAR(albedoOf(d, closureOf("kind = \"power_lobe\"\n"), wo).x, 2.0 * kPi / 9.0, 2e-3);
}

TEST(Closures, OrenNayarWithoutRoughnessIsLambert) {
  Dialect<> d;
  Inputs inputs(3);
  for (const std::string model : {"full", "fujii", "conserving"}) {
    const rl::Bsdf b =
        closureOf("kind = \"oren_nayar\"\nsigma = 0.0\ncolor = 0.7\nmodel = \"" + model + "\"\n");
    for (int i = 0; i < 1000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.directionAbove(kUp);
      EXPECT_NEAR(d->bsdfEval(b, kUp, kUp, wo, wi).x, 0.7 * wi.z / kPi, 2e-6) << model;
    }
  }
}

// A white surface of the conserving model returns all light, the two others lose some.
TEST(Closures, ConservingOrenNayarIsAWhiteFurnace) {
  Dialect<> d;
  const auto albedo = [&](const std::string& model, double angle) {
    const rl::Bsdf b =
        closureOf("kind = \"oren_nayar\"\nsigma = 1.0\ncolor = 1.0\nmodel = \"" + model + "\"\n");
    return albedoOf(d, b, directionAt(angle)).x;
  };
  for (const double angle : {0.0, 45.0, 75.0, 88.0})
    EXPECT_NEAR(albedo("conserving", angle), 1.0, 2e-3) << angle;
  EXPECT_LT(albedo("fujii", 0.0), 0.9);
  EXPECT_LT(albedo("full", 0.0), 0.95);
}

// The full model against equation 30 in double precision, at a geometry by hand: light and eye at
// 60 degrees on the same side, where its back scattering is largest.
TEST(Closures, FullOrenNayarScattersBack) {
  Dialect<> d;
  const rl::Bsdf b = closureOf("kind = \"oren_nayar\"\nsigma = 0.5\ncolor = 0.9\n");
  const double theta = kPi / 3.0, s2 = 0.25;
  const glm::vec3 w(float(std::sin(theta)), 0.0f, float(std::cos(theta)));
  const double bb = 2.0 * theta / kPi;
  const double c1 = 1.0 - 0.5 * s2 / (s2 + 0.33), c2 = 0.45 * s2 / (s2 + 0.09) * std::sin(theta);
  const double direct = c1 + c2 * std::tan(theta);
  const double between = 0.17 * 0.9 * s2 / (s2 + 0.13) * (1.0 - bb * bb);
  EXPECT_NEAR(d->bsdfEval(b, kUp, kUp, w, w).x, 0.9 / kPi * (direct + between) * std::cos(theta),
              1e-5);
  const glm::vec3 opposite(-w.x, 0.0f, w.z);
  EXPECT_LT(d->bsdfEval(b, kUp, kUp, w, opposite).x, 0.6f * d->bsdfEval(b, kUp, kUp, w, w).x);
}

// Reflectance of gold at normal incidence and at grazing incidence.
TEST(Closures, ConductorsReflectAsFresnelSays) {
  Dialect<> d;
  const rl::Bsdf gold = closureOf("kind = \"conductor\"\nmetal = \"Au\"\nalpha = 0.0\n");
  const auto reflectance = [](double n, double k) {
    return ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
  };
  const rl::BsdfSample s = d->bsdfSample(gold, kUp, kUp, kUp, 0.5f, {0.5f, 0.5f});
  EXPECT_EQ(s.lobe, rl::RL_LOBE_SPECULAR_DELTA);
  EXPECT_NEAR(s.weight.x, reflectance(0.18299, 3.4242), 1e-5);
  EXPECT_NEAR(s.weight.z, reflectance(1.3734, 1.7704), 1e-5);
  const rl::BsdfSample grazing =
      d->bsdfSample(gold, kUp, kUp, directionAt(89.9), 0.5f, {0.5f, 0.5f});
  EXPECT_GT(grazing.weight.z, 0.98f);
  // Without absorption it is a dielectric.
  for (const float cosI : {0.05f, 0.3f, 0.7f, 1.0f})
    EXPECT_NEAR(d->fresnelConductorOne(cosI, 1.5f, 0.0f), d->fresnelDielectric(cosI, 1.5f), 1e-5f);
}

// Each distribution of normals covers the surface once, and GGX with Smith's correlated masking is
// the lobe of glTF.
TEST(Closures, FacetsAreDistributions) {
  Dialect<> d;
  constexpr int kRings = 2000, kSectors = 64;
  for (const uint32_t kind : {rl::RL_FACETS_BECKMANN, rl::RL_FACETS_GGX, rl::RL_FACETS_BLINN}) {
    for (const glm::vec2 alpha :
         {glm::vec2(0.05f, 0.05f), glm::vec2(0.3f, 0.3f), glm::vec2(0.5f, 0.1f)}) {
      double area = 0.0;
      for (int i = 0; i < kRings; ++i) {
        const double theta = (i + 0.5) / kRings * kPi / 2.0, s = std::sin(theta),
                     c = std::cos(theta);
        for (int j = 0; j < kSectors; ++j) {
          const double phi = 2.0 * kPi * (j + 0.5) / kSectors;
          const glm::vec3 h(float(s * std::cos(phi)), float(s * std::sin(phi)), float(c));
          area +=
              d->facetsD(h, alpha, kind) * c * s * (kPi / 2.0 / kRings) * (2.0 * kPi / kSectors);
        }
      }
      EXPECT_NEAR(area, 1.0, 2e-3) << kind << " " << alpha.x << " " << alpha.y;
    }
  }
  Inputs inputs(9);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.directionAbove(kUp);
    const glm::vec3 h = glm::normalize(wo + wi);
    const float expected = d->ggxReflectionEval(wo, wi, h, 0.3f);
    EXPECT_NEAR(
        d->facetsEval(wo, wi, h, {0.3f, 0.3f}, rl::RL_FACETS_GGX, rl::RL_MASKING_CORRELATED),
        expected, 1e-4f * expected + 1e-7f);
  }
}

// Where a mesh has no tangents they run around the vertical, on every side of it.
TEST(Closures, TangentsOfMeshesWithout) {
  builtin::SceneBuilder builder("ball");
  builder.add(builtin::sphere("ball", {0.0, 0.0, 0.0}, 1.0, 3),
              builder.addMaterial("material", builtin::lambert(glm::vec3(0.5f))));
  Dialect<> d(CompiledScene::build(builder.finish()));
  const uint32_t triangles = d->recordGeometry(0).triangleCount;
  for (uint32_t i = 0; i < triangles; ++i) {
    const rl::Hit hit{0, i, {0.3f, 0.3f}, 1.0f};
    const rl::Instance instance = d->recordInstance(0);
    const rl::Geometry geometry = d->recordGeometry(0);
    const glm::uvec3 corners = d->gScene.triangles.data[i];
    const glm::vec3 n = d->surfaceLoad(hit, {0.0f, 0.0f, -1.0f}).nShadeW;
    const glm::vec2 turn = d->surfaceTangentAngle(
        instance, geometry, corners, hit.bary, d->surfaceTriangle(instance, geometry, corners), n);
    const glm::vec3 tangent = d->frameToWorld(n, glm::vec3(turn, 0.0f));
    if (std::abs(n.y) > 0.99f) continue;
    EXPECT_NEAR(tangent.y, 0.0f, 1e-5f) << i;
    EXPECT_GT(glm::dot(tangent, glm::vec3(n.z, 0.0f, -n.x)), 0.0f) << i;
  }
}

// Indices of 0, and colours of 0, leave no NaN.
TEST(Closures, BlackParametersAreFinite) {
  Dialect<> d;
  for (const char* text : {"kind = \"conductor\"\neta = 0.0\nk = 0.0\n",
                           "kind = \"disney\"\nbaseColor = 0.0\nspecular = 0.0\n",
                           "kind = \"disney\"\nbaseColor = 0.0\nmetallic = 1.0\n"}) {
    const rl::Bsdf b = closureOf(text);
    EXPECT_TRUE(std::isfinite(b.f0.x + b.diffuse.x)) << text;
    const float pdf = d->bsdfPdf(b, kUp, kUp, kUp, directionAt(30.0));
    EXPECT_TRUE(std::isfinite(pdf)) << text;
  }
}

// Between the centres of its cells a table is as good as its cells are narrow.
TEST(Closures, ATableIsTheBrdfThatItWasMadeOf) {
  for (const char* file : {"half", "directions"}) {
    const ClosureCase c =
        closureCaseOf(std::string("kind = \"table\"\nfile = \"") + file + "\"\ncolor = 0.5\n");
    Dialect<> d(c.scene);
    Inputs inputs(31);
    double squares = 0.0, reference = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.directionAbove(kUp);
      const double f = d->bsdfEval(c.bsdf, kUp, kUp, wo, wi).y / wi.z;
      const double exact = 0.5 * tabulatedBrdf(glm::dvec3(wo), glm::dvec3(wi)).y;
      squares += (f - exact) * (f - exact);
      reference += exact * exact;
    }
    EXPECT_LT(std::sqrt(squares / reference), 0.1) << file;
    // The least value counts as diffuse, all that rises above it as a lobe.
    EXPECT_NEAR(c.bsdf.diffuse.y, 0.5 * 0.3, 0.03) << file;
    EXPECT_NEAR(c.bsdf.alpha, std::sqrt(2.0 / 42.0), 0.1) << file;
    EXPECT_NE(c.bsdf.lobes & rl::RL_LOBE_SPECULAR, 0u) << file;
  }
}

// f of a mixture is the sum of its parts', the probability of a delta lobe its share.
TEST(Closures, AMixtureIsTheSumOfItsParts) {
  const ClosureCase c = closureCaseOf(
      "kind = \"mixture\"\nfirst = \"metal\"\nfirst_share = 0.5\nsecond = \"matte\"\n"
      "second_share = 0.3\nthird = \"hole\"\nthird_share = 0.1\nfourth = \"smooth\"\n"
      "fourth_share = 0.2\n");
  Dialect<> d(c.scene), alone;
  const rl::Bsdf metal = closureOf("kind = \"conductor\"\nalpha = 0.2\n");
  const rl::Bsdf smooth = closureOf("kind = \"plastic\"\n");
  Inputs inputs(5);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.directionAbove(kUp);
    const float metals = 0.5f * 0.4f * alone->bsdfEval(metal, kUp, kUp, wo, wi).x;
    const float mattes = 0.3f * 0.5f * wi.z / float(kPi);
    const float plastics = 0.2f * alone->bsdfEval(smooth, kUp, kUp, wo, wi).x;
    const float sum = metals + mattes + plastics;
    EXPECT_NEAR(d->bsdfEval(c.bsdf, kUp, kUp, wo, wi).x, sum, 1e-6f + 1e-5f * sum);
  }
  uint32_t deltas = 0;
  double weight = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const rl::BsdfSample s =
        d->bsdfSample(c.bsdf, kUp, kUp, kUp, (float(i) + 0.5f) / kDraws, inputs.square());
    if ((s.lobe & rl::RL_LOBE_ANY_DELTA) == 0) continue;
    ++deltas;
    weight += double(s.weight.x);
  }
  EXPECT_GT(deltas, 0u);
  EXPECT_NEAR(weight / kDraws, 0.2 * 0.04, 4e-4) << "a fifth of a layer that reflects 4 %";
}

// The tangent turns the frame: brushed metal is smooth along one axis of the texture.
TEST(Closures, AnisotropyFollowsTheTangent) {
  Dialect<> d;
  rl::Bsdf b = closureOf("kind = \"conductor\"\nalpha = 0.2\nanisotropic = 0.9\n");
  EXPECT_GT(b.p0.w, 5.0f * b.p1.w);
  const glm::vec3 wo = kUp;
  const auto towards = [&](double azimuth) {
    const glm::vec3 wi(float(0.4 * std::cos(azimuth)), float(0.4 * std::sin(azimuth)), 0.916515f);
    return double(d->bsdfEval(b, kUp, kUp, wo, wi).x);
  };
  b.tangent = {1.0f, 0.0f};
  const double along = towards(0.0), across = towards(kPi / 2.0);
  EXPECT_GT(along, 10.0 * across);
  b.tangent = {0.0f, 1.0f};  // by a quarter
  EXPECT_NEAR(towards(kPi / 2.0), along, 1e-4 * along);
  EXPECT_NEAR(towards(0.0), across, 1e-3 * across + 1e-7);
}

}  // namespace
}  // namespace restlab::unit
