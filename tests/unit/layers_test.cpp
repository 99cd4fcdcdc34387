// Layers of glTF's extensions: laws of a BSDF, and known values. tests/unit/bsdf_sampling_test.cpp
// draws from all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/layer_cases.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

const glm::vec3 kAll(1.0f);

// Albedo for a direction: the mean weight of draws, stratified in both dimensions. Refracted light
// counts as flux.
glm::dvec3 albedoOf(const LayerCase& c, const glm::vec3& wo, int side = 300) {
  Dialect<> d(c.scene);
  Inputs inputs(5);
  glm::dvec3 sum(0.0);
  const bool isThin = (c.bsdf.lobes & rl::RL_LOBE_THIN) != 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::vec2 u((float(x) + inputs.uniform()) / float(side),
                        (float(y) + inputs.uniform()) / float(side));
      const rl::BsdfSample s = d->bsdfSample(c.bsdf, kUp, kUp, wo, inputs.uniform(), u);
      if (s.lobe == 0u) continue;
      glm::dvec3 scale(1.0);
      if (s.wi.z < 0.0f && (s.lobe & rl::RL_LOBE_ANY_TRANSMISSION) != 0 && !isThin) {
        for (uint32_t i = 0; i < 3; ++i) {
          const double eta = (c.bsdf.lobes & rl::RL_LOBE_DISPERSION) != 0
                                 ? d->dispersionChannel(c.bsdf, i).eta
                                 : c.bsdf.eta;
          scale[int(i)] = eta * eta;
        }
      }
      sum += glm::dvec3(s.weight) * scale;
    }
  }
  return sum / double(side * side);
}

LayerCase caseOf(const rl::Material& base, const Layers& layers, bool isFront = true) {
  return layerCase("case", layered(base, layers), isFront);
}

// f(wo, wi) = f(wi, wo), also through the surface: seen from the other side, refracted radiance has
// the other scale.
TEST(Layers, Reciprocity) {
  for (const LayerCase& c : continuousLayers()) {
    Dialect<> d(c.scene);
    Inputs inputs(11);
    const rl::Hit hit{0, 0, {0.25f, 0.25f}, 1.0f};
    const bool isFront = c.bsdf.eta >= 1.0f;
    const rl::Bsdf beyond = d->surfaceLoad(hit, {0.0f, 0.0f, isFront ? 1.0f : -1.0f}).bsdf;
    const bool isThin =
        (c.bsdf.lobes & rl::RL_LOBE_THIN) != 0 || (c.bsdf.lobes & rl::RL_LOBE_TRANSMISSION) == 0;
    const bool isRefracted = !isThin && (c.bsdf.lobes & rl::RL_LOBE_DIFFUSE_TRANSMISSION) == 0;
    // A frame about -z: x stays.
    const auto flip = [](const glm::vec3& v) { return glm::vec3(v.x, -v.y, -v.z); };
    double largest = 0.0, largestThrough = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp);
      glm::vec3 wi = inputs.directionAbove(kUp);
      if (i % 2 == 0) wi = glm::normalize(glm::vec3(-wo.x, -wo.y, wo.z) + 0.2f * c.bsdf.alpha * wi);
      if (wo.z < 0.05f || wi.z < 0.05f) continue;
      const glm::dvec3 there(d->bsdfEval(c.bsdf, kUp, kUp, wo, wi));
      const glm::dvec3 back(d->bsdfEval(c.bsdf, kUp, kUp, wi, wo));
      for (int k = 0; k < 3; ++k) {
        const double a = there[k] / wi.z, b = back[k] / wo.z;
        ASSERT_GE(a, 0.0) << c.name;
        if (std::max(a, b) > 1e-6) largest = std::max(largest, std::abs(a - b) / std::max(a, b));
      }
      if (!isThin && !isRefracted) continue;  // a sum of parts with different scales
      if ((c.bsdf.lobes & rl::RL_LOBE_ANISOTROPIC) != 0) continue;  // its frame is another there
      const glm::vec3 below(wi.x, wi.y, -wi.z);
      const glm::dvec3 in(d->bsdfEval(c.bsdf, kUp, kUp, wo, below));
      const glm::dvec3 out(d->bsdfEval(beyond, kUp, kUp, flip(below), flip(wo)));
      for (uint32_t k = 0; k < 3; ++k) {
        const double eta = isThin ? 1.0
                           : (c.bsdf.lobes & rl::RL_LOBE_DISPERSION) != 0
                               ? double(d->dispersionChannel(c.bsdf, k).eta)
                               : double(c.bsdf.eta);
        const double a = in[int(k)] / wi.z * eta * eta, b = out[int(k)] / wo.z;
        if (std::max(a, b) > 1e-4)
          largestThrough = std::max(largestThrough, std::abs(a - b) / std::max(a, b));
      }
    }
    EXPECT_LT(largest, 5e-3) << c.name;
    EXPECT_LT(largestThrough, 2e-2) << c.name << ", through the surface";
  }
}

