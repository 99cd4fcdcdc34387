// Output of a sweep: its table and its block of the report.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "experiments/report/text.h"
#include "experiments/runner/base/json_number.h"
#include "experiments/runner/tables/markdown_cells.h"
#include "experiments/runner/tables/scene_sweep.h"
#include "experiments/runner/tables/swept_axis.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Cell of a method with the largest `distance`; null if no cell has one.
struct Worst {
  size_t value = 0;
  const SweptCell* cell = nullptr;
};

Worst worstOf(const SceneSweep& sweep, size_t method, double (*distance)(const SweptCell&)) {
  Worst worst;
  double farthest = 0.0;
  for (size_t i = 0; i < sweep.blocks.size(); ++i) {
    if (!sweep.blocks[i]) continue;
    const SweptCell& cell = sweep.cells[method][i];
    const double own = distance(cell);
    if (std::isnan(own) || (worst.cell && own <= farthest)) continue;
    farthest = own;
    worst = {i, &cell};
  }
  return worst;
}

// A figure of a row, shown with `digits`. Has a plot over the values if `yTitle` is set.
struct SweepColumn {
  const char *key, *title, *help;
  int digits;
  const char* yTitle;
  bool isLogY;
  Interval (*value)(const SweptCell&);
  double (*distance)(const SweptCell&);  // the largest is shown; NaN: skip this cell
};

// Figures of sweeps, each shown at its worst value.
const std::vector<SweepColumn>& sweepColumns() {
  static const std::vector<SweepColumn> all = {
      {"energy", "energy", "mean of the images over that of the truth, where it is farthest from 1",
       kEnergyDigits, "energy / that of the truth", false,
       [](const SweptCell& cell) { return cell.energy; },
       [](const SweptCell& cell) { return std::abs(cell.energy.value - 1.0); }},
      {"error", "error", "root of the MSE over the mean of the truth, where it is largest", kDigits,
       "root of the MSE / mean of the truth", true,
       [](const SweptCell& cell) { return cell.error; },
       [](const SweptCell& cell) { return cell.error.value; }},
      {"bias_share", "bias^2 / MSE, %",
       "share of the squared bias in the MSE, where the lower end of its interval is highest; "
       "negative by noise alone",
       kDigits, nullptr, false, [](const SweptCell& cell) { return percent(cell.biasShare); },
       [](const SweptCell& cell) {
         return std::isnan(cell.biasShare.lo) ? cell.biasShare.value : cell.biasShare.lo;
       }},
      {"time", "time, ms", "median of a frame, where it is longest", kDigits, "time per frame, ms",
       true,
       [](const SweptCell& cell) {
         return Interval{cell.timeMs, kUnknown, kUnknown};
       },
       [](const SweptCell& cell) { return cell.timeMs; }},
  };
  return all;
}

// Returns whether any cell has the figure: without timing, for example, no cell has a time.
bool isKnown(const SceneSweep& sweep, const SweepColumn& column) {
  for (size_t m = 0; m < sweep.methods.size(); ++m)
    if (worstOf(sweep, m, column.distance).cell) return true;
  return false;
}

uint64_t faultsOf(const SceneSweep& sweep, size_t method) {
  uint64_t faults = 0;
  for (const SweptCell& cell : sweep.cells[method]) faults += cell.faults;
  return faults;
}

std::string worstText(const SceneSweep& sweep, size_t method, const SweepColumn& column) {
  const Worst worst = worstOf(sweep, method, column.distance);
  if (!worst.cell) return "unknown";
  return fmt::format("{} at {}", withEnds(column.value(*worst.cell), column.digits),
                     sweep.parameter.texts[worst.value]);
}

// Returns the text for a method without a last value that holds.
std::string noLastText(const SceneSweep& sweep, size_t method) {
  for (size_t i = 0; i < sweep.blocks.size(); ++i)
    if (sweep.blocks[i] && sweep.cells[method][i].holding == Holding::no) return "none";
  return "not decided";
}

std::string lastText(const SceneSweep& sweep, size_t method) {
  const std::optional<size_t> last = sweep.lastThatHolds(method);
  return last ? sweep.parameter.texts[*last] : noLastText(sweep, method);
}

