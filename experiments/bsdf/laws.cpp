#include "experiments/bsdf/laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/bsdf/uniform.h"
#include "experiments/statistics/chi2.h"
#include "experiments/statistics/sphere_grid.h"

namespace restlab {
namespace {

constexpr double kAngles[] = {0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0, 88.0};
constexpr double kSamplingAngles[] = {0.0, 45.0, 80.0};
// A correct sampler fails one of the three tests once in a thousand runs.
constexpr double kLeastP = 1e-3 / 3.0;
constexpr double kMostGain = 2e-3;           // of energy: float32, and the base of a layer
constexpr double kMostAsymmetry = 5e-3;      // relative difference of f: float32
constexpr int kStrata = 256, kBatches = 16;  // draws of an albedo: kStrata^2

glm::dvec3 above(Uniform& uniform) {
  const double z = uniform(), phi = 2.0 * std::numbers::pi * uniform();
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

AlbedoRow albedoAt(const BsdfProbe& bsdf, double degrees) {
  Uniform uniform(1);
  const glm::dvec3 wo = directionAt(degrees);
  glm::dvec3 batches[kBatches] = {};
  for (int y = 0; y < kStrata; ++y) {
    for (int x = 0; x < kStrata; ++x) {
      const glm::dvec2 u((x + uniform()) / kStrata, (y + uniform()) / kStrata);
      batches[x % kBatches] += bsdf.draw(wo, uniform(), u).weight;
    }
  }
  AlbedoRow row;
  row.degrees = degrees;
  constexpr double kEach = double(kStrata) * kStrata / kBatches;
  for (const glm::dvec3& batch : batches) row.albedo += batch / kEach / double(kBatches);
  for (const glm::dvec3& batch : batches) {
    const glm::dvec3 d = batch / kEach - row.albedo;
    row.error += d * d;
  }
  row.error = glm::sqrt(row.error / double(kBatches * (kBatches - 1)));
  return row;
}

LawVerdict energy(const std::vector<AlbedoRow>& rows) {
  LawVerdict v{"energy", true, 0.0, "the largest albedo"};
  for (const AlbedoRow& row : rows) {
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(row.albedo[c])) {
        v.holds = false;
        v.value = row.albedo[c];
        v.meaning = fmt::format("the albedo at {:g} degrees", row.degrees);
        return v;
      }
      if (row.albedo[c] > v.value) {
        v.value = row.albedo[c];
        v.meaning = fmt::format("the largest albedo, at {:g} degrees", row.degrees);
      }
      if (row.albedo[c] - 4.0 * row.error[c] > 1.0 + kMostGain) v.holds = false;
    }
  }
  return v;
}

// Half of the pairs lie inside of a narrow lobe.
void pairOf(Uniform& uniform, double alpha, int i, glm::dvec3& wo, glm::dvec3& wi) {
  wo = above(uniform);
  wi = above(uniform);
  if (i % 2 == 0) wi = glm::normalize(glm::dvec3(-wo.x, -wo.y, wo.z) + 0.3 * alpha * wi);
}

void nonNegativeAndReciprocal(const BsdfProbe& bsdf, std::vector<LawVerdict>& verdicts) {
  LawVerdict sign{"non-negative", true, 0.0, "the least value of f"};
  LawVerdict symmetry{"reciprocity", true, 0.0, "the largest relative difference of f(wi, wo)"};
  Uniform uniform(2);
  for (int i = 0; i < 50'000; ++i) {
    glm::dvec3 wo, wi;
    pairOf(uniform, bsdf.alpha(), i, wo, wi);
    double pdf = 0.0;
    const glm::dvec3 there = bsdf.eval(wo, wi, pdf);
    const glm::dvec3 back = bsdf.eval(wi, wo, pdf);
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(there[c]) || there[c] < sign.value) {
        sign.holds = false;
        sign.value = there[c];
      }
      if (wo.z < 0.02 || wi.z < 0.02) continue;
      const double a = there[c] / wi.z, b = back[c] / wo.z;
      if (std::max(a, b) < 1e-6 || std::abs(a - b) <= symmetry.value * std::max(a, b)) continue;
      symmetry.value = std::abs(a - b) / std::max(a, b);
      symmetry.meaning = fmt::format(
          "the largest relative difference of f(wi, wo), at {:.0f} and {:.0f} degrees",
          std::acos(wo.z) * 180.0 / std::numbers::pi, std::acos(wi.z) * 180.0 / std::numbers::pi);
    }
  }
  symmetry.holds = symmetry.value < kMostAsymmetry;
  verdicts.push_back(sign);
  verdicts.push_back(symmetry);
}

