// restlab list: what there is to choose from.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/backend/backend.h"
#include "core/cache.h"
#include "core/image/metrics.h"
#include "core/radiance/settings.h"
#include "core/denoiser.h"
#include "experiments/cli/verbs.h"
#include "core/changes/settings.h"
#include "experiments/runner/run/files.h"
#include "experiments/runner/run/prepare.h"
#include "experiments/runner/summary/summary.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKinds = "integrators, caches, backends, denoisers, metrics or scenes";

struct ListOptions {
  std::string what;
  bool json = false;
};

Json parameterJson(const ParameterInfo& parameter) {
  Json json = {{"name", parameter.name}};
  std::visit([&](const auto& value) { json["default"] = value; }, parameter.defaultValue);
  if (parameter.defaultValue.index() == 1 || parameter.defaultValue.index() == 2) {
    json["range"] = {parameter.minValue, parameter.maxValue};
  }
  if (!parameter.choices.empty()) json["choices"] = parameter.choices;
  json["help"] = parameter.help;
  json["source"] = parameter.source;
  return json;
}

Json parametersJson(const PartInfo& part) {
  Json parameters = Json::array();
  for (const ParameterInfo& parameter : part.parameters)
    parameters.push_back(parameterJson(parameter));
  if (!asksForChanges(part)) return parameters;
  // Those of a part that comes with it, with the defaults that it gives them.
  for (ParameterInfo parameter : changesPartInfo().parameters) {
    const auto changed = part.defaults.find(parameter.name);
    if (changed != part.defaults.end()) parameter.defaultValue = changed->second;
    parameters.push_back(parameterJson(parameter));
  }
  return parameters;
}

Json layersJson(const PartInfo& part) {
  Json layers = Json::array();
  for (const LayerInfo& layer : part.layers) {
    layers.push_back({{"name", layer.name}, {"unit", layer.unit}, {"help", layer.summary}});
    if (layer.onlyWith.parameter != nullptr) layers.back()["only_with"] = layer.onlyWith.parameter;
  }
  return layers;
}

Json integrators() {
  Json all = Json::array();
  for (const IntegratorInfo* info : integratorRegistry()) {
    Json modes = Json::array();
    for (const ModeInfo& mode : info->modes) {
      modes.push_back({{"name", mode.name}, {"bias", biasName(mode.bias)}, {"why", mode.why}});
    }
    Json parameters = parametersJson(*info);
    if (info->endsPaths) {
      for (Json& parameter : parametersJson(radiancePartInfo()))
        parameters.push_back(std::move(parameter));
    }
    all.push_back({{"name", info->name},
                   {"summary", info->summary},
                   {"uses_cache", info->usesCache},
                   {"modes", modes},
                   {"parameters", parameters},
                   {"layers", layersJson(*info)}});
  }
  return all;
}

Json caches() {
  Json all = Json::array();
  for (const CacheInfo* cache : cacheRegistry()) {
    all.push_back({{"name", cache->name},
                   {"summary", cache->summary},
                   {"parameters", parametersJson(*cache)},
                   {"layers", layersJson(*cache)}});
  }
  return all;
}

Json backends() {
  Json all = Json::array();
  for (const BackendInfo& backend : backendRegistry()) {
    Json json = {
        {"name", backend.name}, {"summary", backend.description}, {"available", backend.available}};
    json["devices"] = backend.devices;
    if (!backend.available) json["why_not"] = backend.whyNot;
    all.push_back(json);
  }
  return all;
}

Json denoisers() {
  Json all = Json::array();
  for (const DenoiserInfo* denoiser : denoiserRegistry()) {
    all.push_back({{"name", denoiser->name},
                   {"summary", denoiser->summary},
                   {"available", true},
                   {"bias_still", biasName(denoiser->biasOfStillView)},
                   {"bias_moving", biasName(denoiser->biasOfMovingView)},
                   {"why", denoiser->why},
                   {"parameters", parametersJson(*denoiser)}});
  }
  for (const MissingDenoiser& missing : missingDenoisers()) {
    all.push_back({{"name", missing.name},
                   {"summary", missing.summary},
                   {"available", false},
                   {"why_not", missing.whyNot}});
  }
  return all;
}

