// Columns that say which row it is, and under which conditions its numbers hold.
#include <fmt/format.h>

#include "core/frame/method_settings.h"
#include "experiments/runner/base/bias_name.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/tables/column_groups.h"

namespace restlab {

namespace {

using Row = MethodSummary;

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
  return kernelChoiceName(method.session.kernels);
}

Column settingColumn(size_t index, const MethodSetting& setting) {
  return {
      .key = setting.key,
      .get = [index](const Row& row) { return settingValues(row.method->session)[index].second; },
      .help = std::string("the method's ") + setting.key};
}

Column transportColumn(size_t index, const ParameterInfo& info) {
  return {.key = info.name,
          .get = [index](const Row& row) { return transportTexts(*row.suite)[index].second; },
          .help = info.help};
}

}  // namespace

Columns identityColumns() {
  Columns all = {{.key = "scene",
                  .get = [](const Row& row) { return row.block->scene; },
                  .help = "name in the suite"},
                 {.key = "camera",
                  .get = [](const Row& row) { return row.block->camera; },
                  .help = "name or index of the camera"},
                 {.key = "width",
                  .get = [](const Row& row) { return uint64_t(row.block->width); },
                  .help = "pixels"},
                 {.key = "height",
                  .get = [](const Row& row) { return uint64_t(row.block->height); },
                  .help = "pixels"},
                 {.key = "frames",
                  .get = [](const Row& row) { return uint64_t(row.suite->timedFrames); },
                  .help = "timed frames of a run"},
                 {.key = "runs",
                  .get = [](const Row& row) { return uint64_t(row.runs); },
                  .help = "finished runs"},
                 {.key = "nonfinite",
                  .get = [](const Row& row) { return row.nonfinite; },
                  .help = "non-finite channel values of measured frames, and sample values set to "
                          "zero in timed ones"},
                 {.key = "features_left_out",
                  .get = [](const Row& row) { return row.result->featuresLeftOut; },
                  .help = "scene features that the kernels leave out"},
                 {.key = "component",
                  .get = [](const Row& row) { return componentName(row.block->component); },
                  .help = "light that is rendered and measured"},
                 {.key = "method",
                  .get = [](const Row& row) { return row.method->name; },
                  .help = "name in the suite"},
                 {.key = "bias_class",
                  .get = [](const Row& row) { return std::string(biasName(row.bias)); },
                  .help = "what the method declares for this view: unbiased, consistent or biased"},
                 {.key = "counts",
                  .get = [](const Row& row) { return uint64_t(row.counts); },
                  .help = "0: the row does not count in comparisons"},
                 {.key = "flags",
                  .get = flagsText,
                  .help = "why a row does not count, and what its numbers lack"}};
  const std::vector<MethodSetting>& settings = methodSettings();
  for (size_t i = 0; i < settings.size(); ++i) all.push_back(settingColumn(i, settings[i]));
  return all;
}

Columns conditionColumns() {
  Columns all;
  const std::vector<ParameterInfo> infos = transportSchema().infos();
  for (size_t i = 0; i < infos.size(); ++i) all.push_back(transportColumn(i, infos[i]));
  const Columns more = {
      {.key = "warmup_frames",
       .get = [](const Row& row) { return uint64_t(row.suite->warmupFrames); },
       .help = "frames before the measured one"},
      {.key = "seed",
       .get = [](const Row& row) { return uint64_t(row.suite->seed); },
       .help = "of run 0; run r has seed + r"},
      {.key = "kernel",
       .get = [](const Row& row) { return kernelName(*row.method); },
       .help = "exact for the scene, built-in, or general"},
      {.key = "reference_spp",
       .get = [](const Row& row) { return uint64_t(row.block->reference.spp); },
       .help = "samples per pixel of the reference"},
      {.key = "reference_relmse",
       .get = [](const Row& row) { return only(row.block->reference.relmse); },
       .help = "its own error, estimated from its halves"},
      {.key = "device",
       .get = [](const Row& row) { return row.result->use.device; },
       .help = "device that ran the kernels"},
      {.key = "ray_tracing",
       .get = [](const Row& row) { return row.result->use.rayTracing; },
       .help = "what traced the rays"},
      {.key = "startup_ms",
       .get = [](const Row& row) { return only(row.result->startupMs); },
       .unit = "ms",
       .help = "making the kernels ready; a shared kernel counts with the first method"},
      {.key = "code_bytes",
       .get = [](const Row& row) { return uint64_t(row.result->codeBytes); },
       .unit = "bytes",
       .help = "machine code of the kernels that were compiled for the scene; 0: all are built in"},
      {.key = "time_ratio_to_first_backend",
       .get = [](const Row& row) { return row.timeToFirstBackend; },
       .ends = Ends::all,
       .narrow = "time / {2}",
       .help = "as time_ratio, to the same method on the first backend"},
      {.key = "point",
       .get = [](const Row& row) { return row.suite->point; },
       .help = "the table's values of a sweep"},
      {.key = "parameters",
       .get = [](const Row& row) { return parametersText(*row.method); },
       .help = "all parameters of the method, defaults included"},
      {.key = "baseline",
       .get = [](const Row& row) { return nameAt(&Suite::baselineOf, row); },
       .help = "method that ratios are against"},
      {.key = "average",
       .get = [](const Row& row) { return nameAt(&Suite::average, row); },
       .help = "plain average of frames that ratios are against"}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Columns healthColumns() {
  Columns all;
  for (size_t i = 0; i < rl::RL_HEALTH_COUNT; ++i) {
    const char* name = Health::names()[i];
    if (!name || !*name) continue;
    all.push_back({.key = fmt::format("health_{}", name),
                   .get = [i](const Row& row) { return uint64_t(row.health.health.counts[i]); },
                   .help = Health::meanings()[i]});
  }
  return all;
}

}  // namespace restlab
