#include "experiments/cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "core/backend/backend.h"
#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/frame/cache.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

// Suggests the nearest name, else names that contain the word, else where to find all names.
std::string parametersLike(const std::string& key, const std::vector<std::string>& names) {
  if (names.empty()) return "; it has none";
  const std::string near = didYouMean(key, names);
  if (!near.empty()) return near;
  std::vector<std::string> like;
  for (const std::string& name : names)
    if (name.find(key) != std::string::npos) like.push_back(name);
  if (like.empty()) return "; restlab list integrators, caches and denoisers has all of them";
  return fmt::format("; it has {}", fmt::join(like, ", "));
}

}  // namespace

ParameterMap parseParameters(const std::vector<ParameterInfo>& known, const std::string& owner,
                             const std::vector<std::string>& given, const std::string& option) {
  std::vector<std::string> names;
  for (const ParameterInfo& parameter : known) names.push_back(parameter.name);
  ParameterMap parameters;
  for (const std::string& assignment : given) {
    const auto [key, value] = splitAssignment(assignment);
    const auto found = std::find(names.begin(), names.end(), key);
    if (found == names.end()) {
      failUsage(fmt::format("{} {}: {} has no parameter '{}'{}", option, assignment, owner, key,
                            parametersLike(key, names)));
    }
    parameters[key] =
        parseParameter(known[size_t(found - names.begin())], value, option + " " + assignment);
  }
  return parameters;
}

void applyBackend(const BackendChoice& choice, SessionConfig& config) {
  const std::vector<std::string>& backends = backendNames();
  if (std::find(backends.begin(), backends.end(), choice.backend) == backends.end()) {
    failUsage(fmt::format("--backend {}: unknown backend (known: {}){}", choice.backend,
                          fmt::join(backends, ", "), didYouMean(choice.backend, backends)));
  }
  const std::vector<std::string>& ways = rayTracingNames();
  if (!choice.rayTracing.empty() &&
      std::find(ways.begin(), ways.end(), choice.rayTracing) == ways.end()) {
    failUsage(fmt::format("--ray-tracing {}: unknown (known: {}){}", choice.rayTracing,
                          fmt::join(ways, ", "), didYouMean(choice.rayTracing, ways)));
  }
  if (choice.backend == "cpu" && !choice.device.empty()) {
    failUsage(
        fmt::format("--device {}: only the Vulkan backend has devices to choose from; add "
                    "--backend vulkan",
                    choice.device));
  }
  if (choice.backend == "cpu" && choice.validate)
    failUsage("--validate: is of the Vulkan backend; add --backend vulkan");
  config.backend = choice.backend;
  config.device = choice.device;
  config.rayTracing = choice.rayTracing;
  config.validate = choice.validate;
}

namespace {

// Parses all of `text` as a number; NaN if it is none.
double numberOf(const std::string& text) {
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isWhole = status == std::errc() && end == text.data() + text.size();
  return isWhole ? value : std::numeric_limits<double>::quiet_NaN();
}

// Number endings and their factors.
using Endings = std::vector<std::pair<std::string, double>>;
Endings endingsOf(const std::string& unit) {
  if (unit == "seconds") return {{"s", 1.0}, {"m", 60.0}, {"h", 3600.0}};
  if (unit == "degrees") return {{"deg", 1.0}};
  return {};
}

}  // namespace

CLI::Validator numberFrom(double lo, double hi, const std::string& unit) {
  const std::string range = fmt::format("from {:g} to {:g}", lo, hi);
  const std::string what = unit.empty() ? "number" : "number of " + unit;
  CLI::Validator validator(
      [=](std::string& text) {
        double value = numberOf(text);
        for (const auto& [ending, factor] : endingsOf(unit)) {
          if (text.size() > ending.size() && text.ends_with(ending) && std::isnan(value))
            value = factor * numberOf(text.substr(0, text.size() - ending.size()));
        }
        if (!(value >= lo && value <= hi))
          return fmt::format("'{}' is no {} {}", text, what, range);
        text = fmt::format("{}", value);
        return std::string();
      },
      range);
  return validator;
}

CLI::Validator wholeNumberFrom(uint64_t lo, uint64_t hi) {
  const std::string range = fmt::format("from {} to {}", lo, hi);
  return CLI::Validator(
      [=](std::string& text) {
        uint64_t whole = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), whole);
        if (status != std::errc() || end != text.data() + text.size()) {
          // Limit to 2^53: not every larger whole number is a double.
          const double value = numberOf(text);
          const bool isWhole = value >= 0.0 && value <= 0x1p53 && value == std::floor(value);
          if (!isWhole) return fmt::format("'{}' is no whole number {}", text, range);
          whole = uint64_t(value);
        }
        if (whole < lo || whole > hi) return fmt::format("'{}' is no whole number {}", text, range);
        text = fmt::format("{}", whole);
        return std::string();
      },
      range);
}

