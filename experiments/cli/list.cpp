// restlab list: lists integrators, scenes and other choices.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "core/scene/scene_folders.h"
#include "core/scene/mitsuba/mitsuba.h"
#include "core/scene/scene_file/scene_file.h"
#include "experiments/cli/completion.h"
#include "experiments/cli/man_page.h"
#include "experiments/cli/reference_page.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/registries/registries.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKinds =
    "integrators, caches, backends, denoisers, metrics, closures, shapes, scenes, all "
    "(docs/reference.md), man or completion (of bash)";

struct ListOptions {
  std::string what;
  std::string folder;  // of the pages of `man`
  bool json = false;
};

// Returns scenes in the folders of downloaded and of installed scenes, by their path inside it.
std::vector<std::string> scenesOfOthers() {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const fs::path& folder : {sceneFolder(), installedScenes()}) {
    if (folder.empty()) continue;
    std::error_code status;
    for (fs::recursive_directory_iterator it(folder, status), end; !status && it != end;
         it.increment(status)) {
      const std::string extension = it->path().extension().string();
      if (extension != ".gltf" && extension != ".glb" && !isMitsubaScene(it->path()) &&
          !isSceneFile(it->path()))
        continue;
      const std::string name = fs::relative(it->path(), folder).string();
      if (name.rfind("bad-", 0) != 0) names.push_back(name);  // broken files for tests
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

Json scenes() {
  Json all = Json::array();
  for (const std::string& name : builtinSceneNames()) {
    Json parameters = Json::array();
    for (const SceneParameter& parameter : builtinSceneParameters(name)) {
      parameters.push_back({{"name", parameter.name},
                            {"default", parameter.fallback ? Json(*parameter.fallback) : Json()},
                            {"range", {parameter.lo, parameter.hi}},
                            {"choices", parameter.choices},
                            {"help", parameter.summary}});
    }
    all.push_back({{"name", name},
                   {"summary", builtinSceneSummary(name)},
                   {"kind", "built-in"},
                   {"parameters", std::move(parameters)}});
  }
  for (const std::string& name : scenesOfOthers()) {
    all.push_back({{"name", name}, {"summary", "file"}, {"kind", "file"}});
  }
  return all;
}

// Prints parameters after the '?' of a name: with an indent those of one scene, without one those
// that all scenes have.
void printSceneParameters(const Json& all, const Json& parameters, const char* indent) {
  for (const Json& parameter : parameters) {
    const bool isOfAll = std::all_of(all.begin(), all.end(), [&](const Json& scene) {
      if (!scene.contains("parameters")) return true;
      const Json& its = scene["parameters"];
      return std::find(its.begin(), its.end(), parameter) != its.end();
    });
    if (isOfAll != (*indent == '\0')) continue;
    if (!parameter["choices"].empty()) {
      const std::vector<std::string> choices = parameter["choices"];
      print("{}?{}={}: {}; one of {}\n", indent, parameter["name"].get<std::string>(),
            choices.front(), parameter["help"].get<std::string>(),
            fmt::format("{}", fmt::join(choices, ", ")));
      continue;
    }
    const std::string value =
        parameter["default"].is_null() ? "" : "=" + parameter["default"].dump();
    print("{}?{}{} in {:g}..{:g}: {}\n", indent, parameter["name"].get<std::string>(), value,
          parameter["range"][0].get<double>(), parameter["range"][1].get<double>(),
          parameter["help"].get<std::string>());
  }
}

void printDetails(const Json& part) {
  if (part.contains("why")) {
    print("  {} in a still view, {} in a moving one: {}\n", part["bias_still"].get<std::string>(),
          part["bias_moving"].get<std::string>(), part["why"].get<std::string>());
  }
  if (!part.value("breaks", Json::array()).empty()) {
    const std::vector<std::string> breaks = part["breaks"];
    print("  breaks {} where {}\n", fmt::format("{}", fmt::join(breaks, ", ")),
          part.value("breaks_where", "some parameters make it"));
  }
  for (const Json& mode : part.value("modes", Json::array())) {
    print("  mode {:<12} {}: {}\n", mode["name"].get<std::string>(),
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
    print("  {} = {}{}\n      {}\n", parameter["name"].get<std::string>(),
          parameter["default"].dump(), bounds, parameter["help"].get<std::string>());
    if (parameter.contains("source"))
      print("      source: {}\n", parameter["source"].get<std::string>());
  }
  for (const Json& layer : part.value("layers", Json::array())) {
    const std::string unit = layer["unit"], with = layer.value("only_with", "");
    print("  layer {}{}: {}{}\n", layer["name"].get<std::string>(),
          unit.empty() ? "" : " in " + unit, layer["help"].get<std::string>(),
          with.empty() ? "" : fmt::format("; only of methods with the parameter {}", with));
  }
}

void list(const CLI::App& app, const ListOptions& options) {
  if (options.what != "man" && !options.folder.empty())
    failUsage("list: --out is the folder of the pages of `list man`");
  if (options.what == "man") {
    if (options.folder.empty()) failUsage("list man: needs --out, the folder of the pages");
    return writeManPages(app, options.folder);
  }
  if (options.what == "all" && !options.json) return printText(referencePage(app));
  const std::vector<std::pair<std::string, Json (*)()>> kinds = {
      {"integrators", integratorsJson}, {"caches", cachesJson},   {"backends", backendsJson},
      {"denoisers", denoisersJson},     {"metrics", metricsJson}, {"closures", closuresJson},
      {"shapes", shapesJson},           {"scenes", scenes}};
  std::vector<std::string> names;
  for (const auto& entry : kinds) names.push_back(entry.first);
  names.insert(names.end(), {"all", "man", "completion"});
  if (options.what == "completion") return printText(bashCompletion(app, names));
  if (options.what == "all") {
    Json all = {{"settings", transportSettingsJson()}};
    for (const auto& [name, listed] : kinds) all[name] = listed();
    return printJsonText(all.dump(2, ' ', false, Json::error_handler_t::replace));
  }
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const auto& entry) { return entry.first == options.what; });
  if (kind == kinds.end()) {
    const std::string known = fmt::format("{}", fmt::join(names, ", "));
    if (options.what.empty()) failUsage("list: say what: " + known);
    failUsage(fmt::format("list {}: unknown kind (known: {}){}", options.what, known,
                          didYouMean(options.what, names)));
  }
  const Json all = kind->second();
  if (options.json) {
    printJsonText(all.dump(2, ' ', false, Json::error_handler_t::replace));
    return;
  }
  size_t width = 0;
  for (const Json& item : all) width = std::max(width, item["name"].get<std::string>().size());
  for (const Json& item : all) {
    print("{:<{}}  {}", item["name"].get<std::string>(), width, item["summary"].get<std::string>());
    if (item.contains("why_not")) print(" (not available: {})", item["why_not"].get<std::string>());
    print("\n");
    if (item.contains("devices")) {
      for (const Json& device : item["devices"])
        print("{:<{}}    {}\n", "", width, device.get<std::string>());
    }
    if (!item.contains("parameters")) continue;
    if (options.what == "scenes") {
      printSceneParameters(all, item["parameters"], "  ");
    } else {
      printDetails(item);
    }
  }
  if (options.what == "scenes") {
    print("of every built-in scene, as in 'furnace?albedo=0.9&scale=2^10':\n");
    printSceneParameters(all, all.front()["parameters"], "");
  }
}

}  // namespace

Action addListVerb(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* verb = app.add_subcommand("list", kKinds);
  verb->add_option("what", options->what, kKinds);
  verb->add_option("-o,--out", options->folder, "of man: the folder of the pages");
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [&app, options](Outcome&) { list(app, *options); };
}

}  // namespace restlab
