// Certificates as text and JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/certificate/outputs.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/bias_name.h"

namespace restlab::certificate {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kWorstCells = 3;

// Shows a mean that is too skewed without an interval, and why. If one quantity is skewed, the
// others show their rare events, too.
std::string percents(const ImageBias& b, bool isOneSkewed) {
  const Interval& i = b.bias;
  const auto [own, needed] = apartNumbers(b.events, kRareEventsOfInterval, 2);
  if (!b.isNormal) {
    return fmt::format(
        "{:+.3f} %, too skewed for an interval (noise as of {} rare events, of {} "
        "needed)",
        100.0 * i.value, own, needed);
  }
  return fmt::format("{:+.3f} % [{:+.3f}, {:+.3f}]{}", 100.0 * i.value, 100.0 * i.lo, 100.0 * i.hi,
                     isOneSkewed ? fmt::format(" (as of {}, of {} needed)", own, needed) : "");
}

bool isOneSkewed(const Certificate& c) {
  return std::any_of(c.image.begin(), c.image.end(),
                     [](const ImageBias& b) { return !b.isNormal; });
}

std::string luminanceText(const Certificate& c) { return percents(c.image.front(), false); }

stats::BlockGrid gridOf(const Certified& certified) {
  return stats::BlockGrid(certified.mean.width, certified.mean.height);
}

bool isSame(const stats::CellArea& a, const stats::CellArea& b) {
  return a.x == b.x && a.y == b.y && a.size == b.size;
}

// Returns one verdict per area: of the quantity farthest from the reference, in standard errors.
std::vector<const stats::CellVerdict*> areasOf(const stats::BiasReport& report) {
  std::vector<const stats::CellVerdict*> areas;
  const auto distance = [](const stats::CellVerdict& v) {
    return v.testable ? std::abs(v.welch.t) : 0.0;
  };
  for (const stats::CellVerdict& v : report.cells) {
    if (v.wholeImage || !(v.testable || v.equal)) continue;
    const auto same =
        std::find_if(areas.begin(), areas.end(),
                     [&](const stats::CellVerdict* other) { return isSame(other->area, v.area); });
    if (same == areas.end()) {
      areas.push_back(&v);
    } else if (distance(v) > distance(**same)) {
      *same = &v;
    }
  }
  std::sort(areas.begin(), areas.end(),
            [&](const auto* a, const auto* b) { return distance(*a) > distance(*b); });
  return areas;
}

std::string cellText(const stats::CellVerdict& v, const stats::BlockGrid& grid) {
  std::string text =
      fmt::format("{}, {}: {}, t {:+.2f}, p {:.2g} after Holm", placeOf(v, grid),
                  stats::quantityName(v.quantity), relativeText(v, 2), v.welch.t, v.adjustedP);
  if (v.side != 0) text += v.confirmed ? ", confirmed" : ", not confirmed by fresh runs";
  return text;
}

// Returns whether a test of luminance or a channel of an area meets the condition.
template <class Condition>
bool anyOf(const stats::BiasReport& report, const stats::CellArea& area, Condition condition) {
  return std::any_of(report.cells.begin(), report.cells.end(), [&](const stats::CellVerdict& v) {
    return !v.wholeImage && isSame(v.area, area) && condition(v);
  });
}

std::string cellsText(const Certified& certified) {
  const stats::BiasReport& report = certified.certificate.cells;
  const stats::BlockGrid grid = gridOf(certified);
  // Report cells and shares of one quantity: each quantity divides the image in its own way.
  const stats::Quantity quantity = leastTestable(report, grid);
  const double pixels = double(grid.width) * double(grid.height);
  double largest = 0.0;
  size_t cells = 0, rejected = 0, confirmed = 0;
  for (const stats::CellVerdict& v : report.cells) {
    if (v.quantity != quantity || v.wholeImage || !(v.testable || v.equal)) continue;
    ++cells;
    largest = std::max(largest, double(stats::pixelCount(grid, v.area)) / pixels);
  }
  for (const stats::CellVerdict* cell : areasOf(report)) {
    const stats::CellArea& area = cell->area;
    rejected += anyOf(report, area, [](const stats::CellVerdict& v) { return v.side != 0; });
    confirmed += anyOf(report, area, [](const stats::CellVerdict& v) { return v.confirmed; });
  }
  const bool isSmall = confirmed > 0 && certified.certificate.verdict == Verdict::equivalent;
  const std::string whole =
      report.untestableShare > 0.0 ? testedAsAWhole(certified.certificate, grid) : "";
  const std::string found =
      std::isnan(report.detectableBias)
          ? ""
          : fmt::format("; smallest bias that is found {:.2f} % of a cell (median)",
                        100.0 * report.detectableBias);
  return fmt::format(
      "cells: {} of {}, the largest {:.1f} % of the image, and {:.1f} % of the image in cells that "
      "cannot be tested{}; of all quantities {} rejected, {} of them confirmed by fresh runs{}{}",
      cells, stats::quantityName(quantity), 100.0 * largest, 100.0 * report.untestableShare,
      whole.empty() ? "" : fmt::format(" (the image as a whole can in {})", whole), rejected,
      confirmed, isSmall ? ", each smaller than the margin" : "", found);
}

// Writes NaN, which JSON does not have, as null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json intervalJson(const Interval& i) {
  return {{"value", number(i.value)}, {"lo", number(i.lo)}, {"hi", number(i.hi)}};
}

