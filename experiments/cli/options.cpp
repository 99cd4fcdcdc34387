#include "experiments/cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "core/backend/backend.h"
#include "core/cache.h"
#include "core/config.h"
#include "core/error.h"
#include "core/method.h"
#include "core/method_settings.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/run/files.h"
#include "experiments/runner/run/log.h"

namespace restlab {

namespace {}  // namespace

ParameterMap parseParameters(const std::vector<ParameterInfo>& known, const std::string& owner,
                             const std::vector<std::string>& given) {
  std::vector<std::string> names;
  for (const ParameterInfo& parameter : known) names.push_back(parameter.name);
  ParameterMap parameters;
  for (const std::string& assignment : given) {
    const auto [key, value] = splitAssignment(assignment);
    const auto found = std::find(names.begin(), names.end(), key);
    if (found == names.end()) {
      failUsage(fmt::format("--set {}: {} has no parameter '{}'{}", assignment, owner, key,
                            didYouMean(key, names)));
    }
    parameters[key] =
        parseParameter(known[size_t(found - names.begin())], value, "--set " + assignment);
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

CLI::Validator finiteRange(double lo, double hi) {
  const std::string range = fmt::format("in [{:g} - {:g}]", lo, hi);
  return CLI::Validator(
      [=](std::string& text) {
        double value = 0.0;
        const bool inside = CLI::detail::lexical_cast(text, value) && value >= lo && value <= hi;
        return inside ? std::string() : fmt::format("Value {} not {}", text, range);
      },
      "FLOAT " + range);
}

void addThreads(CLI::App& verb, int& threads) {
  verb.add_option("-t,--threads,--nthreads", threads, "threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
}

void addMultiscatter(CLI::App& verb, bool& multiscatter) {
  verb.add_flag("--multiscatter", multiscatter,
                "rough reflection keeps the light that meets several microfacets (default off)");
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

void addSceneOptions(CLI::App& verb, SceneOptions& options) {
  SceneRequest& request = options.request;
  verb.add_option("scene", request.scene, "a glTF file or a built-in scene (restlab list scenes)")
      ->required();
  verb.add_option("--resolution", options.resolution,
                  "WxH pixels (default: 512 wide, the camera's "
                  "aspect ratio)");
  verb.add_option("--width", options.width, "pixels")->check(CLI::Range(1u, kMaxSide));
  verb.add_option("--height", options.height, "pixels")->check(CLI::Range(1u, kMaxSide));
  verb.add_option("--seed", options.seed, "random seed (default 1)");
  verb.add_option("--camera", request.camera, "name or index (default: the first)");
  verb.add_option("--max-bounces", options.maxBounces,
                  "scattering events; 0: emission only, 1: direct light (default 8)")
      ->check(CLI::Range(0u, kMaxBounces));
  verb.add_option("--environment", request.environment, "latitude-longitude .hdr or .exr");
  verb.add_option("--environment-rotation", request.environmentRotation, "degrees about +Y")
      ->check(finiteRange(-360.0, 360.0));
  verb.add_option("--environment-scale", request.environmentScale, "factor on its radiance")
      ->check(finiteRange(0.0, 1e9));
  verb.add_option("--component", options.component, "all, direct or indirect light");
  verb.add_option("--filter", options.filter, "pixel filter: box (one pixel) or center");
  addMultiscatter(verb, options.multiscatter);
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
  verb.add_flag("--rr", options.russianRoulette, "Russian roulette (default off)");
  verb.add_flag("--general", options.general, "the general kernels instead of specialised ones");
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
                                      method.parameters);
  for (const auto& [name, why] : settingsWithoutEffect(parts, config.mode, config.parameters)) {
    logWarning(fmt::format("{}{} has no effect: {}", name == "mode" ? "--" : "--set ", name, why));
  }
  config.russianRoulette = method.russianRoulette;
  config.specialise = !method.general;
  config.width = scene.width;
  config.height = scene.height;
  config.seed = scene.seed;
  config.maxBounces = scene.maxBounces;
  config.components = parseComponent(scene.component, "--component");
  config.pixelFilter = parseFilter(scene.filter, "--filter");
  config.multiscatter = scene.multiscatter;
  config.threads = scene.threads;
  return config;
}

void completeConfig(const PreparedScene& prepared, SessionConfig& config) {
  config.camera = prepared.camera;
  completeResolution(prepared, config.width, config.height);
}

void checkOutputs(const std::vector<OutputFile>& outputs, const SceneRequest& request) {
  std::map<std::filesystem::path, std::string> taken;  // by what it is
  const auto resolved = [](const std::filesystem::path& file) {
    std::error_code status;
    const std::filesystem::path real = std::filesystem::weakly_canonical(file, status);
    return status ? file : real;
  };
  for (const auto& [what, name] :
       {std::pair("scene", request.scene), std::pair("environment", request.environment)}) {
    const std::filesystem::path found = findAsset(name);
    if (!found.empty()) taken.emplace(resolved(found), what);
  }
  for (const OutputFile& output : outputs) {
    const std::string name = output.file.string();
    std::string extension = output.file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != output.extension) {
      failUsage(fmt::format("{} {}: must be named *{}", output.option, name, output.extension));
    }
    const auto [other, isFree] = taken.emplace(resolved(output.file), output.option);
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
