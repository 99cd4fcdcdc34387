#include "experiments/runner/summary/scene_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/report/text.h"
#include "experiments/runner/run/files.h"
#include "experiments/runner/run/run_record.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

double rootOf(double square, double mean) {
  return square > 0.0 ? std::sqrt(square) / mean : std::isnan(square) ? kUnknown : 0.0;
}

SweptCell cellOf(const MethodSummary& row, double referenceMean) {
  SweptCell cell;
  cell.energy = row.energyRatio;
  cell.nonfinite = row.nonfinite;
  cell.holds = holds(cell.energy, cell.nonfinite, row.suite->holdsWithin);
  // A mean error that its noise has made negative is none.
  if (row.mse.value > 0.0 && referenceMean > 0.0) {
    cell.error = {rootOf(row.mse.value, referenceMean), rootOf(row.mse.lo, referenceMean),
                  rootOf(row.mse.hi, referenceMean)};
  }
  return cell;
}

const SuiteScene* sceneOf(const SweptBlock& block) {
  const std::string& name = block.rows->front().block->scene;
  for (const SuiteScene& scene : block.suite->scenes) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

// All scenes of the sweep, also those that are not there yet.
SceneSweep emptySweep(const SweptBlock& block, const SuiteScene& scene) {
  SceneSweep sweep;
  sweep.suite = block.suite;
  std::vector<std::string> names;
  for (const SuiteScene& other : block.suite->scenes) {
    if (other.sweep == scene.sweep) names.push_back(other.request.scene);
  }
  // Fewer by --scenes: what is left may differ in nothing.
  if (names.size() < 2) return sweep;
  sweep.parameter = sweptParameter(names);
  const std::string component = componentName(block.rows->front().block->component);
  const std::string& point = block.suite->point;
  sweep.title = fmt::format("{}{}, {} of {}, {} light{}, {}", scene.sweepName,
                            scene.sweepName.empty() ? "sweep" : "", sweep.parameter.name,
                            sweep.parameter.scene, component, point.empty() ? "" : ", " + point,
                            counted(block.suite->maxBounces, "scattering event"));
  sweep.id = safeFileName(fmt::format("sweep-{}-{}-{}{}", scene.sweep, sweep.parameter.name,
                                      component, point.empty() ? "" : "-" + point));
  for (const MethodSummary& row : *block.rows) sweep.methods.push_back(row.method->name);
  sweep.cells.assign(sweep.methods.size(), std::vector<SweptCell>(names.size()));
  sweep.isThere.assign(names.size(), false);
  return sweep;
}

std::string cellText(const SweptCell& cell) {
  if (cell.nonfinite > 0) return fmt::format("{} not finite: no", cell.nonfinite);
  return shortNumber(cell.energy.value, kEnergyDigits) +
         intervalText(cell.energy.lo, cell.energy.hi, kEnergyDigits) + (cell.holds ? "" : ": no");
}

std::string lastText(const SceneSweep& sweep, size_t method) {
  const std::optional<size_t> last = sweep.lastThatHolds(method);
  return last ? sweep.parameter.texts[*last] : "none";
}

std::string explanation(const SceneSweep& sweep) {
  return fmt::format(
      "A value holds where every value of the images is finite and the 95 % interval of the energy "
      "ratio touches 1 within {:g} (`holds_within`). The last that holds is counted from the first "
      "line on.",
      sweep.suite->holdsWithin);
}

Json errorPlot(const SceneSweep& sweep) {
  const std::vector<double>& values = sweep.parameter.values;
  std::vector<size_t> order(values.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  Json series = Json::array();
  for (size_t m = 0; m < sweep.methods.size(); ++m) {
    Json points = Json::array();
    for (const size_t i : order) {
      if (!sweep.isThere[i]) continue;
      const Interval& error = sweep.cells[m][i].error;
      points.push_back(
          {values[i], finiteJson(error.value), finiteJson(error.lo), finiteJson(error.hi)});
    }
    series.push_back({{"name", sweep.methods[m]}, {"points", std::move(points)}});
  }
  const bool isLog =
      std::all_of(values.begin(), values.end(), [](double value) { return value > 0.0; });
  return {{"id", "error"},
          {"title", "error over " + sweep.parameter.name + ", " + sweep.parameter.scene},
          {"x", {{"title", sweep.parameter.name}, {"log", isLog}}},
          {"y", {{"title", "root of the MSE / mean of the truth"}, {"log", true}}},
          {"series", std::move(series)}};
}

}  // namespace

bool isFarOff(const Interval& energy, double within) {
  const double halfWidth = 0.5 * (energy.hi - energy.lo);
  return std::abs(energy.value - 1.0) - within > 3.0 * halfWidth;  // false for NaN
}

bool holds(const Interval& energy, uint64_t nonfinite, double within) {
  if (nonfinite > 0 || std::isnan(energy.value)) return false;
  const double lo = std::isnan(energy.lo) ? energy.value : energy.lo;
  const double hi = std::isnan(energy.hi) ? energy.value : energy.hi;
  return lo <= 1.0 + within && hi >= 1.0 - within;
}

std::optional<size_t> SceneSweep::lastThatHolds(size_t method) const {
  std::optional<size_t> last;
  for (size_t i = 0; i < parameter.values.size(); ++i) {
    if (!isThere[i]) continue;
    if (!cells[method][i].holds) break;
    last = i;
  }
  return last;
}

std::vector<SceneSweep> sceneSweeps(const std::vector<SweptBlock>& blocks) {
  std::vector<SceneSweep> sweeps;
  for (const SweptBlock& block : blocks) {
    if (block.rows->empty()) continue;
    const SuiteScene* scene = sceneOf(block);
    if (!scene || scene->sweep == 0) continue;
    SceneSweep own = emptySweep(block, *scene);
    if (own.id.empty()) continue;
    auto found = std::find_if(sweeps.begin(), sweeps.end(),
                              [&](const SceneSweep& other) { return other.id == own.id; });
    if (found == sweeps.end()) found = sweeps.insert(sweeps.end(), std::move(own));
    SceneSweep& sweep = *found;
    size_t value = 0;
    for (const SuiteScene& other : block.suite->scenes) {
      if (other.sweep != scene->sweep) continue;
      if (other.name == scene->name) break;
      ++value;
    }
    sweep.isThere[value] = true;
    for (const MethodSummary& row : *block.rows) {
      const auto method = std::find(sweep.methods.begin(), sweep.methods.end(), row.method->name);
      if (method != sweep.methods.end())
        sweep.cells[size_t(method - sweep.methods.begin())][value] =
            cellOf(row, block.referenceMean);
    }
  }
  return sweeps;
}

std::string sweepTable(const SceneSweep& sweep) {
  std::string text =
      fmt::format("## {}\n\n{}\n\n| {} |", sweep.title, explanation(sweep), sweep.parameter.name);
  std::string rule = "|---|";
  for (const std::string& method : sweep.methods) {
    text += fmt::format(" {} |", method);
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (size_t i = 0; i < sweep.parameter.values.size(); ++i) {
    if (!sweep.isThere[i]) continue;
    text += fmt::format("| {} |", sweep.parameter.texts[i]);
    for (size_t m = 0; m < sweep.methods.size(); ++m)
      text += fmt::format(" {} |", cellText(sweep.cells[m][i]));
    text += "\n";
  }
  text += "| last that holds |";
  for (size_t m = 0; m < sweep.methods.size(); ++m)
    text += fmt::format(" {} |", lastText(sweep, m));
  return text + "\n\n";
}

Json sweepDocument(const SceneSweep& sweep) {
  Json columns = Json::array(), rows = Json::array();
  columns.push_back({{"key", "last"},
                     {"title", "last " + sweep.parameter.name + " that holds"},
                     {"unit", ""},
                     {"better", "none"},
                     {"detail", false},
                     {"digits", kEnergyDigits},
                     {"help", "counted from the first value on; none: not even that"}});
  for (size_t i = 0; i < sweep.parameter.values.size(); ++i) {
    if (!sweep.isThere[i]) continue;
    columns.push_back({{"key", fmt::format("value{}", i)},
                       {"title", sweep.parameter.texts[i]},
                       {"unit", ""},
                       {"better", "none"},
                       {"detail", false},
                       {"digits", kEnergyDigits},
                       {"help", fmt::format("energy ratio at {} = {}", sweep.parameter.name,
                                            sweep.parameter.texts[i])}});
  }
  for (size_t m = 0; m < sweep.methods.size(); ++m) {
    Json cells = Json::object(), flags = Json::array();
    const std::optional<size_t> last = sweep.lastThatHolds(m);
    if (last) {
      cells["last"] = {{"value", sweep.parameter.values[*last]}};
    } else {
      flags.push_back("holds at none of the values");
    }
    for (size_t i = 0; i < sweep.parameter.values.size(); ++i) {
      if (!sweep.isThere[i]) continue;
      const SweptCell& cell = sweep.cells[m][i];
      cells[fmt::format("value{}", i)] = {{"value", finiteJson(cell.energy.value)},
                                          {"lo", finiteJson(cell.energy.lo)},
                                          {"hi", finiteJson(cell.energy.hi)}};
      if (cell.holds) continue;
      flags.push_back(fmt::format("does not hold at {} = {}: {}", sweep.parameter.name,
                                  sweep.parameter.texts[i], cellText(cell)));
    }
    rows.push_back({{"method", sweep.methods[m]},
                    {"counts", true},
                    {"flags", std::move(flags)},
                    {"cells", std::move(cells)}});
  }
  return {{"id", sweep.id},
          {"title", sweep.title},
          {"subtitle", explanation(sweep)},
          {"columns", std::move(columns)},
          {"rows", std::move(rows)},
          {"plots", Json::array({errorPlot(sweep)})}};
}

}  // namespace restlab
