#include "experiments/certificate/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "experiments/report/text.h"
#include "experiments/statistics/power.h"
#include "experiments/statistics/tost.h"

namespace restlab::certificate {
namespace {

// Limit of |skewness| / sqrt(runs) up to which a mean is nearly normal and has a t interval.
constexpr double kMaxSkewness = stats::BiasOptions().maxSkewness;

double normalQuantile(double p) { return quantile(boost::math::normal(), p); }

stats::CellArea wholeImage(const stats::BlockGrid& grid) { return {0, 0, grid.side}; }

// Returns the sum of the normal quantiles of interval and power. An unbiased method may miss the
// margin on either side, so each side gets half of 1 - power.
double deviations(const Rules& rules) {
  return normalQuantile(0.5 + 0.5 * rules.confidence) + normalQuantile(0.5 + 0.5 * rules.power);
}

// Returns the runs after which `distance` is `count` standard errors, those of mean and reference
// together; NaN if the reference's error alone is too large.
double runsFor(double variance, double referenceVariance, double distance, double count) {
  const double allowed = distance * distance / (count * count) - referenceVariance;
  return allowed > 0.0 ? variance / allowed : kNan;
}

double referenceVarianceOf(const stats::Sample& truth) {
  return truth.n > 0.0 ? truth.variance / truth.n : 0.0;
}

ImageBias biasOf(const Evidence& evidence, const stats::Truth& truth, stats::Quantity quantity,
                 const Rules& rules) {
  const stats::CellArea whole = wholeImage(evidence.runs().grid());
  const std::vector<double> means = evidence.runs().cellMeans(whole, quantity);
  const stats::Sample sample = stats::summarise(means), reference = truth.cell(whole, quantity);
  ImageBias b;
  b.quantity = quantity;
  b.mean = sample.mean;
  b.reference = reference.mean;
  const double skewness = stats::skewness(means);
  b.events = rareEvents(skewness, means.size());
  b.isNormal = std::abs(skewness) / std::sqrt(double(means.size())) <= kMaxSkewness;
  const double scale = std::abs(reference.mean);
  if (scale == 0.0 || !std::isfinite(sample.mean)) {
    // Black equals black, and nothing else.
    const bool isBlack = sample.mean == 0.0 && sample.variance == 0.0;
    b.bias = isBlack ? Interval{0.0, 0.0, 0.0} : Interval{kNan, kNan, kNan};
    b.isEquivalent = isBlack;
    b.detectable = isBlack ? 0.0 : kNan;
    return b;
  }
  const stats::TostResult tost =
      stats::tostTest(sample, reference, rules.margin * scale, 0.5 * (1.0 - rules.confidence));
  b.bias = {(sample.mean - reference.mean) / scale, tost.lo / scale, tost.hi / scale};
  b.isEquivalent = b.isNormal && b.bias.lo > -rules.margin && b.bias.hi < rules.margin;
  const stats::WelchResult welch = stats::welchTest(sample, reference);
  b.detectable = welch.standardError > 0.0
                     ? stats::smallestDetectableShift(welch.standardError, welch.dof,
                                                      1.0 - rules.confidence, rules.power) /
                           scale
                     : 0.0;
  return b;
}

// Returns how many runs in total would decide about one quantity. `batches`: size of the evidence
// relative to the batch that tests cells.
double runsToDecide(const Evidence& evidence, const stats::Truth& truth, const ImageBias& b,
                    double batches, const Rules& rules) {
  const stats::CellArea whole = wholeImage(evidence.runs().grid());
  const std::vector<double> means = evidence.runs().cellMeans(whole, b.quantity);
  const stats::Sample sample = stats::summarise(means);
  const double scale = std::abs(b.reference);
  if (scale == 0.0 || !std::isfinite(b.bias.value)) return kNan;
  // If the interval holds 0, plan for a bias of 0: the estimate may be noise.
  const bool mayBeNone = b.bias.lo <= 0.0 && b.bias.hi >= 0.0;
  const double found = mayBeNone ? 0.0 : std::abs(b.bias.value);
  const double variance = sample.variance / (scale * scale);
  const double own = referenceVarianceOf(truth.cell(whole, b.quantity)) / (scale * scale);
  const double level = normalQuantile(1.0 - 0.5 * rules.familyError / double(quantities().size()));
  const double count = level + normalQuantile(rules.power);
  const double decided = found < rules.margin
                             ? runsFor(variance, own, rules.margin - found, deviations(rules))
                             : batches * runsFor(variance, own, found, count);
  // Require enough runs for a nearly normal mean, too.
  const double skewness = stats::skewness(means) / kMaxSkewness;
  return std::max(decided, skewness * skewness);
}

// Returns half the width of the interval of a cell's bias.
double halfInterval(const stats::CellVerdict& v, const Rules& rules) {
  return stats::studentQuantile(0.5 + 0.5 * rules.confidence, v.welch.dof) * v.welch.standardError;
}

// Returns whether the interval of a cell's relative bias lies within the margin: too small to
// count.
bool isWithin(const stats::CellVerdict& v, const Rules& rules) {
  const double scale = std::abs(v.reference);
  if (scale == 0.0 || !std::isfinite(v.welch.dof)) return false;
  return std::abs(v.welch.difference) + halfInterval(v, rules) < rules.margin * scale;
}

// Returns whether the interval lies beyond the margin.
bool isBeyond(const stats::CellVerdict& v, const Rules& rules) {
  const double half = std::isfinite(v.welch.dof) ? halfInterval(v, rules) : 0.0;
  return std::abs(v.welch.difference) - half > rules.margin * std::abs(v.reference);
}

// Returns the confirmed rejection with the largest bias relative to its reference; null if none
// counts.
const stats::CellVerdict* worstConfirmed(const stats::BiasReport& report, const Rules& rules) {
  const stats::CellVerdict* worst = nullptr;
  const auto size = [](const stats::CellVerdict& v) {
    return std::abs(v.welch.difference) / std::max(std::abs(v.reference), 1e-300);
  };
  for (const stats::CellVerdict& v : report.cells) {
    if (!v.confirmed || isWithin(v, rules)) continue;
    if (worst == nullptr || size(v) > size(*worst)) worst = &v;
  }
  return worst;
}

stats::BiasOptions testsOf(const Rules& rules) {
  stats::BiasOptions options;
  options.familyError = rules.familyError;
  options.power = rules.power;
  options.quantities = quantities();
  return options;
}

// Returns whether no number of runs could tell even a bias of 0 from the margin.
bool isReferenceTooCoarse(const stats::Truth& truth, const Rules& rules) {
  return relativeError(truth) >= rules.margin / deviations(rules);
}

void decide(Certificate& c, const Evidence& evidence, double batches, const stats::Truth& truth,
            const Rules& rules) {
  const auto isEquivalent = [](const ImageBias& b) { return b.isEquivalent; };
  if (c.cells.nonfinite > 0) {
    c.verdict = Verdict::biased;
    c.reason = fmt::format("{} of its images or of the reference not finite",
                           counted(c.cells.nonfinite, "value"));
    return;
  }
  if (const stats::CellVerdict* worst = worstConfirmed(c.cells, rules)) {
    c.verdict = Verdict::biased;
    c.worst = *worst;
    const ImageBias& b = c.image.front();
    c.reason = fmt::format(
        "luminance of the image by {:+.2f} % [{:+.2f}, {:+.2f}]; most in {}, {} by {}; fresh runs "
        "say so, too",
        100.0 * b.bias.value, 100.0 * b.bias.lo, 100.0 * b.bias.hi,
        placeOf(*worst, evidence.runs().grid()), stats::quantityName(worst->quantity),
        relativeText(*worst, 2));
    return;
  }
  if (std::all_of(c.image.begin(), c.image.end(), isEquivalent)) {
    const bool anyLight = std::any_of(c.image.begin(), c.image.end(),
                                      [](const ImageBias& b) { return b.reference != 0.0; });
    c.verdict = anyLight ? Verdict::equivalent : Verdict::notDecided;
    c.reason = anyLight ? fmt::format("all intervals of the image's bias lie within +-{:g} %",
                                      100.0 * rules.margin)
                        : "the image is black, which says nothing";
    return;
  }
  c.verdict = Verdict::notDecided;
  double runs = 0.0;
  std::vector<std::string> open;
  bool isSkewed = false;
  for (const ImageBias& b : c.image) {
    if (b.isEquivalent) continue;
    open.push_back(stats::quantityName(b.quantity));
    isSkewed = isSkewed || !b.isNormal;
    const double needed = runsToDecide(evidence, truth, b, batches, rules);
    runs = std::isnan(needed) || std::isnan(runs) ? kNan : std::max(runs, needed);
  }
  const bool isUnconfirmed = c.cells.rejected > c.cells.confirmed;
  c.reason = fmt::format(
      "{} in {}{}",
      isSkewed ? "the mean of the image is too skewed for an interval"
               : fmt::format("the interval is not within +-{:g} %, and {}", 100.0 * rules.margin,
                             isUnconfirmed ? "fresh runs did not confirm what a first batch rejects"
                                           : "no test rejects"),
      fmt::join(open, ", "),
      !std::isnan(runs) ? ""
      : isReferenceTooCoarse(truth, rules)
          ? "; the reference's own error is too large for any number of runs"
          : "; the bias is too near the margin for a reference with this error");
  if (std::isnan(runs)) return;
  // If these runs should have been enough, ask for as many again.
  const double there = double(evidence.count()), more = std::ceil(runs) - there;
  c.moreRuns = uint64_t(std::min(more > 0.0 ? more : there, 1e15));
}

}  // namespace

const char* verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::equivalent:
      return "equivalent";
    case Verdict::biased:
      return "biased";
    case Verdict::notDecided:
      return "not decided";
  }
  return "";
}

