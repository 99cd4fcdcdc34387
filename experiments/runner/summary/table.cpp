// table.md: the table of each scene and component, with notes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "experiments/report/text.h"
#include "experiments/runner/summary/figures.h"
#include "experiments/runner/summary/disturbed.h"
#include "experiments/runner/summary/markdown_table.h"
#include "experiments/runner/summary/report.h"
#include "experiments/runner/summary/row_notes.h"

namespace restlab {

namespace {

constexpr uint32_t kFewRuns = 4;

std::string endsOf(const Interval& of) { return intervalText(of.lo, of.hi); }

// Returns the value followed by its interval.
std::string withEnds(const Interval& of, int digits = kDigits) {
  return shortNumber(of.value, digits) + intervalText(of.lo, of.hi, digits);
}

std::string ratioWithEnds(const Interval& of) {
  return of.value > 0.0 ? withEnds(of) : "not known";
}

std::string timeCell(const MethodSummary& row) {
  if (std::isnan(row.timeMsMedian)) return "unknown";
  const std::string text = shortNumber(row.timeMsMedian) + " ms";
  if (row.isBaseline || std::isnan(row.timeRatio.value)) return text;
  return text + fmt::format(" ({}x{})", shortNumber(row.timeRatio.value), endsOf(row.timeRatio));
}

std::string longTime(double timeMs) {
  return std::isnan(timeMs) ? "unknown" : shortNumber(timeMs) + " ms";
}

std::string ratioCell(const Interval& of, bool isBaseline) {
  if (isBaseline || std::isnan(of.value)) return "";
  return timesText(of.value, of.lo, of.hi, "lower", "higher");
}

std::string efficiencyCell(const MethodSummary& row) {
  if (row.isBaseline || std::isnan(row.efficiencyRatio.value)) return "";
  return ratioWithEnds(row.efficiencyRatio);
}

std::string withoutLightsCell(const MethodSummary& row) {
  if (std::isnan(row.mseWithoutLights.value)) return "no such pixel";
  const std::string ratio = ratioCell(row.mseRatioWithoutLights, row.isBaseline);
  return fmt::format("{}{}", shortNumber(row.mseWithoutLights.value),
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

std::string trimmedCell(const MethodSummary& row) {
  const std::string ratio = ratioCell(row.relmseTrimmedRatio, row.isBaseline);
  return fmt::format("{}{}", shortNumber(row.relmseTrimmed.value),
                     ratio.empty() ? "" : fmt::format(" ({})", ratio));
}

// Returns the heading of a column relative to `name`; without the name if it is "".
std::string againstHead(const std::string& what, const std::string& name) {
  return name.empty() ? what : fmt::format("{} {}", what, name);
}

// Returns the heading of the column that compares backends; "" if no row has another backend.
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
  const Interval& ratio = row.timeToFirstBackend;
  if (column.empty() || std::isnan(ratio.value)) return "";
  return fmt::format("{}x{}", shortNumber(ratio.value), endsOf(ratio));
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

// Names the backend if all methods run on the same one and it is not "cpu". Otherwise method names
// do.
std::string onBackend(const Suite& suite) {
  const std::vector<std::string> backends = suite.methodBackends();
  return backends.size() == 1 && backends[0] != "cpu" ? fmt::format("Backend {}. ", backends[0])
                                                      : "";
}

// Returns "6 of 8 points (not 1, 2 frames), up to 1.04x off"; "" without a line.
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

// Returns slopes and speed-ups; "" if nothing was accumulated.
std::string accumulatedTable(const std::vector<MethodSummary>& rows, const std::string& against) {
  MarkdownTable table(
      {"method", "frames", "time", "MSE", "slope", "line", "at equal time", "to equal error"});
  for (const MethodSummary& row : rows) {
    if (!row.convergence || row.convergence->points.empty()) continue;
    const ConvergencePoint& last = row.convergence->points.back();
    const Interval& slope = row.convergence->slope;
    std::string atEqualTime, toEqualError;
    if (row.speedUp && !row.isBaseline) {
      const CurveReading &time = row.speedUp->equalTime, &error = row.speedUp->equalError;
      atEqualTime = readingCell(time, "lower", "higher", "at " + longTime(time.at));
      toEqualError = readingCell(error, "faster", "slower", "to " + shortNumber(error.at));
    }
    table.add({row.method->name, std::to_string(last.frames), longTime(last.timeMs),
               withEnds(errorOf(last.mse)), std::isnan(slope.value) ? "" : withEnds(slope),
               fitCell(*row.convergence), atEqualTime, toEqualError});
  }
  if (table.isEmpty()) return "";
  return "\nFrames accumulated, time from the beginning of the history; slopes and ratios are of "
         "lines fitted to log(MSE) over log(time)" +
         againstHead(against.empty() ? "" : "; against", against) + ":\n\n" + table.text();
}

std::string figuresTable(const std::vector<MethodSummary>& rows) {
  const auto& named = rows.front().figures;
  const std::vector<FigureInfo> infos = figureInfos(*rows.front().suite);
  std::vector<size_t> known;
  std::vector<std::string> heads = {"method"};
  for (size_t i = 0; i < named.size(); ++i) {
    const bool isKnown = std::any_of(rows.begin(), rows.end(), [&](const MethodSummary& row) {
      return !std::isnan(row.figures[i].second.value);
    });
    if (!isKnown) continue;
    known.push_back(i);
    heads.push_back(named[i].first);
  }
  if (known.empty()) return "";
  MarkdownTable table(heads);
  for (const MethodSummary& row : rows) {
    std::vector<std::string> cells = {row.method->name};
    for (const size_t i : known)
      cells.push_back(withEnds(row.figures[i].second, digitsOf(infos[i])));
    table.add(std::move(cells));
  }
  return "\nOf the measured frame:\n\n" + table.text();
}

std::string temporalTable(const std::vector<MethodSummary>& rows) {
  std::string moved;
  const auto cellOf = [](const Interval& of) {
    return std::isnan(of.value) ? std::string() : withEnds(of);
  };
  MarkdownTable table({"method", "variance", "difference", "change of errors", "1", "2", "4", "8"});
  for (const MethodSummary& row : rows) {
    if (!row.temporal) continue;
    const TemporalSummary& t = *row.temporal;
    std::vector<std::string> cells = {row.method->name, cellOf(t.variance), cellOf(t.difference),
                                      cellOf(t.errorDifferenceSquared)};
    for (const size_t lag : {1, 2, 4, 8}) cells.push_back(cellOf(t.autocorrelation[lag - 1]));
    table.add(std::move(cells));
    if (row.suite->hasMovingCamera())
      moved = "; the two references differ by " + shortNumber(t.referenceDifference);
  }
  if (table.isEmpty()) return "";
  return "\nOver the timed frames of a run: variance of a pixel, mean absolute difference of frames"
         ", mean squared change of errors, correlation of errors by the number of frames between "
         "them" +
         moved + ":\n\n" + table.text();
}

// Names of the methods that rows are compared with; "" if there is none.
struct Names {
  std::string baseline, average;
};

// Returns "(x times that of path)"; "" without a baseline.
std::string timesOf(const Names& names) {
  return names.baseline.empty() ? "" : fmt::format("(x times that of {})", names.baseline);
}

std::string markedName(const MethodSummary& row) {
  return oneLine(row.method->name) + (row.counts ? "" : " (*)");
}

// Returns the main table: time and error of each row.
std::string errorTable(const std::vector<MethodSummary>& rows, const Names& names) {
  MarkdownTable table({"method", againstHead("time per frame", timesOf(names)), "MSE",
                       againstHead("than", names.baseline), againstHead("than", names.average),
                       "energy"});
  for (const MethodSummary& row : rows) {
    table.add({markedName(row), timeCell(row), withEnds(errorOf(row.mse)),
               ratioCell(row.mseRatio, row.isBaseline),
               ratioCell(row.ratioToAverage, row.isAverage),
               withEnds(row.energyRatio, kEnergyDigits)});
  }
  return table.text();
}

// Returns the parts of the error, and the efficiency.
std::string detailsTable(const std::vector<MethodSummary>& rows, const Names& names) {
  const std::string backends = backendColumn(*rows.front().suite, rows);
  const auto named = [&](const char* what, const char* word) {
    return names.baseline.empty() ? what : fmt::format("{} ({} {})", what, word, names.baseline);
  };
  MarkdownTable table({"method", named("efficiency", "against"), "bias^2/MSE", "variance",
                       "worst 0.1 %", "rays/px", backends.empty() ? "time" : backends});
  for (const MethodSummary& row : rows) {
    table.add({markedName(row), efficiencyCell(row), biasCell(row),
               std::isnan(row.variance.value) ? "unknown" : withEnds(row.variance),
               fmt::format("{:.0f} %", 100.0 * row.worstShare), raysCell(row),
               backendCell(row, backends)});
  }
  MarkdownTable further({"method", named("MSE without lights in view", "than"),
                         named("relMSE without the worst 0.1 %", "than")});
  for (const MethodSummary& row : rows)
    further.add({markedName(row), withoutLightsCell(row), trimmedCell(row)});
  return "\n" + table.text() + "\n" + further.text();
}

// Returns one line per age, one column per method; "" if nothing is known.
std::string agesTable(const std::vector<MethodSummary>& rows, const std::string& against,
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
  std::vector<std::string> heads = {"frame"};
  for (const MethodSummary* row : known) heads.push_back(markedName(*row));
  MarkdownTable table(heads);
  for (size_t i = 0; i < known.front()->ages.size(); ++i) {
    std::vector<std::string> cells = {std::to_string(known.front()->ages[i].age)};
    for (const MethodSummary* row : known) {
      const Interval of = ratio(row->ages[i]);
      cells.push_back(std::isnan(of.value) ? "" : ratioWithEnds(of));
    }
    table.add(std::move(cells));
  }
  return fmt::format(
             "\nMSE of {} over MSE, by the number of frames since the view stands still; above 1: "
             "lower error:\n\n",
             against) +
         table.text();
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
  const Names names = {suite.baselineName(), suite.averageName()};
  text += errorTable(rows, names);
  std::string notes;
  if (rows.front().runs < kFewRuns) {
    notes += fmt::format(
        "- {}: intervals of fewer than {} say little\n",
        rows.front().runs == 1 ? "one run" : fmt::format("{} runs", rows.front().runs), kFewRuns);
  }
  notes += disturbedNote(rows);
  notes += rowNotes(rows);
  text += detailsTable(rows, names);
  text += agesTable(rows, names.baseline, [](const AgeSummary& age) { return age.mseRatio; });
  text += agesTable(rows, names.average, [](const AgeSummary& age) { return age.ratioToAverage; });
  text += figuresTable(rows);
  text += accumulatedTable(rows, names.baseline);
  text += temporalTable(rows);
  if (!block.reference.half0) {
    notes += "- the reference has no halves: its own noise is part of every MSE\n";
  }
  return text + (notes.empty() ? "" : "\n" + notes) + "\n";
}

}  // namespace restlab
