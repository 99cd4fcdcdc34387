// table.md: the lecture's table of each scene and component, with what its reader must know.
#include <fmt/format.h>

#include <cmath>

#include "experiments/runner/report.h"

namespace restlab {

namespace {

std::string interval(double lo, double hi, const char* format) {
  if (std::isnan(lo) || std::isnan(hi)) return "";
  if (std::isinf(lo) || std::isinf(hi)) return " [unbounded]";
  return fmt::format(" [{}, {}]", fmt::format(fmt::runtime(format), lo),
                     fmt::format(fmt::runtime(format), hi));
}

std::string timeCell(const MethodSummary& row, bool yardstick) {
  std::string text = fmt::format("{:.3g} ms", row.timeMsMedian);
  if (yardstick || std::isnan(row.timeRatio.value)) return text;
  return text + fmt::format(" ({:.2f}x{})", row.timeRatio.value,
                            interval(row.timeRatio.lo, row.timeRatio.hi, "{:.2f}"));
}

std::string ratioCell(const Interval& ratio, bool yardstick) {
  if (yardstick || std::isnan(ratio.value)) return "";
  return fmt::format("{:.1f}x lower{}", ratio.value, interval(ratio.lo, ratio.hi, "{:.1f}"));
}

std::string efficiencyCell(const MethodSummary& row, bool yardstick) {
  if (yardstick || std::isnan(row.efficiencyRatio.value)) return "";
  return fmt::format("{:.1f}{}", row.efficiencyRatio.value,
                     interval(row.efficiencyRatio.lo, row.efficiencyRatio.hi, "{:.1f}"));
}

std::string withoutLightsCell(const MethodSummary& row, bool yardstick) {
  if (std::isnan(row.mseWithoutLights.value)) return "no such pixel";
  const std::string ratio = ratioCell(row.mseRatioWithoutLights, yardstick);
  return fmt::format("{:.3g}{}", row.mseWithoutLights.value,
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

std::string trimmedCell(const MethodSummary& row, bool yardstick) {
  const std::string ratio = ratioCell(row.relmseTrimmedRatio, yardstick);
  return fmt::format("{:.3g}{}", row.relmseTrimmed.value,
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

std::string biasCell(const MethodSummary& row) {
  return std::isnan(row.biasShare) ? "unknown" : fmt::format("{:+.1f} %", 100.0 * row.biasShare);
}

}  // namespace

std::string blockTable(const Suite& suite, const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const BlockResult& block = *rows.front().block;
  const size_t yardstick = suite.yardstick();
  std::string text = fmt::format(
      "## {}, {} light\n\nCamera {}, {}x{}, {} scattering events, Russian roulette {}, filter "
      "{}{}; "
      "{} runs of {} warm-up and {} timed frames; reference {} spp (relMSE {:.2g}).\n\n",
      block.scene, componentName(block.component), block.camera, block.width, block.height,
      suite.maxBounces, suite.russianRoulette ? "on" : "off", filterName(suite.pixelFilter),
      suite.multiscatter ? ", multiple scattering compensated" : "", rows.front().runs,
      suite.warmupFrames, suite.timedFrames, block.reference.spp, block.reference.relmse);
  text +=
      "| method | time per frame | MSE | | efficiency | energy | bias^2/MSE | worst 0.1 % | MSE "
      "without lights in view | relMSE without the worst 0.1 % | rays/px |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::string notes;
  for (const MethodSummary& row : rows) {
    const bool isYardstick =
        yardstick < suite.methods.size() && row.method == &suite.methods[yardstick];
    text += fmt::format(
        "| {}{} | {} | {:.3g}{} | {} | {} | {:.3f} | {} | {:.0f} % | {} | {} | {:.1f} |\n",
        row.method->name, row.counts ? "" : " (*)", timeCell(row, isYardstick), row.mse.value,
        interval(row.mse.lo, row.mse.hi, "{:.3g}"), ratioCell(row.mseRatio, isYardstick),
        efficiencyCell(row, isYardstick), row.energyRatio.value, biasCell(row),
        100.0 * row.worstShare, withoutLightsCell(row, isYardstick), trimmedCell(row, isYardstick),
        row.raysPathPerPixel + row.raysShadowPerPixel);
    for (const std::string& flag : row.flags) {
      notes += fmt::format("- {}{}: {}\n", row.method->name, row.counts ? "" : " (*)", flag);
    }
  }
  if (!block.reference.half0) {
    notes += "- the reference has no halves: its own noise is part of every MSE\n";
  }
  return text + (notes.empty() ? "" : "\n" + notes) + "\n";
}

}  // namespace restlab
