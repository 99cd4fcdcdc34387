// Certificates in words and numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/certificate/outputs.h"
#include "experiments/report/text.h"
#include "experiments/runner/summary/summary.h"

namespace restlab::certificate {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kWorstCells = 3;

std::string percents(const Interval& i) {
  return fmt::format("{:+.3f} % [{:+.3f}, {:+.3f}]", 100.0 * i.value, 100.0 * i.lo, 100.0 * i.hi);
}

// Those farthest from the reference in deviations, whether significant or not.
std::vector<const stats::CellVerdict*> worstCells(const stats::BiasReport& report) {
  std::vector<const stats::CellVerdict*> cells;
  for (const stats::CellVerdict& v : report.cells)
    if (v.testable && !v.wholeImage) cells.push_back(&v);
  std::sort(cells.begin(), cells.end(), [](const auto* a, const auto* b) {
    return std::abs(a->welch.t) > std::abs(b->welch.t);
  });
  if (cells.size() > kWorstCells) cells.resize(kWorstCells);
  return cells;
}

std::string cellText(const stats::CellVerdict& v) {
  std::string text = fmt::format("blocks x {} y {} size {}, {}: {}, t {:+.2f}, p {:.2g}", v.area.x,
                                 v.area.y, v.area.size, stats::quantityName(v.quantity),
                                 relativeText(v, 2), v.welch.t, v.adjustedP);
  if (v.side != 0) text += v.confirmed ? ", confirmed" : ", not confirmed by fresh runs";
  return text;
}

// JSON has no NaN.
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

// "+1.2 %" of the MSE of a run; "no error" of an image that is exact.
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

// `--images` has no more runs to ask for.
std::string moreRunsText(const Certified& certified) {
  const Certificate& c = certified.certificate;
  if (!c.moreRuns) return "";
  const std::string more = counted(*c.moreRuns, "more run");
  if (certified.replay.empty()) return fmt::format("  about {} would decide\n", more);
  return fmt::format("  about {} would decide: --runs {}\n", more, c.cells.runs + *c.moreRuns);
}

}  // namespace

std::string lineOf(const Certified& certified) {
  const Certificate& c = certified.certificate;
  return fmt::format("{:<12} {}: luminance {}", verdictName(c.verdict), certified.name,
                     percents(c.image.front().bias));
}

std::string textOf(const Certified& certified) {
  const Certificate& c = certified.certificate;
  std::string text = fmt::format("{}: {}: {}\n", certified.name, verdictName(c.verdict), c.reason);
  text += fmt::format("  {}\n", certified.how);
  for (const ImageBias& b : c.image) {
    text += fmt::format("  {:<10} bias {}, smallest that is found {:.3f} %\n",
                        stats::quantityName(b.quantity), percents(b.bias), 100.0 * b.detectable);
  }
  text += fmt::format("  {}\n", errorText(c));
  const auto tested =
      std::count_if(c.cells.cells.begin(), c.cells.cells.end(),
                    [](const stats::CellVerdict& v) { return v.testable || v.equal; });
  text += fmt::format(
      "  cells: {} tests, {} rejected, {} confirmed; untestable area {:.1f} %; smallest bias that "
      "is found {:.2f} % of a cell (median)\n",
      tested, c.cells.rejected, c.cells.confirmed, 100.0 * c.cells.untestableShare,
      100.0 * c.cells.detectableBias);
  for (const stats::CellVerdict* v : worstCells(c.cells))
    text += fmt::format("    {}\n", cellText(*v));
  text += moreRunsText(certified);
  for (const std::string& note : certified.notes) text += fmt::format("  {}\n", note);
  text += fmt::format("  not finite: {} of the images, {} of samples",
                      counted(c.cells.nonfinite, "value"), c.nonfiniteSamples);
  const std::string health = certified.replay.empty() ? "" : certified.health.text();
  text += health.empty() ? "\n" : fmt::format("; health: {}\n", health);
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
          {"runs", c.cells.runs},
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
      "| method | verdict | bias of luminance | bias^2 of the MSE | untestable | runs |\n"
      "|---|---|---|---|---|---|\n";
  for (const Certified& certified : all) {
    const Certificate& c = certified.certificate;
    text += fmt::format("| {} | {} | {} | {} | {:.1f} % | {} |\n", certified.name,
                        verdictName(c.verdict), percents(c.image.front().bias), shareOfBias(c),
                        100.0 * c.cells.untestableShare, c.cells.runs);
  }
  return text;
}

}  // namespace restlab::certificate