stats::SphereGrid gridFor(const BsdfProbe& bsdf, const glm::dvec3& wo) {
  std::vector<stats::SphereGrid::Peak> peaks;
  if (bsdf.alpha() < 0.6 && bsdf.hasSpecular())
    peaks.push_back({{-wo.x, -wo.y, wo.z}, 2.0 * bsdf.alpha()});
  if (bsdf.alpha() < 0.6 && bsdf.hasTransmission()) peaks.push_back({-wo, bsdf.alpha()});
  return stats::SphereGrid(peaks);
}

LawVerdict sampling(const BsdfProbe& bsdf, uint64_t samples) {
  LawVerdict v{"sampling", true, 1.0, "least p of chi-squared tests; no rough lobe was drawn"};
  for (const double degrees : kSamplingAngles) {
    const glm::dvec3 wo = directionAt(degrees);
    const stats::SphereGrid grid = gridFor(bsdf, wo);
    const stats::SphereGrid::Function density = [&](const glm::dvec3& wi) {
      double pdf = 0.0;
      bsdf.eval(wo, wi, pdf);
      return glm::dvec4(pdf, 0.0, 0.0, 0.0);
    };
    std::vector<glm::dvec4> cells = grid.integrate(density);
    std::vector<uint64_t> counts(grid.size());
    Uniform uniform(3);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < samples; ++i) {
      const double uLobe = uniform(), x = uniform(), y = uniform();
      const BsdfDraw draw = bsdf.draw(wo, uLobe, {x, y});
      if (draw.isNone || draw.isDelta) continue;
      ++hits;
      if (const auto cell = grid.find(draw.wi)) ++counts[*cell];
    }
    if (hits == 0) continue;
    std::vector<double> probabilities;
    for (size_t i = 0; i < cells.size(); ++i) {
      if (!(cells[i].x >= 0.0) || !std::isfinite(cells[i].x))
        return {"sampling", false, cells[i].x, fmt::format("a density, at {:g} degrees", degrees)};
      if (cells[i].x == 0.0 && counts[i] > 0) cells[i] = grid.integrateCell(i, density, 6);
      probabilities.push_back(cells[i].x);
    }
    const stats::Chi2Result result = stats::chi2Test(counts, probabilities, samples);
    if (result.pValue <= v.value) {
      v.value = result.pValue;
      v.meaning = fmt::format("least p of three chi-squared tests, at {:g} degrees", degrees);
    }
    if (result.pValue < kLeastP) v.holds = false;
  }
  return v;
}

}  // namespace

glm::dvec3 directionAt(double degrees) {
  const double theta = degrees * std::numbers::pi / 180.0;
  constexpr double kAzimuth = 0.7;
  return {std::sin(theta) * std::cos(kAzimuth), std::sin(theta) * std::sin(kAzimuth),
          std::cos(theta)};
}

BsdfLaws checkLaws(const BsdfProbe& bsdf, uint64_t samples) {
  BsdfLaws laws;
  laws.samples = samples;
  laws.alpha = bsdf.alpha();
  laws.power = 2.0 / (laws.alpha * laws.alpha) - 2.0;
  for (const double degrees : kAngles) laws.albedo.push_back(albedoAt(bsdf, degrees));
  nonNegativeAndReciprocal(bsdf, laws.verdicts);
  laws.verdicts.insert(laws.verdicts.begin() + 1, energy(laws.albedo));
  laws.verdicts.push_back(sampling(bsdf, samples));
  return laws;
}

}  // namespace restlab