Json metrics() {
  Json all = Json::array();
  for (const MetricInfo& metric : metricRegistry()) {
    all.push_back({{"name", metric.name},
                   {"summary", metric.formula},
                   {"higher_is_better", metric.higherIsBetter},
                   {"needs_runs", metric.needsRuns}});
  }
  return all;
}

// glTF files under the folder of scenes of others, by their path inside it.
std::vector<std::string> scenesOfOthers() {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  const fs::path folder = sceneFolder();
  if (folder.empty()) return names;
  std::error_code status;
  for (fs::recursive_directory_iterator it(folder, status), end; !status && it != end;
       it.increment(status)) {
    const std::string extension = it->path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    const std::string name = fs::relative(it->path(), folder).string();
    if (name.rfind("bad-", 0) != 0) names.push_back(name);  // broken files, kept for tests
  }
  std::sort(names.begin(), names.end());
  return names;
}

Json scenes() {
  Json all = Json::array();
  for (const std::string& name : builtinSceneNames()) {
    all.push_back({{"name", name}, {"summary", builtinSceneSummary(name)}, {"kind", "built-in"}});
  }
  for (const std::string& name : scenesOfOthers()) {
    all.push_back({{"name", name}, {"summary", "file"}, {"kind", "file"}});
  }
  return all;
}

void printDetails(const Json& part) {
  if (part.contains("why")) {
    fmt::print("  {} in a still view, {} in a moving one: {}\n",
               part["bias_still"].get<std::string>(), part["bias_moving"].get<std::string>(),
               part["why"].get<std::string>());
  }
  for (const Json& mode : part.value("modes", Json::array())) {
    fmt::print("  mode {:<12} {}: {}\n", mode["name"].get<std::string>(),
               mode["bias"].get<std::string>(), mode["why"].get<std::string>());
  }
  for (const Json& parameter : part["parameters"]) {
    std::string bounds;
    if (parameter.contains("range")) {
      bounds = fmt::format(" in {:.9g}..{:.9g}", parameter["range"][0].get<double>(),
                           parameter["range"][1].get<double>());
    } else if (parameter.contains("choices")) {
      bounds = " of " + parameter["choices"].dump();
    }
    fmt::print("  {} = {}{}\n      {}\n      source: {}\n", parameter["name"].get<std::string>(),
               parameter["default"].dump(), bounds, parameter["help"].get<std::string>(),
               parameter["source"].get<std::string>());
  }
  for (const Json& layer : part.value("layers", Json::array())) {
    const std::string unit = layer["unit"], with = layer.value("only_with", "");
    fmt::print("  layer {}{}: {}{}\n", layer["name"].get<std::string>(),
               unit.empty() ? "" : " in " + unit, layer["help"].get<std::string>(),
               with.empty() ? "" : fmt::format("; only of methods with the parameter {}", with));
  }
}

void list(const ListOptions& options) {
  const std::vector<std::pair<std::string, Json (*)()>> kinds = {
      {"integrators", integrators}, {"caches", caches},   {"backends", backends},
      {"denoisers", denoisers},     {"metrics", metrics}, {"scenes", scenes}};
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const auto& entry) { return entry.first == options.what; });
  if (kind == kinds.end()) {
    std::vector<std::string> names;
    for (const auto& entry : kinds) names.push_back(entry.first);
    const std::string known = fmt::format("{}", fmt::join(names, ", "));
    if (options.what.empty()) failUsage("list: say what: " + known);
    failUsage(fmt::format("list {}: unknown kind (known: {}){}", options.what, known,
                          didYouMean(options.what, names)));
  }
  const Json all = kind->second();
  if (options.json) {
    fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
    return;
  }
  size_t width = 0;
  for (const Json& item : all) width = std::max(width, item["name"].get<std::string>().size());
  for (const Json& item : all) {
    fmt::print("{:<{}}  {}", item["name"].get<std::string>(), width,
               item["summary"].get<std::string>());
    if (item.contains("why_not"))
      fmt::print(" (not available: {})", item["why_not"].get<std::string>());
    fmt::print("\n");
    if (item.contains("devices")) {
      for (const Json& device : item["devices"])
        fmt::print("{:<{}}    {}\n", "", width, device.get<std::string>());
    }
    if (item.contains("parameters")) printDetails(item);
  }
}

}  // namespace

Action addListVerb(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* verb = app.add_subcommand("list", kKinds);
  verb->add_option("what", options->what, kKinds);
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options](Outcome&) { list(*options); };
}

}  // namespace restlab
