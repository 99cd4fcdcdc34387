// bsdfSample against bsdfPdf and bsdfEval: distribution, weights, energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "tests/unit/bsdf_cases.h"
#include "tests/unit/closure_cases.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/layer_cases.h"
#include "tests/unit/random_inputs.h"
#include "experiments/statistics/sphere_grid.h"

namespace restlab::unit {
namespace {

constexpr uint64_t kSamples = 500'000;

// Tolerance of energy. The base under a layer is scaled by the Fresnel term of a smooth layer,
// which a rough layer of ior 1.5 exceeds by up to 0.0018 around 50 degrees (for a perfectly white
// base; the loss at other angles is larger).
constexpr double kEnergyTolerance = 2e-3;

struct Setting {
  std::string name;
  rl::Bsdf bsdf;
  glm::vec3 wo, nGeo, nShade;
  bool multiscatter = false;
  uint64_t samples = kSamples;
  bool breaksEnergy = false;
  std::shared_ptr<const CompiledScene> scene{};  // of a closure
};

// Makes a grid whose cells resolve the lobes of the BSDF (all normals are near +z).
stats::SphereGrid gridFor(const Setting& s) {
  const glm::dvec3 n(s.nShade), wo(s.wo);
  const double cosO = glm::dot(n, wo), alpha = s.bsdf.alpha;
  std::vector<stats::SphereGrid::Peak> peaks;
  if (alpha < 0.6 && (s.bsdf.lobes & (rl::RL_LOBE_SPECULAR | rl::RL_LOBE_COAT)) != 0) {
    peaks.push_back({2.0 * cosO * n - wo, 2.0 * alpha});
  }
  if (alpha < 0.6 && (s.bsdf.lobes & rl::RL_LOBE_TRANSMISSION) != 0) {
    const double eta = (s.bsdf.lobes & rl::RL_LOBE_THIN) != 0 ? 1.0 : double(s.bsdf.eta);
    const double sin2 = (1.0 - cosO * cosO) / (eta * eta);
    const double cosT = sin2 < 1.0 ? std::sqrt(1.0 - sin2) : 0.0;
    peaks.push_back({glm::normalize(-wo / eta + n * (cosO / eta - cosT)), alpha});
  }
  return stats::SphereGrid(peaks);
}

struct Estimate {
  glm::dvec3 mean{0.0}, error{0.0};
};

// Draws, checks each draw, and returns the mean weight of the continuous lobes.
Estimate drawAll(Dialect<>& d, const Setting& s, const stats::SphereGrid& grid,
                 std::vector<uint64_t>& counts, uint64_t seed) {
  Inputs inputs(seed);
  glm::dvec3 sum(0.0), squares(0.0);
  uint64_t wrong = 0;
  for (uint64_t i = 0; i < s.samples; ++i) {
    const float uLobe = inputs.uniform();
    const rl::BsdfSample draw =
        d->bsdfSample(s.bsdf, s.nGeo, s.nShade, s.wo, uLobe, inputs.square());
    if (draw.lobe == 0u) continue;
    const glm::dvec3 w(draw.weight);
    const bool sane = std::isfinite(w.x + w.y + w.z) && std::min({w.x, w.y, w.z}) >= 0.0 &&
                      std::abs(glm::dot(draw.wi, draw.wi) - 1.0f) < 1e-5f;
    if (!sane) ++wrong;
    if ((draw.lobe & rl::RL_LOBE_ANY_DELTA) != 0) continue;
    sum += w;
    squares += w * w;
    if (const auto cell = grid.find(glm::dvec3(draw.wi))) ++counts[*cell];
    // Every thousandth draw: the weight must agree with eval and pdf for this direction.
    if (i % 1000 != 0) continue;
    const float pdf = d->bsdfPdf(s.bsdf, s.nGeo, s.nShade, s.wo, draw.wi);
    const glm::vec3 f = d->bsdfEval(s.bsdf, s.nGeo, s.nShade, s.wo, draw.wi);
    const double scale = std::max({w.x, w.y, w.z, 1e-6});
    if (!(std::abs(pdf / draw.pdfSolidAngle - 1.0f) < (s.bsdf.alpha < 0.01f ? 3e-2f : 1e-2f)))
      ++wrong;
    if (!(glm::length(glm::dvec3(f) / double(pdf) - w) < 1e-3 * scale)) ++wrong;
  }
  EXPECT_EQ(wrong, 0u) << s.name << ": draws with an insane weight or one that is not eval / pdf";
  Estimate e;
  const double n = double(s.samples);
  e.mean = sum / n;
  e.error = glm::sqrt(glm::max(squares / n - e.mean * e.mean, glm::dvec3(0.0)) / n);
  return e;
}

// Factor from radiance to flux. Refraction into a denser medium concentrates radiance by eta^2
// without a gain of energy: takes out the adjoint's 1 / eta^2.
double fluxScale(const rl::Bsdf& b) {
  return (b.lobes & rl::RL_LOBE_THIN) != 0 ? 1.0 : double(b.eta) * b.eta;
}

// The density of draws is bsdfPdf, its deficit from 1 is absorbed; the mean weight is the albedo.
void checkSetting(const Setting& s, uint64_t seed) {
  Dialect<> d = s.scene ? Dialect<>(s.scene) : Dialect<>();
  if (s.multiscatter) d.compensate();
  const stats::SphereGrid grid = gridFor(s);
  const stats::SphereGrid::Function pdfAndEval = [&](const glm::dvec3& wi) {
    const glm::vec3 direction(wi);
    return glm::dvec4(d->bsdfPdf(s.bsdf, s.nGeo, s.nShade, s.wo, direction),
                      glm::dvec3(d->bsdfEval(s.bsdf, s.nGeo, s.nShade, s.wo, direction)));
  };
  std::vector<glm::dvec4> cells = grid.integrate(pdfAndEval);
  std::vector<uint64_t> counts(grid.size());
  const Estimate mean = drawAll(d, s, grid, counts, seed);
  std::vector<double> probabilities;
  glm::dvec3 albedo(0.0), flux(0.0);
  uint64_t hits = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].x == 0.0 && counts[i] > 0) cells[i] = grid.integrateCell(i, pdfAndEval, 6);
    const glm::dvec3 f(cells[i].y, cells[i].z, cells[i].w);
    probabilities.push_back(cells[i].x);
    albedo += f;
    flux += f * (grid.isBelow(i) ? fluxScale(s.bsdf) : 1.0);
    hits += counts[i];
  }
  if (hits > 0) expectFits(counts, probabilities, s.samples, s.name);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.mean[c], albedo[c], 4.5 * mean.error[c] + 2e-4) << s.name << ", channel " << c;
    if (!s.breaksEnergy) {
      EXPECT_LE(flux[c], 1.0 + kEnergyTolerance) << s.name << " makes energy";
    }
  }
}

