// table.tex: the tables for a paper, with booktabs; the best that counts in bold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/metrics.h"
#include "experiments/report/text.h"
#include "experiments/runner/figures.h"
#include "experiments/runner/report.h"

namespace restlab {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
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

// "0.0278"; "1.30e-05" as a power of ten.
std::string number(double value, int digits = kDigits) {
  if (std::isnan(value)) return "--";
  if (std::isinf(value)) return value > 0.0 ? "$\\infty$" : "$-\\infty$";
  const std::string plain = shortNumber(value, digits);
  const size_t e = plain.find('e');
  if (e == std::string::npos) return value < 0.0 ? fmt::format("${}$", plain) : plain;
  return fmt::format("${} \\times 10^{{{}}}$", plain.substr(0, e), std::stoi(plain.substr(e + 1)));
}

std::string cell(const Interval& interval, bool isBest, const std::string& unit = "",
                 int digits = kDigits) {
  if (std::isnan(interval.value)) return "";
  const std::string value = number(interval.value, digits) + unit;
  const bool isKnown = std::isfinite(interval.lo) && std::isfinite(interval.hi);
  return (isBest ? fmt::format("\\textbf{{{}}}", value) : value) +
         (isKnown ? fmt::format(" {{\\scriptsize [{}, {}]}}", number(interval.lo, digits),
                                number(interval.hi, digits))
                  : "");
}

// The smallest value of the rows that count; NaN where there are not two to choose from.
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

constexpr const char* kTableEnd = "\\bottomrule\n\\end{tabular}\n\\end{table}\n\n";

// The suite's further metrics and masks, a column each; "" where it has none.
std::string figuresTex(const Suite& suite, const std::vector<MethodSummary>& rows) {
  const std::vector<FigureInfo> infos = figureInfos(suite);
  const BlockResult& block = *rows.front().block;
  struct Column {
    size_t figure;
    double best;
    int digits;
  };
  std::vector<Column> columns;
  std::string heads;
  for (size_t f = 0; f < infos.size(); ++f) {
    const bool isKnown = std::any_of(rows.begin(), rows.end(), [&](const MethodSummary& row) {
      return !std::isnan(row.figures[f].second.value);
    });
    if (!isKnown) continue;  // a mask of another scene
    heads += " & " + escaped(infos[f].name);
    const double sign = findMetric(infos[f].metric).higherIsBetter ? -1.0 : 1.0;
    const double first =
        best(rows, [&](const MethodSummary& row) { return sign * row.figures[f].second.value; });
    const bool isEnergy = infos[f].metric == "energy_ratio";
    columns.push_back({f, isEnergy ? kUnknown : sign * first, digitsOf(infos[f])});
  }
  if (columns.empty()) return "";
  std::string text = fmt::format(
      "\\begin{{table}}\n\\centering\n\\caption{{{}, {} light{}: further figures of the measured "
      "frame}}\n\\begin{{tabular}}{{l{}}}\n\\toprule\nmethod{} \\\\\n\\midrule\n",
      escaped(block.scene), componentName(block.component),
      suite.point.empty() ? "" : ", " + escaped(suite.point), std::string(columns.size(), 'r'),
      heads);
  for (const MethodSummary& row : rows) {
    text += escaped(row.method->name) + (row.counts ? "" : "$^*$");
    for (const Column& column : columns) {
      const Interval& figure = row.figures[column.figure].second;
      text += " & " + cell(figure, row.counts && figure.value == column.best, "", column.digits);
    }
    text += " \\\\\n";
  }
  return text + kTableEnd;
}

}  // namespace

std::string blockTex(const Suite& suite, const std::vector<MethodSummary>& rows) {
  if (rows.empty()) return "";
  const BlockResult& block = *rows.front().block;
  std::string text = fmt::format(
      "% {}x{}, {} runs of {} warm-up and {} timed frames, reference {} spp; 95 % intervals\n"
      "\\begin{{table}}\n\\centering\n\\caption{{{}, {} light{}}}\n"
      "\\begin{{tabular}}{{lrrrrr}}\n\\toprule\n"
      "method & ms & time & MSE & lower & energy \\\\\n\\midrule\n",
      block.width, block.height, rows.front().runs, suite.warmupFrames, suite.timedFrames,
      block.reference.spp, escaped(block.scene), componentName(block.component),
      suite.point.empty() ? "" : ", " + escaped(suite.point));
  const double mse = best(rows, [](const MethodSummary& row) { return row.mse.value; });
  // What others say of their time was not measured beside ours.
  const double timeMs = best(rows, [](const MethodSummary& row) {
    return row.method->images ? kUnknown : row.timeMsMedian;
  });
  for (const MethodSummary& row : rows) {
    const Interval unknown{kUnknown, kUnknown, kUnknown};
    const std::string ms = number(row.timeMsMedian);
    text += fmt::format(
        "{}{} & {} & {} & {} & {} & {} \\\\\n", escaped(row.method->name), row.counts ? "" : "$^*$",
        row.counts && row.timeMsMedian == timeMs ? fmt::format("\\textbf{{{}}}", ms) : ms,
        cell(row.isYardstick ? unknown : row.timeRatio, false, "$\\times$"),
        cell(row.mse, row.counts && row.mse.value == mse),
        cell(row.isYardstick ? unknown : row.mseRatio, false, "$\\times$"),
        number(row.energyRatio.value, kEnergyDigits));
  }
  return text + kTableEnd + figuresTex(suite, rows);
}

}  // namespace restlab