// All light leaves again: white below a smooth coat, diffuse transmission, a coat over a mirror,
// clear glass with any of it.
TEST(Layers, NothingIsLostBelowThem) {
  const rl::Material white = builtin::lambert(kAll), mirror = builtin::metal(kAll, 0.0f);
  const rl::Material smooth = builtin::glass(0.0f, glm::vec3(0.0f));
  const std::vector<std::pair<std::string, LayerCase>> cases = {
      {"coat over white", caseOf(white, {.coat = 1.0f})},
      {"coat over white plastic", caseOf(builtin::plastic(kAll, 0.0f), {.coat = 0.6f})},
      {"coat over a mirror", caseOf(mirror, {.coat = 1.0f})},
      {"coat over glass", caseOf(smooth, {.coat = 1.0f})},
      {"diffuse transmission", caseOf(white, {.passing = 0.7f})},
      {"film over glass", caseOf(smooth, {.film = 1.0f})},
      {"film over glass, inside", caseOf(smooth, {.film = 1.0f}, false)},
      {"dispersion", caseOf(smooth, {.dispersion = 5.0f})},
      {"dispersion, inside", caseOf(smooth, {.dispersion = 5.0f}, false)},
  };
  for (const auto& [name, c] : cases) {
    // At 42 degrees, from inside, blue light is reflected as a whole and red light refracts.
    for (const double angle : {0.0, 30.0, 42.0, 60.0, 80.0}) {
      const glm::dvec3 albedo = albedoOf(c, directionAt(angle));
      // The film's transmission keeps, of all colours, what is left by the brightest channel.
      const double least = name.find("film") == 0 ? std::max({albedo.x, albedo.y, albedo.z})
                                                  : std::min({albedo.x, albedo.y, albedo.z});
      EXPECT_NEAR(least, 1.0, 0.012) << name << " at " << angle;
      EXPECT_LT(std::max({albedo.x, albedo.y, albedo.z}), 1.012) << name << " at " << angle;
    }
  }
}

// No layer makes energy over white, at any angle.
TEST(Layers, MakeNoEnergy) {
  for (const LayerCase& c : continuousLayers()) {
    if (c.name.find("beside") != std::string::npos) continue;
    for (const double angle : {0.0, 45.0, 75.0, 87.0}) {
      const glm::dvec3 albedo = albedoOf(c, directionAt(angle), 200);
      EXPECT_LT(std::max({albedo.x, albedo.y, albedo.z}), 1.0 + 6e-3) << c.name << " at " << angle;
    }
  }
}

// A coat over black reflects 4 % of its factor at normal incidence, all at grazing incidence.
TEST(Layers, CoatOverBlack) {
  const rl::Material black = builtin::lambert(glm::vec3(0.0f));
  for (const float factor : {0.25f, 1.0f}) {
    EXPECT_NEAR(albedoOf(caseOf(black, {.coat = factor}), kUp).y, 0.04 * factor, 1e-5);
    EXPECT_NEAR(albedoOf(caseOf(black, {.coat = factor, .coatRoughness = 0.3f}), kUp).y,
                0.04 * factor, 4e-4);
  }
  EXPECT_GT(albedoOf(caseOf(black, {.coat = 1.0f}), directionAt(89.5)).y, 0.94);
  Dialect<> d;
  const rl::Bsdf coat = caseOf(black, {.coat = 1.0f, .coatRoughness = 0.2f}).bsdf;
  EXPECT_NEAR(coat.alpha, 0.04f, 1e-6f) << "the narrowest lobe, for what may be reused";
  EXPECT_FALSE(d->bsdfIsReusable(coat, 0.05f));
  EXPECT_TRUE(d->bsdfIsReusable(coat, 0.03f));
}