std::string valuesText(const SceneSweep& sweep) {
  std::string values;
  for (size_t i = 0; i < sweep.blocks.size(); ++i) {
    if (sweep.blocks[i])
      values += fmt::format("{}{}", values.empty() ? "" : ", ", sweep.parameter.texts[i]);
  }
  return fmt::format("Values of {}: {}.", sweep.parameter.name, values);
}

std::string whatHolds(const Suite& suite) {
  return fmt::format(
      "A value holds where every value of the images is finite and the 95 % interval of the energy "
      "ratio touches 1 within {:g} (`holds_within`) and lies within {:g} of it; where it only "
      "touches, it is not decided. The last that holds is counted from the first on.",
      suite.holdsWithin, kWidestTolerances * suite.holdsWithin);
}

// Describes a value at which a method does not hold or is not decided; "" if it holds.
std::string doubtOf(const SceneSweep& sweep, size_t method, size_t value) {
  const SweptCell& cell = sweep.cells[method][value];
  if (!sweep.blocks[value] || cell.holding == Holding::yes) return "";
  const std::string why =
      cell.nonfinite > 0 ? fmt::format("not known: {} not finite", counted(cell.nonfinite, "value"))
      : std::isnan(cell.energy.value) ? std::string("not known")
                                      : withEnds(cell.energy, kEnergyDigits);
  return fmt::format("{} at {} = {}, energy {}",
                     cell.holding == Holding::no ? "does not hold" : "is not decided",
                     sweep.parameter.name, sweep.parameter.texts[value], why);
}

// Plots all methods over the values, in ascending order.
Json plotOf(const SceneSweep& sweep, const SweepColumn& column) {
  const std::vector<double>& values = sweep.parameter.values;
  std::vector<size_t> order(values.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  const SweptAxis axis = sweptAxis(values, 1.0);
  Json series = Json::array();
  for (size_t m = 0; m < sweep.methods.size(); ++m) {
    Json points = Json::array();
    for (const size_t i : order) {
      if (!sweep.blocks[i]) continue;
      const Interval of = column.value(sweep.cells[m][i]);
      points.push_back(
          {axis.at(values[i]), finiteJson(of.value), finiteJson(of.lo), finiteJson(of.hi)});
    }
    series.push_back({{"name", sweep.methods[m]}, {"points", std::move(points)}});
  }
  return {{"id", column.key},
          {"title",
           fmt::format("{} over {}, {}", column.key, sweep.parameter.name, sweep.parameter.scene)},
          {"x", axis.document(sweep.parameter.name)},
          {"y", {{"title", column.yTitle}, {"log", column.isLogY}}},
          {"series", std::move(series)}};
}

Json plotsOf(const SceneSweep& sweep) {
  Json plots = Json::array();
  for (const SweepColumn& column : sweepColumns())
    if (column.yTitle && isKnown(sweep, column)) plots.push_back(plotOf(sweep, column));
  return plots;
}

Json columnJson(const std::string& key, const std::string& title, const std::string& help,
                int digits, bool isDetail) {
  return {{"key", key},         {"title", title},   {"unit", ""},  {"better", "none"},
          {"detail", isDetail}, {"digits", digits}, {"help", help}};
}

Json cellJson(const Interval& of) {
  return {{"value", finiteJson(of.value)}, {"lo", finiteJson(of.lo)}, {"hi", finiteJson(of.hi)}};
}

// Returns the columns of `sweepDocument`, in the order in which they are shown.
Json columnsOf(const SceneSweep& sweep) {
  Json columns = Json::array();
  columns.push_back(columnJson("last", "last " + sweep.parameter.name + " that holds",
                               whatHolds(*sweep.suite), kEnergyDigits, false));
  for (const SweepColumn& column : sweepColumns()) {
    if (isKnown(sweep, column))
      columns.push_back(columnJson(column.key, column.title, column.help, column.digits, false));
  }
  columns.push_back(columnJson("faults", "faults",
                               "counts of health that are faults, of all values", kDigits, true));
  for (size_t i = 0; i < sweep.blocks.size(); ++i) {
    if (!sweep.blocks[i]) continue;
    const std::string& text = sweep.parameter.texts[i];
    columns.push_back(columnJson(fmt::format("value{}", i), text,
                                 fmt::format("energy ratio at {} = {}", sweep.parameter.name, text),
                                 kEnergyDigits, true));
  }
  return columns;
}

Json rowOf(const SceneSweep& sweep, size_t method) {
  Json cells = Json::object(), flags = Json::array();
  const std::optional<size_t> last = sweep.lastThatHolds(method);
  if (last) {
    cells["last"] = {{"value", sweep.parameter.values[*last]}};
  } else {
    flags.push_back(
        fmt::format("last {} that holds: {}", sweep.parameter.name, noLastText(sweep, method)));
  }
  for (const SweepColumn& column : sweepColumns()) {
    const Worst worst = worstOf(sweep, method, column.distance);
    if (!worst.cell) continue;
    cells[column.key] = cellJson(column.value(*worst.cell));
    cells[column.key]["note"] = "at " + sweep.parameter.texts[worst.value];
  }
  cells["faults"] = {{"value", faultsOf(sweep, method)}};
  for (size_t i = 0; i < sweep.blocks.size(); ++i) {
    if (!sweep.blocks[i]) continue;
    const SweptCell& cell = sweep.cells[method][i];
    cells[fmt::format("value{}", i)] = cellJson(cell.energy);
    const std::string doubt = doubtOf(sweep, method, i);
    if (!doubt.empty()) flags.push_back(doubt);
  }
  return {{"method", sweep.methods[method]},
          {"counts", true},
          {"flags", std::move(flags)},
          {"cells", std::move(cells)}};
}

}  // namespace