Json cellJson(const stats::CellVerdict& v) {
  return {{"x", v.area.x},
          {"y", v.area.y},
          {"size", v.area.size},
          {"quantity", stats::quantityName(v.quantity)},
          {"whole_image", v.wholeImage},
          {"mean", number(v.mean)},
          {"reference", number(v.reference)},
          {"t", number(v.welch.t)},
          {"p_value", number(v.welch.pValue)},
          {"p_after_holm", number(v.adjustedP)},
          {"tested", v.testable},
          {"equal", v.equal},
          {"why_not", v.whyNot},
          {"side", v.side},
          {"confirmed", v.confirmed}};
}

double mse(const Certificate& c) { return c.squaredBias.value + c.variance.value; }

// Returns "+1.2 %" of the MSE of a run; "no error" for an exact image.
std::string shareOfBias(const Certificate& c) {
  const double whole = mse(c);
  return whole == 0.0 ? "no error" : fmt::format("{:+.2f} %", 100.0 * c.squaredBias.value / whole);
}

std::string errorText(const Certificate& c) {
  const double whole = mse(c);
  if (whole == 0.0) return "MSE of a run 0: no error at all";
  return fmt::format("MSE of a run {:.4g}: bias^2 {} of it [{:+.2f}, {:+.2f}], variance {:.2f} %",
                     whole, shareOfBias(c), 100.0 * c.squaredBias.lo / whole,
                     100.0 * c.squaredBias.hi / whole, 100.0 * c.variance.value / whole);
}

std::string healthText(const Certified& certified) {
  const Certificate& c = certified.certificate;
  const std::string text = fmt::format("not finite: {} of the images, {} of samples",
                                       counted(c.cells.nonfinite, "value"), c.nonfiniteSamples);
  return certified.isOfImages ? text : fmt::format("{}; health: {}", text, certified.health.text());
}

// Names an option only for rendered runs: for `--images` the user has to supply more images.
std::string moreRunsText(const Certified& certified) {
  constexpr uint64_t kMostRuns = 1'000'000;  // limit of --runs
  const Certificate& c = certified.certificate;
  if (!c.moreRuns) return "";
  if (certified.isOfImages)
    return fmt::format("  by the spread of these, about {} would decide\n",
                       counted(*c.moreRuns, "more image"));
  const uint64_t all = c.runs + *c.moreRuns;
  if (all > kMostRuns) return "  more than a million runs would decide\n";
  return fmt::format("  by the spread of these {}, about {} would decide: --runs {}\n",
                     counted(c.runs, "run"), counted(*c.moreRuns, "more run"), all);
}

}  // namespace

std::vector<std::string> detailsOf(const Certified& certified) {
  std::vector<std::string> details = {errorText(certified.certificate), cellsText(certified)};
  const auto areas = areasOf(certified.certificate.cells);
  for (size_t i = 0; i < std::min(areas.size(), kWorstCells); ++i)
    details.push_back(cellText(*areas[i], gridOf(certified)));
  details.push_back(healthText(certified));
  return details;
}

