// table.tex: the tables for a paper, with booktabs; the best that counts in bold.
#include <fmt/format.h>

#include <cmath>

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

// Three digits that count: "0.0278", "1.3e-05" as a power of ten.
std::string number(double value) {
  if (std::isnan(value)) return "--";
  if (std::isinf(value)) return value > 0.0 ? "$\\infty$" : "$-\\infty$";
  const std::string plain = fmt::format("{:.3g}", value);
  const size_t e = plain.find('e');
  if (e == std::string::npos) return plain;
  return fmt::format("${} \\times 10^{{{}}}$", plain.substr(0, e), std::stoi(plain.substr(e + 1)));
}

std::string cell(const Interval& interval, bool isBest, const std::string& unit = "") {
  if (std::isnan(interval.value)) return "";
  const std::string value = number(interval.value) + unit;
  const bool isKnown = std::isfinite(interval.lo) && std::isfinite(interval.hi);
  return (isBest ? fmt::format("\\textbf{{{}}}", value) : value) +
         (isKnown
              ? fmt::format(" {{\\scriptsize [{}, {}]}}", number(interval.lo), number(interval.hi))
              : "");
}

// The smallest value of the rows that count; NaN where none does.
template <class Value>
double best(const std::vector<MethodSummary>& rows, const Value& value) {
  double smallest = std::nan("");
  for (const MethodSummary& row : rows) {
    if (!row.counts || std::isnan(value(row))) continue;
    if (!(value(row) >= smallest)) smallest = value(row);
  }
  return smallest;
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
        number(row.energyRatio.value));
  }
  return text + "\\bottomrule\n\\end{tabular}\n\\end{table}\n\n";
}

}  // namespace restlab