std::string sweepTables(const std::vector<SceneSweep>& sweeps) {
  if (sweeps.empty()) return "";
  std::string text =
      fmt::format("In tables of sweeps every figure is of the value where it is worst. {}\n\n",
                  whatHolds(*sweeps.front().suite));
  for (const SceneSweep& sweep : sweeps) text += sweepTable(sweep);
  return text;
}

std::string sweepTable(const SceneSweep& sweep) {
  std::string text =
      fmt::format("## {}\n\n{}\n\n| method | last that holds |", sweep.title, valuesText(sweep));
  std::string rule = "|---|---|";
  for (const SweepColumn& column : sweepColumns()) {
    if (!isKnown(sweep, column)) continue;
    text += fmt::format(" {} |", column.title);
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (size_t m = 0; m < sweep.methods.size(); ++m) {
    text += fmt::format("| {} | {} |", sweep.methods[m], lastText(sweep, m));
    for (const SweepColumn& column : sweepColumns())
      if (isKnown(sweep, column)) text += fmt::format(" {} |", worstText(sweep, m, column));
    text += "\n";
  }
  text += "\n";
  // Merge equal notes of several methods.
  std::vector<std::pair<std::string, std::string>> said;
  const auto say = [&](const std::string& what, const std::string& method) {
    const auto same = std::find_if(said.begin(), said.end(),
                                   [&](const auto& other) { return other.first == what; });
    if (same == said.end()) {
      said.emplace_back(what, method);
    } else {
      same->second += "; " + method;
    }
  };
  for (size_t m = 0; m < sweep.methods.size(); ++m) {
    if (const uint64_t faults = faultsOf(sweep, m))
      say(counted(faults, "fault") + " of health", sweep.methods[m]);
    for (size_t i = 0; i < sweep.blocks.size(); ++i) {
      const std::string doubt = doubtOf(sweep, m, i);
      if (!doubt.empty()) say(doubt, sweep.methods[m]);
    }
  }
  for (const auto& [what, methods] : said) text += fmt::format("- {}: {}\n", what, methods);
  return text + "\n";
}

Json sweepDocument(const SceneSweep& sweep) {
  Json rows = Json::array();
  for (size_t m = 0; m < sweep.methods.size(); ++m) rows.push_back(rowOf(sweep, m));
  return {{"id", sweep.id},
          {"title", sweep.title},
          {"subtitle", valuesText(sweep) + " Every figure is of the value where it is worst."},
          {"columns", columnsOf(sweep)},
          {"rows", std::move(rows)},
          {"plots", plotsOf(sweep)}};
}

}  // namespace restlab