void checkCases(const std::vector<BsdfCase>& cases, uint64_t seed) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  for (const BsdfCase& c : cases) {
    for (const double angle : kAngles) {
      const std::string name = c.name + " at " + std::to_string(angle).substr(0, 4) + " degrees";
      checkSetting({name, c.bsdf, directionAt(angle), up, up}, ++seed);
    }
  }
}

bool isCompensated(const rl::Bsdf& b) {
  return (b.lobes & rl::RL_LOBE_SPECULAR) != 0 && (b.lobes & rl::RL_LOBE_ANY_TRANSMISSION) == 0;
}

TEST(BsdfSampling, MultipleScattering) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f), tilted = glm::normalize(glm::vec3(0.4f, -0.2f, 1.0f));
  uint64_t seed = 3000;
  size_t tested = 0;
  for (const BsdfCase& c : continuousBsdfs()) {
    if (!isCompensated(c.bsdf)) continue;
    ++tested;
    for (const double angle : {30.0, 80.0}) {
      const std::string name = c.name + ", compensated, at " + std::to_string(angle).substr(0, 4);
      checkSetting({name, c.bsdf, directionAt(angle), up, up, true}, ++seed);
    }
    const std::string name = c.name + ", compensated, tilted normal";
    if (c.bsdf.alpha < 0.2f) continue;
    checkSetting({name, c.bsdf, directionAt(60.0), tilted, up, true}, ++seed);
  }
  EXPECT_GE(tested, 10u);
}

TEST(BsdfSampling, ContinuousLobes) { checkCases(continuousBsdfs(), 100); }

// A closure is one by standing in the list: its file needs no test of its own here.
TEST(BsdfSampling, Closures) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f), tilted = glm::normalize(glm::vec3(0.4f, -0.2f, 1.0f));
  uint64_t seed = 4000;
  for (const ClosureCase& c : closureCases()) {
    for (const double angle : {0.0, 60.0, 85.0}) {
      if (c.isCombined && angle != 60.0) continue;
      const std::string name = c.name + " at " + std::to_string(int(angle)) + " degrees";
      checkSetting({.name = name,
                    .bsdf = c.bsdf,
                    .wo = directionAt(angle),
                    .nGeo = up,
                    .nShade = up,
                    .samples = 200'000,
                    .breaksEnergy = c.breaksEnergy,
                    .scene = c.scene},
                   ++seed);
    }
    if (c.bsdf.alpha < 0.2f || c.isCombined) continue;
    checkSetting({.name = c.name + " with a tilted normal",
                  .bsdf = c.bsdf,
                  .wo = directionAt(60.0),
                  .nGeo = tilted,
                  .nShade = up,
                  .samples = 200'000,
                  .breaksEnergy = c.breaksEnergy,
                  .scene = c.scene},
                 ++seed);
  }
}

