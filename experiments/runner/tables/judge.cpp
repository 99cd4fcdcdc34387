#include "experiments/runner/tables/judge.h"

#include <fmt/format.h>

#include <cmath>

#include "core/frame/integrator.h"
#include "experiments/report/text.h"
#include "experiments/runner/reference/reference_error.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/truths/truths.h"

namespace restlab {

namespace {

// Returns the relative standard error of the reference's energy; 0 if unknown.
double energyNoise(const Reference& reference) {
  if (!reference.variance) return 0.0;
  double variance = 0.0, energy = 0.0;
  for (size_t p = 0; p < reference.mean.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      variance += reference.variance->pixels[p][c];
      energy += reference.mean.pixels[p][c];
    }
  }
  return energy > 0.0 ? std::sqrt(variance) / energy : 0.0;
}

// Verdict on a bound, by the whole interval: the estimate alone decides nothing.
enum class Verdict { inside, outside, undecided };

Verdict energyVerdict(const Interval& energy) {
  if (energy.lo > kEnergyRatioMax || energy.hi < kEnergyRatioMin) return Verdict::outside;
  const bool isInside = energy.lo >= kEnergyRatioMin && energy.hi <= kEnergyRatioMax;
  return isInside ? Verdict::inside : Verdict::undecided;
}

Verdict biasVerdict(const Interval& share) {
  if (share.lo > kBiasShareMax) return Verdict::outside;
  return share.hi <= kBiasShareMax ? Verdict::inside : Verdict::undecided;
}

std::string energyText(const Interval& energy) {
  if (std::isnan(energy.lo)) return fmt::format("{:.4g} [unknown]", energy.value);
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", energy.value, energy.lo, energy.hi);
}

std::string shareText(const Interval& share) {
  const auto digits = [](double of) { return shortNumber(100.0 * of, 2); };
  if (std::isnan(share.lo)) return fmt::format("{} % [unknown]", digits(share.value));
  return fmt::format("{} % [{}, {}]", digits(share.value), digits(share.lo), digits(share.hi));
}

// Flags signs of an error in a method that is declared unbiased.
void judgeUnbiased(MethodSummary& row) {
  const Interval& energy = row.energyRatio;
  const double noise = 2.0 * energyNoise(row.block->reference);
  const double allowed = kDoubtHalfWidths * std::hypot((energy.hi - energy.lo) / 2.0, noise);
  if (std::abs(energy.value - 1.0) > allowed) {
    const bool isOutside = energyVerdict(energy) == Verdict::outside;
    row.counts = row.counts && !isOutside;
    row.doubt(fmt::format("{}declared unbiased, but its energy ratio {} leaves out 1",
                          isOutside ? "does not count: " : "", energyText(energy)));
  }
  const Interval& share = row.biasShare;
  if (share.value > kDoubtHalfWidths * (share.value - share.lo)) {
    const bool isLarge = biasVerdict(share) == Verdict::outside;
    row.counts = row.counts && !isLarge;
    row.doubt(fmt::format("{}declared unbiased, but its squared bias is {} of its MSE",
                          isLarge ? "does not count: " : "", shareText(share)));
  }
}

// Flags an iterated solution that was ended by its number of iterations.
void flagUnsolved(MethodSummary& row) {
  constexpr double kSolved = 0.01;
  if (row.residuals.empty() || !(row.residuals.back() > kSolved)) return;
  const ParameterMap& parameters = row.method->session.parameters;
  const auto iterations = parameters.find("iterations");
  if (iterations == parameters.end()) return;
  if (int64_t(row.residuals.size()) < std::get<int64_t>(iterations->second)) return;
  row.doubt(
      fmt::format("its solution is not done: the last of {} iterations left {} % of the light",
                  row.residuals.size(), shortNumber(100.0 * row.residuals.back(), 2)));
}

// Checks the bounds of a biased method. A row counts unless its runs show a violation; undecided
// bounds are only flagged.
void judgeBiased(MethodSummary& row) {
  if (const std::string& light = row.result->lightLeftOut; !light.empty()) {
    row.counts = false;
    row.doubt(
        fmt::format("does not count: it leaves out {}; energy ratio {}, squared bias {} of its MSE",
                    light, energyText(row.energyRatio), shareText(row.biasShare)));
    return;
  }
  switch (energyVerdict(row.energyRatio)) {
    case Verdict::outside:
      row.counts = false;
      row.doubt(fmt::format("does not count: energy ratio {} is outside {:g}..{:g}",
                            energyText(row.energyRatio), kEnergyRatioMin, kEnergyRatioMax));
      break;
    case Verdict::undecided:
      row.flags.push_back(
          fmt::format("the runs do not decide whether its energy ratio {} is inside {:g}..{:g}",
                      energyText(row.energyRatio), kEnergyRatioMin, kEnergyRatioMax));
      break;
    case Verdict::inside:
      break;
  }
  if (std::isnan(row.biasShare.value)) {
    row.counts = false;
    row.doubt(
        "does not count: its bias is unknown (needs two runs and a reference in "
        "two halves)");
    return;
  }
  switch (biasVerdict(row.biasShare)) {
    case Verdict::outside:
      row.counts = false;
      row.doubt(fmt::format("does not count: squared bias is {} of its MSE, more than {:.0f} %",
                            shareText(row.biasShare), 100.0 * kBiasShareMax));
      break;
    case Verdict::undecided:
      row.flags.push_back(fmt::format(
          "the runs do not decide whether its squared bias, {} of its MSE, is at most {:.0f} %",
          shareText(row.biasShare), 100.0 * kBiasShareMax));
      break;
    case Verdict::inside:
      break;
  }
}

// Flags numbers that depend on the reference's own noise. The row still counts.
void flagNoise(MethodSummary& row) {
  const auto near = [&](const std::string& what, double mse) {
    row.flags.push_back(fmt::format(
        "{} is {} times the variance of a half of the reference ({} spp): what is left of its "
        "interval with more runs is the reference's noise",
        what, shortNumber(mse / row.noise.varianceOfHalf), row.block->reference.spp));
  };
  if (row.mse.value <= 0.0) {
    row.flags.push_back("its MSE is below the noise of the reference");
  } else if (isNearNoise(row.mse.value, row.noise)) {
    near("its MSE", row.mse.value);
  }
  if (row.convergence) {
    for (const ConvergencePoint& point : row.convergence->points) {
      if (!isNearNoise(point.mse.value, row.noise)) continue;
      const std::string what = fmt::format("its MSE of {} accumulated frames", point.frames);
      if (point.mse.value > 0.0) {
        near(what, point.mse.value);
      } else {
        row.flags.push_back(what + " is below the noise of the reference");
      }
      break;
    }
  }
  const std::string relmse = relmseFlag(row.block->reference, row.result->measured);
  if (!relmse.empty()) row.flags.push_back(relmse);
}

}  // namespace

bool isExactEnough(const MethodSummary& row) {
  const double error = exactError(row.block->reference);
  return error > 0.0 && row.mse.value <= error * error &&
         std::abs(row.energyRatio.value - 1.0) <= analytic::kExactError;
}

void judge(MethodSummary& row) {
  if (row.nonfinite > 0) {
    row.counts = false;
    row.doubt(fmt::format("{} non-finite values", row.nonfinite));
  }
  if (row.worstShare > kWorstShareMax) {
    row.flags.push_back(
        fmt::format("{:.0f} % of its MSE is in the worst 0.1 % of the pixels: its "
                    "interval says little",
                    100.0 * row.worstShare));
  }
  flagNoise(row);
  flagUnsolved(row);
  if (isExactEnough(row)) return;
  if (row.bias == BiasClass::unbiased) {
    judgeUnbiased(row);
  } else {
    judgeBiased(row);
  }
}

}  // namespace restlab