// A coat with a normal of its own mirrors at that normal.
TEST(Layers, CoatHasItsOwnNormal) {
  LayerCase c = caseOf(builtin::lambert(glm::vec3(0.0f)), {.coat = 1.0f});
  Dialect<> d(c.scene);
  c.bsdf.p0.z = 0.3f;
  const glm::vec3 n(0.3f, 0.0f, std::sqrt(1.0f - 0.09f));
  const rl::BsdfSample s = d->bsdfSample(c.bsdf, kUp, kUp, kUp, 0.5f, {0.3f, 0.4f});
  ASSERT_EQ(s.lobe, rl::RL_LOBE_SPECULAR_DELTA);
  EXPECT_LT(glm::distance(s.wi, 2.0f * n.z * n - kUp), 1e-5f);
}

// Albedo of a white sheen by quadrature in double precision, of its definition alone: D and V of
// glTF's text.
double sheenReference(double cosO, double alpha) {
  const auto fit = [&](double x) {
    const double s = (1.0 - alpha) * (1.0 - alpha);
    const auto mix = [s](double rough, double smooth) { return rough + (smooth - rough) * s; };
    return mix(21.5473, 25.3245) /
               (1.0 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
           mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
  };
  const auto lambda = [&](double x) {
    return x < 0.5 ? std::exp(fit(x)) : std::exp(2.0 * fit(0.5) - fit(1.0 - x));
  };
  const double sinO = std::sqrt(1.0 - cosO * cosO);
  constexpr int kCos = 4000, kAzimuths = 200;
  double sum = 0.0;
  for (int i = 0; i < kCos; ++i) {
    const double cosI = (i + 0.5) / kCos, sinI = std::sqrt(1.0 - cosI * cosI);
    for (int j = 0; j < kAzimuths; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / kAzimuths;
      const glm::dvec3 h = glm::normalize(
          glm::dvec3(sinO + sinI * std::cos(phi), sinI * std::sin(phi), cosO + cosI));
      const double d = (2.0 + 1.0 / alpha) * std::pow(1.0 - h.z * h.z, 0.5 / alpha) / (2.0 * kPi);
      sum += d / (4.0 * cosO * (1.0 + lambda(cosO) + lambda(cosI)));
    }
  }
  return sum * 2.0 * kPi / (double(kCos) * kAzimuths);
}

TEST(Layers, SheenReflectsItsAlbedo) {
  const rl::Material black = builtin::lambert(glm::vec3(0.0f));
  for (const float roughness : {0.3f, 0.55f, 0.97f}) {
    const LayerCase c = caseOf(black, {.sheen = {1.0f, 0.5f, 0.0f}, .sheenRoughness = roughness});
    Dialect<> d(c.scene);
    for (const double angle : {10.0, 50.0, 80.0}) {
      const glm::vec3 wo = directionAt(angle);
      const double expected = sheenReference(wo.z, double(roughness) * roughness);
      EXPECT_NEAR(d->sheenAlbedo(wo.z, roughness * roughness), expected, 3e-3) << angle;
      const glm::dvec3 albedo = albedoOf(c, wo);
      EXPECT_NEAR(albedo.x, expected, 4e-3) << roughness << " at " << angle;
      EXPECT_NEAR(albedo.y, 0.5 * expected, 4e-3) << roughness << " at " << angle;
      EXPECT_EQ(albedo.z, 0.0);
    }
  }
}

// Layers whose values make no difference leave the bits as they are.
TEST(Layers, NoneIsNone) {
  const rl::Material gold = builtin::metal({0.9f, 0.7f, 0.3f}, 0.5f);
  const rl::Material rod = builtin::glass(0.4f, glm::vec3(0.0f));
  const std::vector<std::pair<rl::Material, uint32_t>> cases = {
      {gold, rl::RL_MATERIAL_LAYERS & ~rl::RL_MATERIAL_DIFFUSE_TRANSMISSION},
      {rod, rl::RL_MATERIAL_LAYERS},
      {builtin::plastic(glm::vec3(0.5f), 0.3f), rl::RL_MATERIAL_LAYERS}};
  for (const auto& [base, flags] : cases) {
    SceneMaterial without{"without", base};
    SceneMaterial with = layered(base, {.thickness = 0.0f});
    with.data.flags |= flags;  // all factors are 0
    const LayerCase a = layerCase("without", without), b = layerCase("with", with);
    EXPECT_EQ(a.bsdf.lobes, b.bsdf.lobes);
    Dialect<> d(b.scene);
    Inputs inputs(3);
    for (int i = 0; i < 2000; ++i) {
      const glm::vec3 wo = inputs.directionAbove(kUp), wi = inputs.direction();
      float pdfA, pdfB;
      EXPECT_EQ(d->bsdfEvalAndPdf(a.bsdf, kUp, kUp, wo, wi, pdfA),
                d->bsdfEvalAndPdf(b.bsdf, kUp, kUp, wo, wi, pdfB));
      EXPECT_EQ(pdfA, pdfB);
    }
  }
  // A film of the index of air, or without thickness.
  EXPECT_EQ(caseOf(gold, {.film = 1.0f, .filmIor = 1.0f}).bsdf.lobes & rl::RL_LOBE_FILM, 0u);
  EXPECT_EQ(caseOf(gold, {.film = 1.0f, .thickness = 0.0f}).bsdf.lobes & rl::RL_LOBE_FILM, 0u);
  EXPECT_NE(caseOf(gold, {.film = 1.0f}).bsdf.lobes & rl::RL_LOBE_FILM, 0u);
}

// A film that gets thin turns into the dielectric below it; at any thickness its mean
// over wavelengths is what its two interfaces reflect without interference.
TEST(Layers, FilmsHaveTheirLimits) {
  Dialect<> d;
  const glm::vec3 f0(0.04f, 0.2f, 0.5f);
  for (const float cosI : {1.0f, 0.7f, 0.3f}) {
    const glm::vec3 nearlyAir = d->thinFilmReflectance(f0, 300.0f, 1.00002f, cosI);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(nearlyAir[c], f0[c] + (1.0f - f0[c]) * d->fresnelSchlickWeight(cosI), 5e-3f);
  }
  // At normal incidence, exactly: Airy's sum for a film of half a wave and of a quarter, at the
  // middle of the green sensitivity; it is wide, so only the sign of the difference is sharp.
  const double n = 1.4, base = 1.5;
  const double r12 = std::pow((n - 1.0) / (n + 1.0), 2), r23 = std::pow((base - n) / (base + n), 2);
  const double incoherent = r12 + (1.0 - r12) * (1.0 - r12) * r23 / (1.0 - r12 * r23);
  const glm::vec3 thick = d->thinFilmReflectance(glm::vec3(0.04f), 20'000.0f, 1.4f, 1.0f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(thick[c], incoherent, 1e-4);
  const double wavelength = 555.0;
  const float half = float(wavelength / (2.0 * n)), quarter = float(wavelength / (4.0 * n));
  const glm::vec3 bright = d->thinFilmReflectance(glm::vec3(0.04f), half, 1.4f, 1.0f);
  const glm::vec3 dark = d->thinFilmReflectance(glm::vec3(0.04f), quarter, 1.4f, 1.0f);
  EXPECT_GT(bright.y, incoherent);
  EXPECT_LT(dark.y, incoherent);
  const double least =
      std::pow((std::sqrt(r12) - std::sqrt(r23)) / (1.0 - std::sqrt(r12 * r23)), 2);
  EXPECT_NEAR(dark.y, least, 0.004);
  // A reflectance without colour has none: the fringes of a path of no length are white.
  const glm::vec3 none = d->thinFilmFringes(0.0f, glm::vec3(0.0f));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(none[c], 1.0f, 1e-4f);
}

// Facets are narrow across the direction and wide along it; the rotation turns it.
TEST(Layers, AnisotropyFollowsItsDirection) {
  const rl::Material gold = builtin::metal(kAll, 0.4f);
  const auto towards = [&](float rotation, double azimuth) {
    const LayerCase c = caseOf(gold, {.anisotropy = 1.0f, .rotation = rotation});
    Dialect<> d(c.scene);
    const glm::vec3 wi(float(0.6 * std::cos(azimuth)), float(0.6 * std::sin(azimuth)), 0.8f);
    return double(d->bsdfEval(c.bsdf, kUp, kUp, kUp, wi).x);
  };
  const LayerCase c = caseOf(gold, {.anisotropy = 0.5f});
  EXPECT_NEAR(c.bsdf.p2.y, 0.16f, 1e-6f) << "across: the roughness of the material";
  EXPECT_NEAR(c.bsdf.p2.x, 0.16f + 0.84f * 0.25f, 1e-6f) << "along: mixed with 1 by strength^2";
  const double along = towards(0.0f, 0.0), across = towards(0.0f, kPi / 2.0);
  const bool isAlongX = along > across;
  EXPECT_GT(std::max(along, across), 3.0 * std::min(along, across));
  EXPECT_NEAR(towards(float(kPi / 2.0), isAlongX ? kPi / 2.0 : 0.0), std::max(along, across),
              1e-3 * std::max(along, across));
}

// Reflected and transmitted by Lambert's law, each its part.
TEST(Layers, DiffuseTransmissionDividesTheLight) {
  const LayerCase c = caseOf(builtin::lambert({0.8f, 0.6f, 0.4f}),
                             {.passing = 0.25f, .passingColor = {1.0f, 0.5f, 0.2f}});
  Dialect<> d(c.scene);
  const glm::vec3 wo = directionAt(40.0), wi = directionAt(20.0), below(wi.x, wi.y, -wi.z);
  const glm::vec3 up = d->bsdfEval(c.bsdf, kUp, kUp, wo, wi);
  const glm::vec3 down = d->bsdfEval(c.bsdf, kUp, kUp, wo, below);
  EXPECT_NEAR(up.x, 0.75 * 0.8 * wi.z / kPi, 1e-6);
  EXPECT_NEAR(up.z, 0.75 * 0.4 * wi.z / kPi, 1e-6);
  EXPECT_NEAR(down.x, 0.25 * 1.0 * wi.z / kPi, 1e-6);
  EXPECT_NEAR(down.z, 0.25 * 0.2 * wi.z / kPi, 1e-6);
  EXPECT_TRUE(d->bsdfIsTwoSided(c.bsdf));
  EXPECT_FALSE(d->bsdfIsLambert(c.bsdf));
}

// The indices of the three channels are those of glTF's text, from either side.
TEST(Layers, DispersionSpreadsTheIndices) {
  const rl::Material rod = builtin::glass(0.0f, glm::vec3(0.0f));
  for (const bool isFront : {true, false}) {
    const LayerCase c = caseOf(rod, {.dispersion = 2.0f}, isFront);
    Dialect<> d(c.scene);
    for (const auto& [channel, index] :
         {std::pair(0u, 1.475), std::pair(1u, 1.5), std::pair(2u, 1.525)}) {
      const double expected = isFront ? index : 1.0 / index;
      EXPECT_NEAR(d->dispersionChannel(c.bsdf, channel).eta, expected, 1e-6);
      // A draw refracts by it and carries that channel alone.
      const glm::vec3 wo = directionAt(30.0);
      const rl::BsdfSample s =
          d->bsdfSample(c.bsdf, kUp, kUp, wo, 0.9f, {(float(channel) + 0.5f) / 3.0f, 0.5f});
      ASSERT_EQ(s.lobe, rl::RL_LOBE_TRANSMISSION_DELTA);
      const double sinT = std::sqrt(1.0 - double(s.wi.z) * s.wi.z);
      EXPECT_NEAR(sinT, std::sin(30.0 * kPi / 180.0) / expected, 1e-5);
      for (uint32_t k = 0; k < 3; ++k) EXPECT_EQ(s.weight[int(k)] > 0.0f, k == channel);
    }
  }
}

}  // namespace
}  // namespace restlab::unit