// Layers of glTF's extensions. Beside refraction, and where each channel has an index of its own,
// the factor from radiance to flux is not one number: their energy is that of parts tested alone.
TEST(BsdfSampling, Layers) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f), tilted = glm::normalize(glm::vec3(0.4f, -0.2f, 1.0f));
  uint64_t seed = 9000;
  std::vector<LayerCase> cases = continuousLayers();
  for (LayerCase& c : deltaLayers()) cases.push_back(std::move(c));
  for (const LayerCase& c : cases) {
    const bool hasManyScales =
        c.name.find("beside") != std::string::npos || (c.bsdf.lobes & rl::RL_LOBE_DISPERSION) != 0;
    for (const double angle : {0.0, 60.0, 85.0, 120.0}) {
      const bool isTilted = angle == 120.0;
      if (isTilted && c.bsdf.alpha < 0.15f) continue;
      const std::string name = c.name + (isTilted ? ", tilted normal, at " : " at ") +
                               std::to_string(int(isTilted ? 60.0 : angle)) + " degrees";
      checkSetting({.name = name,
                    .bsdf = c.bsdf,
                    .wo = directionAt(isTilted ? 60.0 : angle),
                    .nGeo = isTilted ? tilted : up,
                    .nShade = up,
                    .samples = 200'000,
                    .breaksEnergy = hasManyScales,
                    .scene = c.scene},
                   ++seed);
    }
  }
}

// The parameter of a closure that says how rough it is, at a roughness (alpha) of 0 to 1; "" if it
// has none.
std::string roughnessText(const ClosureInfo& info, double alpha) {
  for (const ClosureParameter& p : info.parameters) {
    double value = alpha;
    if (p.name == "power") value = std::clamp(2.0 / (alpha * alpha) - 2.0, p.lo, p.hi);
    if (p.name == "roughness") value = std::sqrt(alpha);
    if (p.name == "sigma") value = alpha * p.hi;
    if (p.name == "alpha" || p.name == "power" || p.name == "roughness" || p.name == "sigma")
      return fmt::format("{} = {:.6f}\n", p.name, value);
  }
  return "";
}

TEST(BsdfSampling, NightlyClosuresAtFiveRoughnesses) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  uint64_t seed = 7000;
  size_t tested = 0;
  for (const ClosureInfo& info : closureRegistry()) {
    for (const double alpha : {0.01, 0.05, 0.2, 0.5, 1.0}) {
      const std::string roughness = roughnessText(info, alpha);
      if (roughness.empty() && alpha > 0.01) continue;
      const ClosureCase c = closureCaseOf(defaultText(info) + roughness);
      for (const double angle : {0.0, 45.0, 80.0}) {
        ++tested;
        checkSetting({.name = fmt::format("{} {} at {} degrees", info.name, roughness, angle),
                      .bsdf = c.bsdf,
                      .wo = directionAt(angle),
                      .nGeo = up,
                      .nShade = up,
                      .samples = 1'000'000,
                      .breaksEnergy = !info.brokenLaws.empty(),
                      .scene = c.scene},
                     ++seed);
      }
    }
  }
  EXPECT_GE(tested, 90u);
}

TEST(BsdfSampling, ContinuousPartBesideDeltaLobes) { checkCases(deltaBsdfs(), 1000); }

// Interpolated normals: a direction on the wrong side of the face is mirrored at the face, or
// absorbed if cosine sampling drew it, and the pdf accounts for both. The last direction sees the
// normal from behind.
TEST(BsdfSampling, ShadingNormalOffTheFace) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  const glm::vec3 slightly = glm::normalize(glm::vec3(0.4f, -0.2f, 1.0f));
  const glm::vec3 steeply = glm::normalize(glm::vec3(1.0f, 0.8f, 0.6f));
  uint64_t seed = 2000;
  for (const BsdfCase& c : continuousBsdfs()) {
    if (c.bsdf.alpha < 0.2f) continue;
    for (const auto& [nGeo, angle] : {std::pair(slightly, 20.0), std::pair(slightly, 60.0),
                                      std::pair(steeply, 75.0), std::pair(steeply, 105.0)}) {
      ASSERT_GT(glm::dot(nGeo, directionAt(angle)), 0.0f);
      const std::string name =
          c.name + ", tilted normal, at " + std::to_string(int(angle)) + " degrees";
      checkSetting({name, c.bsdf, directionAt(angle), nGeo, up}, ++seed);
    }
  }
}

