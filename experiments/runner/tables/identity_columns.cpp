// Columns that say which row it is, and under which conditions its numbers hold.
#include <fmt/format.h>

#include "core/frame/method_settings.h"
#include "experiments/runner/base/bias_name.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/tables/column_groups.h"

namespace restlab {

namespace {

using Row = MethodSummary;

std::string onOff(bool isOn) { return isOn ? "on" : "off"; }

std::string flagsText(const Row& row) { return fmt::format("{}", fmt::join(row.flags, "; ")); }

// Returns "confidence_cap=20 temporal=true": all parameters, defaults included.
std::string parametersText(const SuiteMethod& method) {
  std::string text;
  for (const auto& [key, value] : method.parameters())
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, parameterText(value));
  return text;
}

// Returns the method that the row's ratios are relative to; "" if there is none.
std::string nameAt(size_t (Suite::*of)(size_t) const, const Row& row) {
  const Suite& suite = *row.suite;
  const size_t found = (suite.*of)(size_t(row.method - suite.methods.data()));
  return found < suite.methods.size() ? suite.methods[found].name : "";
}

std::string kernelName(const SuiteMethod& method) {
  if (method.images) return "none";
  return method.session.specialise ? "specialised" : "general";
}

Column settingColumn(size_t index, const std::string& key) {
  return {.key = key, .get = [index](const Row& row) {
            return settingValues(row.method->session)[index].second;
          }};
}

}  // namespace

Columns identityColumns() {
  Columns all = {
      {.key = "scene", .get = [](const Row& row) { return row.block->scene; }},
      {.key = "camera", .get = [](const Row& row) { return row.block->camera; }},
      {.key = "width", .get = [](const Row& row) { return uint64_t(row.block->width); }},
      {.key = "height", .get = [](const Row& row) { return uint64_t(row.block->height); }},
      {.key = "frames", .get = [](const Row& row) { return uint64_t(row.suite->timedFrames); }},
      {.key = "runs", .get = [](const Row& row) { return uint64_t(row.runs); }},
      {.key = "nonfinite", .get = [](const Row& row) { return row.nonfinite; }},
      {.key = "features_left_out",
       .get = [](const Row& row) { return row.result->featuresLeftOut; }},
      {.key = "component",
       .get = [](const Row& row) { return componentName(row.block->component); }},
      {.key = "method", .get = [](const Row& row) { return row.method->name; }},
      {.key = "bias_class", .get = [](const Row& row) { return std::string(biasName(row.bias)); }},
      {.key = "counts", .get = [](const Row& row) { return uint64_t(row.counts); }},
      {.key = "flags", .get = flagsText}};
  const std::vector<MethodSetting>& settings = methodSettings();
  for (size_t i = 0; i < settings.size(); ++i) all.push_back(settingColumn(i, settings[i].key));
  return all;
}

Columns conditionColumns() {
  return {
      {.key = "max_bounces", .get = [](const Row& row) { return uint64_t(row.suite->maxBounces); }},
      {.key = "warmup_frames",
       .get = [](const Row& row) { return uint64_t(row.suite->warmupFrames); }},
      {.key = "russian_roulette",
       .get = [](const Row& row) { return onOff(row.suite->russianRoulette); }},
      {.key = "filter", .get = [](const Row& row) { return filterName(row.suite->pixelFilter); }},
      {.key = "multiscatter", .get = [](const Row& row) { return onOff(row.suite->multiscatter); }},
      {.key = "seed", .get = [](const Row& row) { return uint64_t(row.suite->seed); }},
      {.key = "kernel", .get = [](const Row& row) { return kernelName(*row.method); }},
      {.key = "reference_spp",
       .get = [](const Row& row) { return uint64_t(row.block->reference.spp); }},
      {.key = "reference_relmse",
       .get = [](const Row& row) { return only(row.block->reference.relmse); }},
      {.key = "device", .get = [](const Row& row) { return row.result->use.device; }},
      {.key = "ray_tracing", .get = [](const Row& row) { return row.result->use.rayTracing; }},
      {.key = "startup_ms",
       .get = [](const Row& row) { return only(row.result->startupMs); },
       .unit = "ms"},
      {.key = "time_ratio_to_first_backend",
       .get = [](const Row& row) { return row.timeToFirstBackend; },
       .ends = Ends::all,
       .narrow = "time / {2}"},
      {.key = "point", .get = [](const Row& row) { return row.suite->point; }},
      {.key = "parameters", .get = [](const Row& row) { return parametersText(*row.method); }},
      {.key = "baseline", .get = [](const Row& row) { return nameAt(&Suite::baselineOf, row); }},
      {.key = "average", .get = [](const Row& row) { return nameAt(&Suite::average, row); }}};
}

Columns healthColumns() {
  Columns all;
  for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i) {
    const char* name = Health::names()[i];
    if (!name || !*name) continue;
    all.push_back({.key = fmt::format("health_{}", name),
                   .get = [i](const Row& row) { return uint64_t(row.health.health.counts[i]); }});
  }
  return all;
}

}  // namespace restlab
