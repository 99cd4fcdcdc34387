// table.md: the lecture's table of each scene and component, with what its reader must know.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "experiments/report/text.h"
#include "experiments/runner/summary/figures.h"
#include "experiments/runner/summary/report.h"

namespace restlab {

namespace {

constexpr uint32_t kFewRuns = 4;

std::string endsOf(const Interval& of) { return intervalText(of.lo, of.hi); }

// Value and interval.
std::string withEnds(const Interval& of, int digits = kDigits) {
  return shortNumber(of.value, digits) + intervalText(of.lo, of.hi, digits);
}

std::string timeCell(const MethodSummary& row) {
  if (std::isnan(row.timeMsMedian)) return "unknown";
  const std::string text = shortNumber(row.timeMsMedian) + " ms";
  if (row.isYardstick || std::isnan(row.timeRatio.value)) return text;
  return text + fmt::format(" ({}x{})", shortNumber(row.timeRatio.value), endsOf(row.timeRatio));
}

std::string longTime(double timeMs) {
  return std::isnan(timeMs) ? "unknown" : shortNumber(timeMs) + " ms";
}

std::string ratioCell(const Interval& of, bool isYardstick) {
  if (isYardstick || std::isnan(of.value)) return "";
  return timesText(of.value, of.lo, of.hi, "lower", "higher");
}

std::string efficiencyCell(const MethodSummary& row) {
  if (row.isYardstick || std::isnan(row.efficiencyRatio.value)) return "";
  return withEnds(row.efficiencyRatio);
}

std::string withoutLightsCell(const MethodSummary& row) {
  if (std::isnan(row.mseWithoutLights.value)) return "no such pixel";
  const std::string ratio = ratioCell(row.mseRatioWithoutLights, row.isYardstick);
  return fmt::format("{}{}", shortNumber(row.mseWithoutLights.value),
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

std::string trimmedCell(const MethodSummary& row) {
  const std::string ratio = ratioCell(row.relmseTrimmedRatio, row.isYardstick);
  return fmt::format("{}{}", shortNumber(row.relmseTrimmed.value),
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

// Heading of the column that compares backends; "" where no row has another one to compare with.
std::string backendColumn(const Suite& suite, const std::vector<MethodSummary>& rows) {
  std::string first;
  for (const MethodSummary& row : rows) {
    if (std::isnan(row.timeToFirstBackend.value)) continue;
    const size_t method = size_t(row.method - suite.methods.data());
    const std::string& backend = suite.methods[suite.onFirstBackend(method)].session.backend;
    if (first.empty()) first = backend;
    if (first != backend) first = "first backend";
  }
  return first.empty() ? "" : "time / " + first;
}

std::string backendCell(const MethodSummary& row, const std::string& column) {
  if (column.empty()) return "";
  const Interval& ratio = row.timeToFirstBackend;
  if (std::isnan(ratio.value)) return " |";
  return fmt::format(" {}x{} |", shortNumber(ratio.value), endsOf(ratio));
}

std::string raysCell(const MethodSummary& row) {
  const double rays = row.raysPathPerPixel + row.raysShadowPerPixel;
  return std::isnan(rays) ? "" : shortNumber(rays);
}

std::string biasCell(const MethodSummary& row) {
  const Interval& share = row.biasShare;
  if (std::isnan(share.value)) return "unknown";
  const std::string text = fmt::format("{:+.1f}", 100.0 * share.value);
  if (std::isnan(share.lo) || std::isnan(share.hi)) return text + " %";
  if (std::isinf(share.lo) || std::isinf(share.hi)) return text + " [unbounded] %";
  return fmt::format("{} [{:+.1f}, {:+.1f}] %", text, 100.0 * share.lo, 100.0 * share.hi);
}

// Where all methods run on one that is not the usual one; several are in the methods' names.
std::string onBackend(const Suite& suite) {
  const std::vector<std::string> backends = suite.methodBackends();
  return backends.size() == 1 && backends[0] != "cpu" ? fmt::format("Backend {}. ", backends[0])
                                                      : "";
}

// "6 of 8 points (not 1, 2 frames), up to 1.04x off"; "" without a line.
std::string fitCell(const Convergence& curve) {
  if (std::isnan(curve.slope.value)) return "";
  std::string left;
  for (const ConvergencePoint& point : curve.points) {
    if (!point.isFitted) left += fmt::format("{}{}", left.empty() ? "" : ", ", point.frames);
  }
  return fmt::format("{} of {} points{}, up to {}x off", curve.fitted(), curve.points.size(),
                     left.empty() ? "" : fmt::format(" (not {} frames)", left),
                     shortNumber(std::pow(10.0, curve.misfit)));
}

std::string readingCell(const CurveReading& reading, const char* gain, const char* loss,
                        const std::string& at) {
  const Interval& ratio = reading.ratio;
  if (std::isnan(ratio.value)) return "";
  return timesText(ratio.value, ratio.lo, ratio.hi, gain, loss) + " " + at;
}

// Slopes and speed-ups; "" where nothing was accumulated.
std::string accumulatedTable(const std::vector<MethodSummary>& rows) {
  std::string text;
  for (const MethodSummary& row : rows) {
    if (!row.convergence || row.convergence->points.empty()) continue;
    const ConvergencePoint& last = row.convergence->points.back();
    const Interval& slope = row.convergence->slope;
    text += fmt::format("| {} | {} | {} | {} | {} | {} |", oneLine(row.method->name), last.frames,
                        longTime(last.timeMs), withEnds(last.mse),
                        std::isnan(slope.value) ? "" : withEnds(slope), fitCell(*row.convergence));
    if (row.speedUp && !row.isYardstick) {
      const CurveReading &time = row.speedUp->equalTime, &error = row.speedUp->equalError;
      text += fmt::format(" {} | {} |\n",
                          readingCell(time, "lower", "higher", "at " + longTime(time.at)),
                          readingCell(error, "faster", "slower", "to " + shortNumber(error.at)));
    } else {
      text += " | |\n";
    }
  }
  if (text.empty()) return "";
  return "\nFrames accumulated, time from the beginning of the history; slopes and ratios are of "
         "lines fitted to log(MSE) over log(time):\n\n"
         "| method | frames | time | MSE | slope | line | at equal time | to equal error |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         text;
}

std::string figuresTable(const std::vector<MethodSummary>& rows) {
  const auto& named = rows.front().figures;
  const std::vector<FigureInfo> infos = figureInfos(*rows.front().suite);
  std::string heads, rule, lines;
  std::vector<bool> isKnown;
  for (size_t i = 0; i < named.size(); ++i) {
    isKnown.push_back(std::any_of(rows.begin(), rows.end(), [&](const MethodSummary& row) {
      return !std::isnan(row.figures[i].second.value);
    }));
    if (!isKnown[i]) continue;
    heads += fmt::format(" {} |", named[i].first);
    rule += "---|";
  }
  if (heads.empty()) return "";
  for (const MethodSummary& row : rows) {
    lines += fmt::format("| {} |", oneLine(row.method->name));
    for (size_t i = 0; i < row.figures.size(); ++i) {
      const Interval& figure = row.figures[i].second;
      if (isKnown[i]) {
        lines += fmt::format(" {} |", withEnds(figure, digitsOf(infos[i])));
      }
    }
    lines += "\n";
  }
  return fmt::format("\nOf the measured frame:\n\n| method |{}\n|---|{}\n{}", heads, rule, lines);
}

std::string temporalTable(const std::vector<MethodSummary>& rows) {
  std::string text, moved;
  const auto cellOf = [](const Interval& of) {
    return std::isnan(of.value) ? std::string(" |") : " " + withEnds(of) + " |";
  };
  for (const MethodSummary& row : rows) {
    if (!row.temporal) continue;
    const TemporalSummary& t = *row.temporal;
    text += fmt::format("| {} |", oneLine(row.method->name)) + cellOf(t.variance) +
            cellOf(t.difference) + cellOf(t.errorDifferenceSquared);
    for (const size_t lag : {1, 2, 4, 8}) text += cellOf(t.autocorrelation[lag - 1]);
    text += "\n";
    if (row.suite->hasMovingCamera())
      moved = "; the two references differ by " + shortNumber(t.referenceDifference);
  }
  if (text.empty()) return "";
  return "\nOver the timed frames of a run: variance of a pixel, mean absolute difference of frames"
         ", mean squared change of errors, correlation of errors by the number of frames between "
         "them" +
         moved +
         ":\n\n"
         "| method | variance | difference | change of errors | 1 | 2 | 4 | 8 |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         text;
}

std::string markedName(const MethodSummary& row) {
  return oneLine(row.method->name) + (row.counts ? "" : " (*)");
}

// What each row costs and what it leaves.
std::string errorTable(const std::vector<MethodSummary>& rows) {
  const bool hasAverage = std::any_of(rows.begin(), rows.end(), [](const MethodSummary& row) {
    return !std::isnan(row.ratioToAverage.value);
  });
  std::string text = fmt::format(
      "| method | time per frame | MSE | than the path tracer |{} energy |\n"
      "|---|---|---|---|{}---|\n",
      hasAverage ? " than its average |" : "", hasAverage ? "---|" : "");
  for (const MethodSummary& row : rows) {
    text += fmt::format("| {} | {} | {} | {} |", markedName(row), timeCell(row), withEnds(row.mse),
                        ratioCell(row.mseRatio, row.isYardstick));
    if (hasAverage) text += fmt::format(" {} |", ratioCell(row.ratioToAverage, row.isAverage));
    text += fmt::format(" {} |\n", withEnds(row.energyRatio, kEnergyDigits));
  }
  return text;
}

// What makes up the error, and what it took.
std::string detailsTable(const std::vector<MethodSummary>& rows) {
  const std::string backends = backendColumn(*rows.front().suite, rows);
  std::string text = fmt::format(
      "\n| method | efficiency | bias^2/MSE | variance | worst 0.1 % | rays/px |{}\n"
      "|---|---|---|---|---|---|{}\n",
      backends.empty() ? "" : fmt::format(" {} |", backends), backends.empty() ? "" : "---|");
  for (const MethodSummary& row : rows) {
    text += fmt::format("| {} | {} | {} | {} | {:.0f} % | {} |{}\n", markedName(row),
                        efficiencyCell(row), biasCell(row),
                        std::isnan(row.variance.value) ? "unknown" : withEnds(row.variance),
                        100.0 * row.worstShare, raysCell(row), backendCell(row, backends));
  }
  text +=
      "\n| method | MSE without lights in view | relMSE without the worst 0.1 % |\n"
      "|---|---|---|\n";
  for (const MethodSummary& row : rows) {
    text += fmt::format("| {} | {} | {} |\n", markedName(row), withoutLightsCell(row),
                        trimmedCell(row));
  }
  return text;
}

// One line an age, one column a method; "" where nothing is known.
std::string agesTable(const std::vector<MethodSummary>& rows, const char* against,
                      Interval (*ratio)(const AgeSummary&)) {
  std::vector<const MethodSummary*> known;
  for (const MethodSummary& row : rows) {
    const bool isItself = std::all_of(row.ages.begin(), row.ages.end(), [&](const AgeSummary& age) {
      const Interval of = ratio(age);
      return std::isnan(of.value) || (of.value == 1.0 && of.lo == 1.0 && of.hi == 1.0);
    });
    if (!isItself) known.push_back(&row);
  }
  if (known.empty()) return "";
  std::string text = fmt::format(
      "\nMSE of {} over MSE, by the number of frames since the view stands still; above 1: lower "
      "error:\n\n| frame |",
      against);
  std::string rule = "|---|";
  for (const MethodSummary* row : known) {
    text += fmt::format(" {} |", markedName(*row));
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (size_t i = 0; i < known.front()->ages.size(); ++i) {
    text += fmt::format("| {} |", known.front()->ages[i].age);
    for (const MethodSummary* row : known)
      text += fmt::format(" {} |", withEnds(ratio(row->ages[i])));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string blockTable(const Suite& suite, const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const BlockResult& block = *rows.front().block;
  std::string text = fmt::format(
      "## {}, {} light{}\n\n{}Camera {}{}{}, {}x{}, {} scattering events, Russian roulette {}, "
      "filter "
      "{}{}; "
      "{} of {} warm-up and {} timed frames; reference {}.\n\n",
      block.scene, componentName(block.component), suite.point.empty() ? "" : ", " + suite.point,
      onBackend(suite), block.camera,
      suite.hasMovingCamera() ? fmt::format(" on the path '{}'", suite.cameraPathName) : "",
      suite.events.empty() ? "" : ", lights: " + eventsText(suite.events, suite.warmupFrames),
      block.width, block.height, suite.maxBounces, suite.russianRoulette ? "on" : "off",
      filterName(suite.pixelFilter), suite.multiscatter ? ", multiple scattering compensated" : "",
      counted(rows.front().runs, "run"), suite.warmupFrames, suite.timedFrames,
      originOf(block.reference));
  text += errorTable(rows);
  std::string notes;
  if (!suite.baseline.empty()) notes += fmt::format("- ratios are against {}\n", suite.baseline);
  if (rows.front().runs < kFewRuns) {
    notes += fmt::format(
        "- {}: intervals of fewer than {} say little\n",
        rows.front().runs == 1 ? "one run" : fmt::format("{} runs", rows.front().runs), kFewRuns);
  }
  for (const MethodSummary& row : rows) {
    for (const std::string& flag : row.flags) {
      notes +=
          fmt::format("- {}{}: {}\n", oneLine(row.method->name), row.counts ? "" : " (*)", flag);
    }
  }
  text += detailsTable(rows);
  text += agesTable(rows, "path", [](const AgeSummary& age) { return age.mseRatio; });
  text += agesTable(rows, "the average of its frames",
                    [](const AgeSummary& age) { return age.ratioToAverage; });
  text += figuresTable(rows);
  text += accumulatedTable(rows);
  text += temporalTable(rows);
  if (!block.reference.half0) {
    notes += "- the reference has no halves: its own noise is part of every MSE\n";
  }
  return text + (notes.empty() ? "" : "\n" + notes) + "\n";
}

}  // namespace restlab