const std::vector<stats::Quantity>& quantities() {
  static const std::vector<stats::Quantity> all = {stats::Quantity::luminance, stats::Quantity::red,
                                                   stats::Quantity::green, stats::Quantity::blue};
  return all;
}

double rareEvents(double skewness, size_t runs) {
  return skewness == 0.0 ? std::numeric_limits<double>::infinity()
                         : double(runs) / (skewness * skewness);
}

void Evidence::add(const Image& run) {
  pixels_.add(run);
  runs_.add(run);
  sum_.add(run);
}

stats::Truth truthOf(const Reference& reference, const stats::BlockGrid& grid) {
  using stats::ReferenceCells;
  if (reference.half0)
    return stats::truthOf(ReferenceCells::fromHalves(grid, *reference.half0, *reference.half1));
  if (reference.variance)
    return stats::truthOf(ReferenceCells::fromVariance(grid, reference.mean, *reference.variance));
  return stats::truthOf(ReferenceCells::exact(grid, reference.mean));
}

Certificate judge(const Evidence& evidence, const stats::RunSet& firstBatch,
                  const std::function<stats::RunSet()>& freshBatch, const Reference& reference,
                  const Rules& rules) {
  if (std::min(evidence.count(), firstBatch.runs()) < kFewestRuns)
    throw std::invalid_argument("certificate: too few runs");
  const stats::Truth truth = truthOf(reference, evidence.runs().grid());
  Certificate c;
  c.runs = evidence.count();
  for (const stats::Quantity quantity : quantities())
    c.image.push_back(biasOf(evidence, truth, quantity, rules));
  c.cells = stats::testBias(firstBatch, truth, testsOf(rules), freshBatch);
  c.fewestEvents = std::numeric_limits<double>::infinity();
  for (const stats::CellVerdict& v : c.cells.cells)
    c.fewestEvents = std::min(c.fewestEvents, rareEvents(v.skewness, firstBatch.runs()));
  const bool hasHalves = reference.half0.has_value();
  const Image& half0 = hasHalves ? *reference.half0 : reference.mean;
  const Image& half1 = hasHalves ? *reference.half1 : reference.mean;
  c.squaredBias = evidence.pixels().squaredBias(half0, half1);
  c.variance = evidence.pixels().variance();
  decide(c, evidence, double(evidence.count()) / double(firstBatch.runs()), truth, rules);
  return c;
}