void addThreads(CLI::App& verb, int& threads) {
  verb.add_option("-t,--threads,--nthreads", threads, "threads; 0: all cores")
      ->transform(wholeNumberFrom(0, 1024));
}

void addTransport(CLI::App& verb, TransportTexts& given,
                  const std::function<bool(const ParameterInfo&)>& isMeant) {
  for (const ParameterInfo& info : transportSchema().infos()) {
    if (!isMeant(info)) continue;
    const std::string help =
        fmt::format("{} (default{} {})", info.help,
                    info.name == "max_bounces" ? ": those of the scene's file, else" : "",
                    settingText(info.defaultValue));
    std::string names = optionName(info.name);
    if (info.name == "russian_roulette") names = "--rr," + names;
    if (std::holds_alternative<bool>(info.defaultValue)) {
      names += ",!" + optionName(info.name, false);
      verb.add_flag_function(
          names,
          [&given, name = info.name](int64_t count) { given[name] = count > 0 ? "true" : "false"; },
          help);
      continue;
    }
    CLI::Option* option = verb.add_option_function<std::string>(
        names, [&given, name = info.name](const std::string& text) { given[name] = text; }, help);
    if (std::holds_alternative<int64_t>(info.defaultValue)) {
      option->type_name("UINT");
      option->transform(wholeNumberFrom(uint64_t(info.minValue), uint64_t(info.maxValue)));
    } else if (!info.choices.empty()) {
      option->type_name(fmt::format("{}", fmt::join(info.choices, "|")));
    }
  }
}

void applyTransport(const TransportTexts& given, TransportSettings& settings) {
  ParameterMap values;
  for (const ParameterInfo& info : transportSchema().infos()) {
    const auto found = given.find(info.name);
    if (found == given.end()) continue;
    values[info.name] = parseParameter(info, found->second,
                                       fmt::format("{} {}", optionName(info.name), found->second));
  }
  transportSchema().assign(settings, values);
}

void addBackendOptions(CLI::App& verb, BackendChoice& options) {
  verb.add_option("--backend", options.backend, "restlab list backends (default cpu)");
  verb.add_option("--device", options.device, "a part of a Vulkan device's name");
  verb.add_option("--ray-tracing", options.rayTracing,
                  "embree, bvh or query (default: the backend's best)");
  verb.add_flag("--validate", options.validate, "Vulkan's validation layers (slow)");
}

void addOutput(CLI::App& verb, std::string& output) {
  verb.add_option("-o,--output,--outfile", output, "EXR file to write")->required();
}

void addSceneSettings(CLI::App& verb, std::string& scene) {
  verb.add_option_function<std::string>(
      "--variant", [&scene](const std::string& name) { scene += "?variant=" + name; },
      "of a glTF file's materials, as FILE?variant=NAME");
  const auto append = [&scene](const std::string& setting) {
    scene += (scene.find('?') == std::string::npos ? "?" : "&") + setting;
  };
  verb.add_option_function<std::vector<std::string>>(
          "-D,--define",
          [append](const std::vector<std::string>& all) {
            for (const std::string& one : all) {
              splitAssignment(one, "--define");
              append(one);
            }
          },
          "NAME=VALUE of a $NAME in Mitsuba's XML, as FILE?NAME=VALUE")
      ->allow_extra_args(false);
  verb.add_flag_function(
      "--allow-unknown", [append](int64_t) { append("allow_unknown=1"); },
      "of Mitsuba's XML: draws what is unknown as mid grey, with a warning");
}

void addSceneOptions(CLI::App& verb, SceneOptions& options) {
  SceneRequest& request = options.request;
  verb.add_option("scene", request.scene,
                  "a glTF, Mitsuba or scene file, or a built-in scene (restlab list scenes)")
      ->required();
  addSceneSettings(verb, request.scene);
  verb.add_option(
      "--resolution", options.resolution,
      "WxH pixels (default: the film's of a Mitsuba file, else 512 wide, the camera's aspect "
      "ratio)");
  verb.add_option("--width", options.width, "pixels")->transform(wholeNumberFrom(1, kMaxSide));
  verb.add_option("--height", options.height, "pixels")->transform(wholeNumberFrom(1, kMaxSide));
  verb.add_option("--seed", options.seed, "random seed (default 1)")
      ->transform(wholeNumberFrom(0, ~uint32_t{0}));
  verb.add_option("--camera", request.camera, "name or index (default: the first)");
  verb.add_option("--environment", request.environment, "latitude-longitude .hdr or .exr");
  verb.add_option("--environment-rotation", request.environmentRotation, "degrees about +Y")
      ->transform(numberFrom(-360.0, 360.0, "degrees"));
  verb.add_option("--environment-scale", request.environmentScale, "factor on its radiance")
      ->transform(numberFrom(0.0, 1e9));
  verb.add_option("--component", options.component, "all, direct or indirect light");
  addTransport(verb, options.transport, [](const ParameterInfo& info) { return !info.sameMean; });
  addThreads(verb, options.threads);
}

