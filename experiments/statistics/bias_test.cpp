#include "experiments/statistics/bias_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "experiments/statistics/holm.h"
#include "experiments/statistics/intervals.h"
#include "experiments/statistics/power.h"

namespace restlab::stats {
namespace {

constexpr size_t kFewestRuns = 8;

// Rounding: images are floats and references sums of many, so values that are constant in both (a
// light seen directly) still differ by this much, relatively.
constexpr double kRounding = 1e-5;

// In cells darker than this share of the whole image's brightness, rounding is relative to that
// share: where almost no light arrives, a difference relative to the cell itself means nothing.
constexpr double kDarkness = 0.1;

class Comparison {
 public:
  const RunSet& runs;
  const Truth& truth;
  const BiasOptions& options;

  Comparison(const RunSet& runsIn, const Truth& truthIn, const BiasOptions& optionsIn)
      : runs(runsIn), truth(truthIn), options(optionsIn) {
    const CellArea whole{0, 0, runs.grid().side};
    for (const Quantity q : options.quantities) {
      const Sample sample = summarise(runs.cellMeans(whole, q));
      brightness_[size_t(q)] = std::max(std::abs(sample.mean), std::abs(truth.cell(whole, q).mean));
    }
  }

  // Returns the difference that counts as rounding in a cell of these means.
  double rounding(double mean, double reference, Quantity quantity) const {
    return kRounding * std::max({std::abs(mean), std::abs(reference),
                                 kDarkness * brightness_[size_t(quantity)]});
  }

  // Returns whether neither side has noise and both are equal. False for values that are not
  // finite.
  bool equal(const CellArea& area, Quantity quantity) const {
    const Sample sample = summarise(runs.cellMeans(area, quantity));
    const Sample other = truth.cell(area, quantity);
    const WelchResult welch = welchTest(sample, other);
    const double allowed = rounding(sample.mean, other.mean, quantity);
    return welch.standardError <= allowed && std::abs(welch.difference) <= allowed;
  }

  double scaledSkewness(const CellArea& area, Quantity quantity) const {
    const double own = skewness(runs.cellMeans(area, quantity)) / std::sqrt(double(runs.runs()));
    const double other = truth.skewness(area, quantity);
    return std::abs(own) >= std::abs(other) ? own : other;
  }

  bool nearlyNormal(const CellArea& area, Quantity quantity) const {
    return std::abs(scaledSkewness(area, quantity)) <= options.maxSkewness;
  }

  bool judgeable(const CellArea& area, Quantity quantity) const {
    return nearlyNormal(area, quantity) || equal(area, quantity);
  }