void countNonfiniteSamples(Certificate& c, uint64_t samples) {
  c.nonfiniteSamples = samples;
  if (samples == 0) return;
  const std::string also =
      c.verdict == Verdict::biased ? "; " + c.reason : ", and were set to zero";
  c.verdict = Verdict::biased;
  c.moreRuns.reset();
  c.reason =
      fmt::format("{} of its runs were not finite{}", counted(samples, "sample value"), also);
}

stats::Quantity leastTestable(const stats::BiasReport& report, const stats::BlockGrid& grid) {
  stats::Quantity least = quantities().front();
  uint64_t most = 0;
  for (const stats::Quantity quantity : quantities()) {
    uint64_t pixels = 0;
    for (const stats::CellVerdict& v : report.cells) {
      const bool isOpen = !v.wholeImage && !v.testable && !v.equal;
      if (v.quantity == quantity && isOpen) pixels += stats::pixelCount(grid, v.area);
    }
    if (pixels <= most) continue;
    most = pixels;
    least = quantity;
  }
  return least;
}

std::string testedAsAWhole(const Certificate& certificate, const stats::BlockGrid& grid) {
  std::string names;
  for (const ImageBias& b : certificate.image) {
    const bool isTested =
        std::any_of(certificate.cells.cells.begin(), certificate.cells.cells.end(),
                    [&](const stats::CellVerdict& v) {
                      return v.quantity == b.quantity && v.area.size == grid.side && v.testable;
                    });
    if (isTested) names += (names.empty() ? "" : ", ") + std::string(quantityName(b.quantity));
  }
  return names;
}

