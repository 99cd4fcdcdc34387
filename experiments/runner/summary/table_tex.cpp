// table.tex: tables for a paper, with booktabs; the best counting row in bold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "experiments/report/text.h"
#include "experiments/runner/summary/figures.h"
#include "experiments/runner/summary/report.h"

namespace restlab {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : oneLine(text)) {
    switch (c) {
      case '\\':
        out += "\\textbackslash{}";
        break;
      case '~':
        out += "\\textasciitilde{}";
        break;
      case '^':
        out += "\\textasciicircum{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        out += '\\';
        out += c;
        break;
      default:
        out += c;
    }
  }
  return out;
}

// Returns "0.0278"; writes "1.30e-05" as a power of ten.
std::string number(double value, int digits = kDigits) {
  if (std::isnan(value)) return "--";
  if (std::isinf(value)) return value > 0.0 ? "$\\infty$" : "$-\\infty$";
  const std::string plain = shortNumber(value, digits);
  const size_t e = plain.find('e');
  if (e == std::string::npos) return value < 0.0 ? fmt::format("${}$", plain) : plain;
  return fmt::format("${} \\times 10^{{{}}}$", plain.substr(0, e), std::stoi(plain.substr(e + 1)));
}

// Returns the text of intervalText() in a small font; "" if an end is unknown.
std::string ends(const Interval& interval, int digits) {
  if (std::isnan(interval.lo) || std::isnan(interval.hi)) return "";
  const auto end = [&](double of) {
    return std::isinf(of) ? std::string("unbounded") : number(of, digits);
  };
  const bool isOpen = std::isinf(interval.lo) && std::isinf(interval.hi);
  return fmt::format(
      " {{\\scriptsize [{}]}}",
      isOpen ? "unbounded" : fmt::format("{}, {}", end(interval.lo), end(interval.hi)));
}

std::string cell(const Interval& interval, bool isBest, const std::string& unit = "",
                 int digits = kDigits) {
  if (std::isnan(interval.value)) return "";
  const std::string value = number(interval.value, digits) + unit;
  return (isBest ? fmt::format("\\textbf{{{}}}", value) : value) + ends(interval, digits);
}

// Returns the smallest value of the counting rows; NaN if fewer than two have one.
template <class Value>
double best(const std::vector<MethodSummary>& rows, const Value& value) {
  double smallest = kUnknown;
  size_t values = 0;
  for (const MethodSummary& row : rows) {
    if (!row.counts || std::isnan(value(row))) continue;
    ++values;
    if (!(value(row) >= smallest)) smallest = value(row);
  }
  return values < 2 ? kUnknown : smallest;
}

// Returns the beginning of captions: "scene, all light, max_bounces=2".
std::string subjectOf(const Suite& suite, const BlockResult& block) {
  return fmt::format("{}, {} light{}", escaped(block.scene), componentName(block.component),
                     suite.point.empty() ? "" : ", " + escaped(suite.point));
}

std::string nameCell(const MethodSummary& row) {
  return escaped(row.method->name) + (row.counts ? "" : "$^*$");
}

// `heads`: of the columns after the method; `lines`: complete lines between the rules.
std::string tableOf(const std::string& caption, const std::vector<std::string>& heads,
                    const std::string& lines, const std::string& notes) {
  std::string row = "method";
  for (const std::string& head : heads) row += " & " + head;
  return fmt::format(
      "\\begin{{table}}\n\\centering\n\\caption{{{}}}\n\\begin{{tabular}}{{l{}}}\n\\toprule\n"
      "{} \\\\\n\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n{}\\end{{table}}\n\n",
      caption, std::string(heads.size(), 'r'), row, lines, notes);
}

// Returns the suite's further metrics and masks, one column each; "" if there are none.
std::string figuresTex(const Suite& suite, const std::vector<MethodSummary>& rows) {
  const std::vector<FigureInfo> infos = figureInfos(suite);
  struct Column {
    size_t figure;
    double best;
    int digits;
  };
  std::vector<Column> columns;
  std::vector<std::string> heads;
  for (size_t f = 0; f < infos.size(); ++f) {
    const bool isKnown = std::any_of(rows.begin(), rows.end(), [&](const MethodSummary& row) {
      return !std::isnan(row.figures[f].second.value);
    });
    if (!isKnown) continue;  // a mask of another scene
    heads.push_back(escaped(infos[f].name));
    const double sign = findMetric(infos[f].metric).higherIsBetter ? -1.0 : 1.0;
    const double first =
        best(rows, [&](const MethodSummary& row) { return sign * row.figures[f].second.value; });
    const bool isEnergy = infos[f].metric == "energy_ratio";
    columns.push_back({f, isEnergy ? kUnknown : sign * first, digitsOf(infos[f])});
  }
  if (columns.empty()) return "";
  std::string lines;
  for (const MethodSummary& row : rows) {
    lines += nameCell(row);
    for (const Column& column : columns) {
      const Interval& figure = row.figures[column.figure].second;
      lines += " & " + cell(figure, row.counts && figure.value == column.best, "", column.digits);
    }
    lines += " \\\\\n";
  }
  return tableOf(subjectOf(suite, *rows.front().block) + ": further figures of the measured frame",
                 heads, lines, "");
}