std::string lineOf(const Certified& certified) {
  const Certificate& c = certified.certificate;
  return fmt::format("{:<12} {}: luminance {}{}", verdictName(c.verdict), certified.name,
                     luminanceText(c), c.verdict == Verdict::notDecided ? "; " + c.reason : "");
}

std::string textOf(const Certified& certified) {
  const Certificate& c = certified.certificate;
  std::string text = fmt::format("{}: {}: {}\n", certified.name, verdictName(c.verdict), c.reason);
  text += fmt::format("  {}\n", certified.how);
  for (const ImageBias& b : c.image) {
    text += fmt::format("  {:<10} bias {}, smallest that is found {:.3f} %\n",
                        stats::quantityName(b.quantity), percents(b, isOneSkewed(c)),
                        100.0 * b.detectable);
  }
  text += fmt::format("  {}\n", errorText(c));
  text += fmt::format("  {}\n", cellsText(certified));
  const auto areas = areasOf(c.cells);
  for (size_t i = 0; i < std::min(areas.size(), kWorstCells); ++i)
    text += fmt::format("    {}\n", cellText(*areas[i], gridOf(certified)));
  text += moreRunsText(certified);
  for (const std::string& note : certified.notes) text += fmt::format("  {}\n", note);
  text += fmt::format("  {}\n", healthText(certified));
  if (!certified.replay.empty()) text += fmt::format("  a pixel of run 0: {}\n", certified.replay);
  return text;
}

Json jsonOf(const Certified& certified) {
  const Certificate& c = certified.certificate;
  Json image = Json::array(), cells = Json::array();
  for (const ImageBias& b : c.image) {
    image.push_back({{"quantity", stats::quantityName(b.quantity)},
                     {"mean", number(b.mean)},
                     {"reference", number(b.reference)},
                     {"relative_bias", intervalJson(b.bias)},
                     {"interval_holds", b.isNormal},
                     {"detectable", number(b.detectable)},
                     {"rare_events", number(b.events)},
                     {"equivalent", b.isEquivalent}});
  }
  for (const stats::CellVerdict& v : c.cells.cells) cells.push_back(cellJson(v));
  Json health = Json::object();
  for (size_t i = 0; i < certified.health.health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (name != nullptr && *name != '\0') health[name] = certified.health.health.counts[i];
  }
  return {{"name", certified.name},
          {"label", certified.label},
          {"scene", certified.scene},
          {"method", certified.method},
          {"denoiser", certified.denoiser},
          {"declared", certified.declared ? Json(biasName(*certified.declared)) : Json(nullptr)},
          {"verdict", verdictName(c.verdict)},
          {"reason", c.reason},
          {"how", certified.how},
          {"runs", c.runs},
          {"image", image},
          {"squared_bias", intervalJson(c.squaredBias)},
          {"variance", intervalJson(c.variance)},
          {"untestable_share", c.cells.untestableShare},
          {"rejected", c.cells.rejected},
          {"confirmed", c.cells.confirmed},
          {"detectable_cell", number(c.cells.detectableBias)},
          {"fewest_rare_events", number(c.fewestEvents)},
          {"reference_error", certified.referenceError},
          {"nonfinite", c.cells.nonfinite},
          {"nonfinite_samples", c.nonfiniteSamples},
          {"health", health},
          {"more_runs", c.moreRuns ? Json(*c.moreRuns) : Json(nullptr)},
          {"notes", certified.notes},
          {"replay", certified.replay},
          {"cells", cells}};
}

std::string markdownOf(const std::vector<Certified>& all) {
  std::string text =
      "| method | verdict | bias of luminance | bias^2 of the MSE | in untestable cells | runs |\n"
      "|---|---|---|---|---|---|\n";
  for (const Certified& certified : all) {
    const Certificate& c = certified.certificate;
    text += fmt::format("| {} | {} | {} | {} | {:.1f} % | {} |\n", certified.name,
                        verdictName(c.verdict), luminanceText(c), shareOfBias(c),
                        100.0 * c.cells.untestableShare, c.runs);
  }
  return text;
}

}  // namespace restlab::certificate