void addMethodOptions(CLI::App& verb, MethodOptions& options) {
  for (const auto& [key, help, value] : methodSettings()) {
    if (value == &SessionConfig::backend) continue;
    verb.add_option(std::string("--") + key, options.choice.*value, help);
  }
  addBackendOptions(verb, options.backend);
  verb.add_option("--set", options.parameters,
                  "KEY=VALUE: a parameter of the integrator, the cache or the denoiser")
      ->take_all()
      ->allow_extra_args(false);
  addTransport(verb, options.transport, [](const ParameterInfo& info) { return info.sameMean; });
  verb.add_option("--kernels", options.kernels, "of the CPU: exact (default), built-in or general");
}

void resolveResolution(SceneOptions& options) {
  if (options.resolution.empty()) return;
  if (options.width || options.height) {
    failUsage("--resolution and --width/--height exclude each other");
  }
  parseResolution(options.resolution, "--resolution", options.width, options.height);
}

SessionConfig makeConfig(const SceneOptions& scene, const MethodOptions& method) {
  SessionConfig config;
  config.integrator = method.choice.integrator;
  config.cache = method.choice.cache;
  config.denoiser = method.choice.denoiser;
  const Method parts = findMethod(config);
  config.mode = findMode(*parts.integrator, method.choice.mode);
  applyBackend(method.backend, config);
  const bool isPlain = parts.denoiser->parameters.empty();
  config.parameters = parseParameters(parts.parameters(),
                                      "integrator " + parts.integrator->name +
                                          (isPlain ? "" : " with denoiser " + parts.denoiser->name),
                                      method.parameters, method.prefix + "set");
  for (const auto& [name, why] : settingsWithoutEffect(parts, config.mode, config.parameters)) {
    logWarning(fmt::format("{}{}{} has no effect: {}", method.prefix, name == "mode" ? "" : "set ",
                           name, why));
  }
  if (!method.kernels.empty())
    config.kernels = parseKernelChoice(method.kernels, method.prefix + "kernels");
  config.width = scene.width;
  config.height = scene.height;
  config.seed = scene.seed;
  applyTransport(scene.transport, config);
  applyTransport(method.transport, config);
  config.components = parseComponent(scene.component, "--component");
  config.threads = scene.threads;
  return config;
}

void completeConfig(const PreparedScene& prepared, const SceneOptions& options,
                    SessionConfig& config) {
  const std::optional<uint32_t>& bounces = prepared.scene->source().maxBounces;
  if (bounces && !options.transport.contains("max_bounces")) config.maxBounces = *bounces;
  config.camera = prepared.camera;
  completeResolution(prepared, config.width, config.height);
}

void checkOutputs(const std::vector<OutputFile>& outputs, const SceneRequest& request) {
  std::map<std::filesystem::path, std::string> taken;  // resolved file -> what it is
  for (const auto& [what, name] : {std::pair("scene", splitSceneSettings(request.scene).first),
                                   std::pair("environment", request.environment)}) {
    const std::filesystem::path found = findAsset(name);
    if (!found.empty()) taken.emplace(resolvedPath(found), what);
  }
  for (const OutputFile& output : outputs) {
    const std::string name = output.file.string();
    std::string extension = output.file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != output.extension) {
      failUsage(fmt::format("{} {}: must be named *{}{}", output.option, name, output.extension,
                            output.hint));
    }
    const auto [other, isFree] = taken.emplace(resolvedPath(output.file), output.option);
    if (!isFree) {
      failUsage(fmt::format("{} {}: is the same file as the {}; give it another name",
                            output.option, name, other->second));
    }
  }
}

std::vector<std::string> splitList(const std::string& text, const std::string& option) {
  std::vector<std::string> items;
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    const std::string item = text.substr(begin, comma - begin);
    if (item.empty()) failUsage(fmt::format("{} '{}': has an empty name", option, text));
    items.push_back(item);
    begin = comma + 1;
  }
  return items;
}

}  // namespace restlab