std::string placeOf(const stats::CellVerdict& cell, const stats::BlockGrid& grid) {
  if (cell.wholeImage || cell.area.size == grid.side) return "the whole image";
  return fmt::format("the cell of blocks x {} y {} size {}", cell.area.x, cell.area.y,
                     cell.area.size);
}

std::string relativeText(const stats::CellVerdict& cell, int digits) {
  if (cell.reference == 0.0)
    return fmt::format("{:+.3g} where the reference is black", cell.welch.difference);
  return fmt::format("{:+.{}f} %", 100.0 * cell.welch.difference / std::abs(cell.reference),
                     digits);
}

bool rejects(const stats::RunSet& runs, const stats::Truth& truth, const Rules& rules) {
  // Pass the same runs as the fresh batch, which confirms every rejection.
  const stats::BiasReport report =
      stats::testBias(runs, truth, testsOf(rules), [&] { return runs; });
  return std::any_of(report.cells.begin(), report.cells.end(), [&](const stats::CellVerdict& v) {
    return v.confirmed && isBeyond(v, rules);
  });
}

double runsForEquivalence(const Evidence& pilot, const stats::Truth& truth, const Rules& rules) {
  const stats::CellArea whole = wholeImage(pilot.runs().grid());
  double runs = double(kRunsForCells);
  // All quantities have to lie within the margin: each may miss it with its share of the chance.
  Rules each = rules;
  each.power = 1.0 - (1.0 - rules.power) / double(quantities().size());
  for (const stats::Quantity quantity : quantities()) {
    const stats::Sample sample = stats::summarise(pilot.runs().cellMeans(whole, quantity));
    const stats::Sample reference = truth.cell(whole, quantity);
    const double scale = reference.mean * reference.mean;
    if (scale == 0.0) continue;
    const double needed = runsFor(sample.variance / scale, referenceVarianceOf(reference) / scale,
                                  rules.margin, deviations(each));
    runs = std::isnan(needed) || std::isnan(runs) ? kNan : std::max(runs, needed);
  }
  return runs;
}

double relativeError(const stats::Truth& truth) {
  double largest = 0.0;
  for (const stats::Quantity quantity : quantities()) {
    const stats::Sample s = truth.cell(wholeImage(truth.grid), quantity);
    if (s.mean != 0.0)
      largest = std::max(largest, std::sqrt(referenceVarianceOf(s)) / std::abs(s.mean));
  }
  return largest;
}

}  // namespace restlab::certificate