// Returns slopes and speed-ups; "" if nothing was accumulated.
std::string accumulatedTex(const Suite& suite, const std::vector<MethodSummary>& rows) {
  std::string lines;
  for (const MethodSummary& row : rows) {
    if (!row.convergence || row.convergence->points.empty()) continue;
    lines += fmt::format("{} & {} & {}", nameCell(row), row.convergence->points.back().frames,
                         cell(row.convergence->slope, false));
    if (!row.speedUp || row.isBaseline) {
      lines += " & & \\\\\n";
      continue;
    }
    const auto read = [](const CurveReading& reading, const char* where, const char* unit) {
      if (std::isnan(reading.ratio.value)) return std::string();
      return fmt::format("{} {} {}{}", cell(reading.ratio, false, "$\\times$"), where,
                         number(reading.at), unit);
    };
    lines += fmt::format(" & {} & {} \\\\\n", read(row.speedUp->equalTime, "at", " ms"),
                         read(row.speedUp->equalError, "to", ""));
  }
  if (lines.empty()) return "";
  return tableOf(
      subjectOf(suite, *rows.front().block) +
          ": frames accumulated; slope of log(MSE) over log(time), MSE times lower at "
          "equal time, times faster to equal MSE" +
          (suite.baselineName().empty() ? "" : ", against " + escaped(suite.baselineName())),
      {"frames", "slope", "lower", "faster"}, lines, "");
}

// Prints why rows do not count below the table; other flags become comments for the author.
std::string notesOf(const std::vector<MethodSummary>& rows) {
  std::string notes;
  for (const MethodSummary& row : rows) {
    for (const std::string& flag : row.flags) {
      const std::string note = fmt::format("{}: {}", nameCell(row), escaped(flag));
      notes += row.counts ? fmt::format("% {}\n", note)
                          : fmt::format("\\par{{\\footnotesize {}}}\n", note);
    }
  }
  return notes;
}

}  // namespace

std::string blockTex(const Suite& suite, const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const BlockResult& block = *rows.front().block;
  // Exclude errors below the reference's noise from the best.
  const double mse = best(rows, [](const MethodSummary& row) {
    return row.mse.value > 0.0 ? row.mse.value : kUnknown;
  });
  // Exclude times reported by other programs, which were not measured here.
  const double timeMs = best(rows, [](const MethodSummary& row) {
    return row.method->images ? kUnknown : row.timeMsMedian;
  });
  std::string lines;
  for (const MethodSummary& row : rows) {
    const Interval unknown{kUnknown, kUnknown, kUnknown};
    const std::string ms = number(row.timeMsMedian);
    const double bias = 100.0 * row.biasShare.value;
    lines += fmt::format(
        "{} & {} & {} & {} & {} & {} & {} \\\\\n", nameCell(row),
        row.counts && row.timeMsMedian == timeMs ? fmt::format("\\textbf{{{}}}", ms) : ms,
        cell(row.isBaseline ? unknown : row.timeRatio, false, "$\\times$"),
        cell(errorOf(row.mse), row.counts && row.mse.value == mse),
        cell(row.isBaseline ? unknown : row.mseRatio, false, "$\\times$"),
        cell(row.energyRatio, false, "", kEnergyDigits),
        std::isnan(bias) ? "--" : fmt::format("${:+.1f}$\\,\\%", bias));
  }
  const std::string against = suite.baselineName();
  const std::string caption = fmt::format(
      "{}: {}$\\times${}, {} of {} warm-up and {} timed frames, reference of {} spp (relMSE "
      "{}); {}95\\,\\% intervals",
      subjectOf(suite, block), block.width, block.height, counted(rows.front().runs, "run"),
      suite.warmupFrames, suite.timedFrames, block.reference.spp, number(block.reference.relmse),
      against.empty() ? "" : fmt::format("time and lower against {}; ", escaped(against)));
  return tableOf(caption, {"ms", "time", "MSE", "lower", "energy", "bias$^2$"}, lines,
                 notesOf(rows)) +
         accumulatedTex(suite, rows) + figuresTex(suite, rows);
}

}  // namespace restlab
