#include "experiments/runner/tables/scene_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/report/text.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

double rootOf(double square, double mean) {
  return square > 0.0 ? std::sqrt(square) / mean : std::isnan(square) ? kUnknown : 0.0;
}

SweptCell cellOf(const MethodSummary& row, double referenceMean) {
  SweptCell cell;
  cell.energy = row.energyRatio;
  cell.nonfinite = row.nonfinite;
  cell.holding = holds(cell.energy, cell.nonfinite, row.suite->holdsWithin);
  cell.biasShare = row.biasShare;
  cell.timeMs = row.timeMsMedian;
  for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i)
    if (isFault(i)) cell.faults += row.health.health.counts[i];
  // Leave a negative mean error unknown: it is below the reference's noise.
  if (row.mse.value >= 0.0 && referenceMean > 0.0) {
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

// Creates cells for all scenes of the sweep, including those not rendered yet.
SceneSweep emptySweep(const SweptBlock& block, const SuiteScene& scene) {
  SceneSweep sweep;
  sweep.suite = block.suite;
  std::vector<std::string> names;
  for (const SuiteScene& other : block.suite->scenes) {
    if (other.sweep == scene.sweep) names.push_back(other.request.scene);
  }
  // Skip a sweep that --scenes has reduced to one scene.
  if (names.size() < 2) return sweep;
  sweep.parameter = sweptParameter(names);
  const std::string component = componentName(block.rows->front().block->component);
  const std::string& point = block.suite->point;
  sweep.title = fmt::format("{}{}, {} of {}, {} light{}, {}", scene.sweepName,
                            scene.sweepName.empty() ? "sweep" : "", sweep.parameter.name,
                            sweep.parameter.scene, component, point.empty() ? "" : ", " + point,
                            counted(block.suite->maxBounces, "scattering event"));
  sweep.id = plainId(safeFileName(fmt::format("sweep-{}-{}-{}{}", scene.sweep, sweep.parameter.name,
                                              component, point.empty() ? "" : "-" + point)));
  for (const MethodSummary& row : *block.rows) sweep.methods.push_back(row.method->name);
  sweep.cells.assign(sweep.methods.size(), std::vector<SweptCell>(names.size()));
  sweep.blocks.resize(names.size());
  return sweep;
}

}  // namespace

bool isFarOff(const Interval& energy, double within) {
  const double halfWidth = 0.5 * (energy.hi - energy.lo);
  return std::abs(energy.value - 1.0) - within > 3.0 * halfWidth;  // false for NaN
}

Holding holds(const Interval& energy, uint64_t nonfinite, double within) {
  if (nonfinite > 0 || std::isnan(energy.value)) return Holding::no;
  if (energy.lo > 1.0 + within || energy.hi < 1.0 - within) return Holding::no;
  // False for an unknown interval.
  const double widest = kWidestTolerances * within;
  const bool isNear = energy.lo >= 1.0 - widest && energy.hi <= 1.0 + widest;
  return isNear ? Holding::yes : Holding::notDecided;
}

std::optional<size_t> SceneSweep::lastThatHolds(size_t method) const {
  std::optional<size_t> last;
  for (size_t i = 0; i < parameter.values.size(); ++i) {
    if (!blocks[i]) continue;
    if (cells[method][i].holding == Holding::no) break;
    if (cells[method][i].holding == Holding::yes) last = i;
  }
  return last;
}

std::vector<SceneSweep> sceneSweeps(const std::vector<SweptBlock>& blocks) {
  std::vector<SceneSweep> sweeps;
  for (size_t b = 0; b < blocks.size(); ++b) {
    const SweptBlock& block = blocks[b];
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
    sweep.blocks[value] = b;
    for (const MethodSummary& row : *block.rows) {
      const auto method = std::find(sweep.methods.begin(), sweep.methods.end(), row.method->name);
      if (method != sweep.methods.end())
        sweep.cells[size_t(method - sweep.methods.begin())][value] =
            cellOf(row, block.referenceMean);
    }
  }
  return sweeps;
}

}  // namespace restlab