// A lobe returns the same under a shading normal off the face as under the face's own: the albedo
// of white metal and glass depends only on the angle between wo and the normal.
TEST(BsdfSampling, BentNormalsKeepTheAlbedoOfALobe) {
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  Dialect<> d;
  Inputs inputs(31);
  const auto albedoOf = [&](const rl::Bsdf& bsdf, const glm::vec3& nGeo, const glm::vec3& nShade,
                            const glm::vec3& wo) {
    double sum = 0.0;
    int wrong = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
      const float uLobe = inputs.uniform();
      const rl::BsdfSample draw = d->bsdfSample(bsdf, nGeo, nShade, wo, uLobe, inputs.square());
      // Reflected light stays on this side of the face, transmitted light leaves it.
      const bool passes = (draw.lobe & rl::RL_LOBE_ANY_TRANSMISSION) != 0u;
      wrong += draw.lobe != 0u && (glm::dot(draw.wi, nGeo) < 0.0f) != passes;
      sum += draw.weight.x / n;
    }
    EXPECT_EQ(wrong, 0);
    return sum;
  };
  const glm::vec3 white(1.0f);
  for (const rl::Material& material :
       {builtin::metal(white, 0.0f), builtin::metal(white, 0.3f), builtin::metal(white, 0.7f),
        builtin::glass(0.0f, glm::vec3(0.0f)), builtin::glass(0.4f, glm::vec3(0.0f))}) {
    const rl::Bsdf bsdf = bsdfOf(material, true);
    for (int i = 0; i < 20; ++i) {
      const glm::vec3 wo = inputs.directionAbove(up);
      const glm::vec3 nShade = inputs.directionAbove(up);
      if (wo.z < 0.05f || std::abs(glm::dot(nShade, wo)) < 0.05f) continue;
      const glm::vec3 facing = glm::dot(nShade, wo) > 0.0f ? nShade : -nShade;
      EXPECT_NEAR(albedoOf(bsdf, up, nShade, wo), albedoOf(bsdf, facing, facing, wo), 0.01)
          << "roughness " << material.roughness << ", transmission " << material.transmission
          << ", wo " << wo.z << ", normal " << nShade.z << ", between " << glm::dot(nShade, wo);
    }
  }
}

// The kernel without the glossy feature is the same function for Lambert.
TEST(BsdfSampling, LambertKernelAgreesWithTheGeneralOne) {
  Dialect<> general;
  Dialect<rl::RL_FEATURE_AREA_LIGHTS> lean;
  const rl::Bsdf bsdf = continuousBsdfs().front().bsdf;
  ASSERT_EQ(bsdf.lobes, rl::RL_LOBE_DIFFUSE);
  Inputs inputs(7);
  for (int i = 0; i < 100'000; ++i) {
    const glm::vec3 nShade = inputs.direction();
    const glm::vec3 nGeo = glm::normalize(nShade + 0.4f * inputs.direction());
    const glm::vec3 wo = inputs.directionAbove(nGeo), wi = inputs.direction();
    const float uLobe = inputs.uniform();
    const glm::vec2 u = inputs.square();
    const rl::BsdfSample a = general->bsdfSample(bsdf, nGeo, nShade, wo, uLobe, u);
    const rl::BsdfSample b = lean->bsdfSample(bsdf, nGeo, nShade, wo, uLobe, u);
    ASSERT_EQ(a.lobe, b.lobe);
    ASSERT_EQ(a.wi, b.wi);
    ASSERT_LT(glm::distance(a.weight, b.weight), 1e-6f);
    ASSERT_NEAR(a.pdfSolidAngle, b.pdfSolidAngle, 1e-6f);
    ASSERT_NEAR(general->bsdfPdf(bsdf, nGeo, nShade, wo, wi),
                lean->bsdfPdf(bsdf, nGeo, nShade, wo, wi), 1e-6f);
    ASSERT_LT(glm::distance(general->bsdfEval(bsdf, nGeo, nShade, wo, wi),
                            lean->bsdfEval(bsdf, nGeo, nShade, wo, wi)),
              1e-6f);
  }
}

}  // namespace
}  // namespace restlab::unit