 private:
  std::array<double, kQuantities> brightness_{};  // of the whole image
};

// Division of an area into judgeable cells, as small as possible. The four children are kept if all
// of their area is judgeable; else they are merged if the merged cell is judgeable; else they are
// kept, with unjudgeable cells among them.
struct Division {
  std::vector<CellArea> cells;
  bool complete = true;  // every cell is judgeable
};

Division divide(const Comparison& comparison, Quantity quantity, const CellArea& area) {
  if (area.size == 1) return {{area}, comparison.judgeable(area, quantity)};
  Division result;
  const uint32_t half = area.size / 2;
  for (uint32_t i = 0; i < 4; ++i) {
    const CellArea child{area.x + (i & 1u) * half, area.y + (i >> 1u) * half, half};
    Division part = divide(comparison, quantity, child);
    result.cells.insert(result.cells.end(), part.cells.begin(), part.cells.end());
    result.complete = result.complete && part.complete;
  }
  if (!result.complete && comparison.judgeable(area, quantity)) return {{area}, true};
  return result;
}

CellVerdict judge(const Comparison& comparison, const CellArea& area, Quantity quantity) {
  CellVerdict v;
  v.area = area;
  v.quantity = quantity;
  const Sample sample = summarise(comparison.runs.cellMeans(area, quantity));
  const Sample truth = comparison.truth.cell(area, quantity);
  v.skewness =
      comparison.scaledSkewness(area, quantity) * std::sqrt(double(comparison.runs.runs()));
  v.mean = sample.mean;
  v.reference = truth.mean;
  v.welch = welchTest(sample, truth);
  if (std::isnan(v.welch.pValue)) {
    v.whyNot = "values that are not finite";
  } else if (comparison.equal(area, quantity)) {
    v.equal = true;
  } else if (!comparison.nearlyNormal(area, quantity)) {
    v.whyNot = "skewed";
  } else {
    v.testable = true;
  }
  return v;
}

// Applies Holm's correction over the testable members; sets adjustedP and side.
void correct(std::vector<CellVerdict>& verdicts, double familyError) {
  std::vector<double> pValues;
  for (const CellVerdict& v : verdicts) {
    if (v.testable) pValues.push_back(v.welch.pValue);
  }
  const std::vector<double> adjusted = holmAdjusted(pValues);
  size_t next = 0;
  for (CellVerdict& v : verdicts) {
    if (!v.testable) continue;
    v.adjustedP = adjusted[next++];
    v.side = v.adjustedP <= familyError ? (v.welch.difference > 0.0 ? 1 : -1) : 0;
  }
}

// Tests the rejected cells again, on fresh runs and as a family of their own.
void confirm(std::vector<CellVerdict>& verdicts, const Comparison& fresh) {
  std::vector<CellVerdict> again;
  for (const CellVerdict& v : verdicts) {
    if (v.side == 0) continue;
    CellVerdict second = judge(fresh, v.area, v.quantity);
    // Keep the cell testable, as the first batch found: the fresh batch only decides about the
    // mean.
    second.testable = !second.equal && !std::isnan(second.welch.pValue);
    again.push_back(second);
  }
  correct(again, fresh.options.familyError);
  size_t next = 0;
  for (CellVerdict& v : verdicts) {
    if (v.side != 0) v.confirmed = again[next++].side == v.side;
  }
}

void statePower(std::vector<CellVerdict>& verdicts, const BiasOptions& options) {
  const auto family = std::count_if(verdicts.begin(), verdicts.end(),
                                    [](const CellVerdict& v) { return v.testable; });
  for (CellVerdict& v : verdicts) {
    if (!v.testable || v.welch.standardError == 0.0) continue;
    const double shift = smallestDetectableShift(
        v.welch.standardError, v.welch.dof, options.familyError / double(family), options.power);
    v.detectableBias = shift / std::abs(v.reference);
  }
}

// Returns the share of the image's area in cells of a quantity that `counts` accepts.
template <class F>
double share(const std::vector<CellVerdict>& verdicts, const BlockGrid& grid, Quantity quantity,
             F counts) {
  uint64_t pixels = 0;
  for (const CellVerdict& v : verdicts) {
    if (v.quantity == quantity && !v.wholeImage && counts(v)) pixels += pixelCount(grid, v.area);
  }
  return double(pixels) / (double(grid.width) * double(grid.height));
}

}  // namespace

Truth truthOf(ReferenceCells reference) {
  const auto shared = std::make_shared<ReferenceCells>(std::move(reference));
  Truth truth;
  truth.cell = [shared](const CellArea& a, Quantity q) { return shared->cell(a, q); };
  truth.skewness = [](const CellArea&, Quantity) { return 0.0; };
  truth.nonfinite = shared->nonfinite();
  truth.grid = shared->grid();
  return truth;
}

Truth truthOf(RunSet runs) {
  if (runs.runs() < kFewestRuns) throw std::invalid_argument("testBias: too few runs of the truth");
  const auto shared = std::make_shared<RunSet>(std::move(runs));
  Truth truth;
  truth.cell = [shared](const CellArea& a, Quantity q) {
    return summarise(shared->cellMeans(a, q));
  };
  truth.skewness = [shared](const CellArea& a, Quantity q) {
    return skewness(shared->cellMeans(a, q)) / std::sqrt(double(shared->runs()));
  };
  truth.nonfinite = shared->nonfinite();
  truth.grid = shared->grid();
  return truth;
}

BiasReport testBias(const RunSet& runs, const Truth& truth, const BiasOptions& options,
                    const std::function<RunSet()>& secondBatch) {
  const auto sameGrid = [](const BlockGrid& a, const BlockGrid& b) {
    return a.width == b.width && a.height == b.height && a.side == b.side;
  };
  if (!sameGrid(runs.grid(), truth.grid)) throw std::invalid_argument("testBias: different grids");
  if (runs.runs() < kFewestRuns) throw std::invalid_argument("testBias: too few runs");

  const Comparison first{runs, truth, options};
  const CellArea whole{0, 0, runs.grid().side};
  BiasReport report;
  report.runs = runs.runs();
  report.nonfinite = runs.nonfinite() + truth.nonfinite;
  for (const Quantity quantity : options.quantities) {
    const Division division = divide(first, quantity, whole);
    for (const CellArea& area : division.cells) {
      report.cells.push_back(judge(first, area, quantity));
    }
    const auto shareOf = [&](auto counts) {
      return share(report.cells, runs.grid(), quantity, counts);
    };
    report.untestableShare =
        std::max(report.untestableShare,
                 shareOf([](const CellVerdict& v) { return !v.testable && !v.equal; }));
    report.equalShare =
        std::max(report.equalShare, shareOf([](const CellVerdict& v) { return v.equal; }));
    if (options.wholeImage && division.cells.size() > 1) {
      report.cells.push_back(judge(first, whole, quantity));
      report.cells.back().wholeImage = true;
    }
  }
  correct(report.cells, options.familyError);
  statePower(report.cells, options);

  const auto rejected = [](const CellVerdict& v) { return v.side != 0; };
  report.rejected = size_t(std::count_if(report.cells.begin(), report.cells.end(), rejected));
  if (report.rejected > 0) {
    const RunSet second = secondBatch();
    if (!sameGrid(second.grid(), truth.grid) || second.runs() < kFewestRuns) {
      throw std::invalid_argument("testBias: the second batch has another grid or too few runs");
    }
    report.nonfinite += second.nonfinite();
    confirm(report.cells, Comparison{second, truth, options});
    report.confirmed = size_t(std::count_if(report.cells.begin(), report.cells.end(),
                                            [](const CellVerdict& v) { return v.confirmed; }));
  }

  std::vector<double> detectable;
  report.detectableBiasWhole = std::numeric_limits<double>::quiet_NaN();
  for (const CellVerdict& v : report.cells) {
    if (!v.testable) continue;
    if (v.area.size == whole.size && v.quantity == options.quantities.front()) {
      report.detectableBiasWhole = v.detectableBias;
    }
    if (!v.wholeImage) detectable.push_back(v.detectableBias);
  }
  report.detectableBias =
      detectable.empty() ? std::numeric_limits<double>::quiet_NaN() : median(detectable);
  return report;
}

bool BiasReport::failed() const {
  // Equal black cells do not count as tested.
  const bool anyTested = std::any_of(cells.begin(), cells.end(), [](const CellVerdict& v) {
    return v.testable || (v.equal && std::max(std::abs(v.mean), std::abs(v.reference)) > 0.0);
  });
  return confirmed > 0 || nonfinite > 0 || !anyTested;
}

std::string BiasReport::text() const {
  size_t testable = 0;
  for (const CellVerdict& v : cells) testable += v.testable ? 1u : 0u;
  std::string text = fmt::format(
      "bias test: {} runs, {} tests, {} rejected, {} confirmed, untestable area {:.1f} %, equal "
      "without noise {:.1f} %, smallest detectable bias {:.3g} % of a cell (median), {:.3g} % of "
      "the image",
      runs, testable, rejected, confirmed, 100.0 * untestableShare, 100.0 * equalShare,
      100.0 * detectableBias, 100.0 * detectableBiasWhole);
  if (nonfinite > 0) text += fmt::format("\n  {} values are not finite", nonfinite);
  for (const CellVerdict& v : cells) {
    if (v.side == 0) continue;
    text += fmt::format(
        "\n  {} {}: mean {:.6g}, reference {:.6g} ({:+.3g} %), t {:.2f}, p {:.2g} "
        "after Holm, {}, {}",
        v.wholeImage ? std::string("whole image")
                     : fmt::format("blocks x {} y {} size {}", v.area.x, v.area.y, v.area.size),
        quantityName(v.quantity), v.mean, v.reference, 100.0 * v.welch.difference / v.reference,
        v.welch.t, v.adjustedP, v.side > 0 ? "brighter" : "darker",
        v.confirmed ? "confirmed" : "not confirmed by fresh seeds");
  }
  return text;
}

}  // namespace restlab::stats
