#include "experiments/runner/suite/prepare.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/scene/material_notes.h"
#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/scene/compiled/light_factor.h"
#include "core/scene/compiled/scene_origin.h"
#include "core/scene/textures/daylight.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "core/scene/mitsuba/mitsuba.h"
#include "core/scene/scene_file/scene_file.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Also looks for a relative name beside the suite; returns "" if not found.
std::string locate(const std::string& name, const std::string& suiteFolder) {
  const fs::path found = findAsset(name);
  if (!found.empty()) return found.string();
  std::error_code status;
  if (!suiteFolder.empty() && fs::exists(fs::path(suiteFolder) / name, status)) {
    return (fs::path(suiteFolder) / name).string();
  }
  return "";
}

uint64_t hashEnvironment(const EnvironmentMap& map, uint64_t seed) {
  const float numbers[4] = {float(map.width), float(map.height), map.rotation, map.scale};
  uint64_t hash = XXH3_64bits_withSeed(numbers, sizeof(numbers), seed);
  const size_t bytes = map.radiance.size() * sizeof(glm::vec3);
  return XXH3_64bits_withSeed(map.radiance.data(), bytes, hash);
}

float radiansOf(double degrees) { return float(degrees * std::numbers::pi / 180.0); }

// Returns degrees, with enough digits to give the same radians again.
std::string rotationText(float radians) {
  const double degrees = radians * 180.0 / std::numbers::pi;
  const std::string text = fmt::format("{:.6g}", degrees);
  return radiansOf(std::stod(text)) == radians ? text : fmt::format("{:.12g}", degrees);
}

void setCamera(PreparedScene& prepared, const Scene& scene, const std::string& nameOrIndex) {
  prepared.camera = nameOrIndex.empty() ? 0 : findCamera(scene, nameOrIndex);
  const std::string& name = scene.cameras.at(prepared.camera).name;
  prepared.cameraName = name.empty() ? std::to_string(prepared.camera) : name;
}

}  // namespace

bool assetsMissing(const SceneRequest& request, std::string& missing) {
  missing.clear();
  const std::string file = splitSceneSettings(request.scene).first;
  if (!isBuiltinScene(request.scene) && locate(file, request.suiteFolder).empty()) {
    missing = request.scene;
  } else if (!request.environment.empty() && !isDaylightName(request.environment) &&
             locate(request.environment, request.suiteFolder).empty()) {
    missing = request.environment;
  }
  return !missing.empty();
}

std::optional<EnvironmentMap> readEnvironment(const SceneRequest& request) {
  if (request.environment.empty()) return std::nullopt;
  if (isDaylightName(request.environment)) return daylightMap(parseDaylight(request.environment));
  const std::string found = locate(request.environment, request.suiteFolder);
  if (found.empty()) {
    std::error_code status;
    if (!fs::exists(request.environment, status) && isHidden(status))
      failInput(fmt::format("{}: {}", request.environment, unreadableReason(request.environment)));
    failInput(
        fmt::format("{}: environment not found (looked here, in RESTLAB_SCENES and in "
                    "../shared/scenes)",
                    request.environment));
  }
  return loadEnvironment(found);
}

PreparedScene prepareScene(const SceneRequest& request) {
  return prepareScene(request, readEnvironment(request));
}

PreparedScene prepareScene(const SceneRequest& request, std::optional<EnvironmentMap> environment) {
  const auto start = std::chrono::steady_clock::now();
  PreparedScene prepared;
  std::string name = request.scene;
  if (!isBuiltinScene(name) && !request.suiteFolder.empty()) {
    const auto [file, settings] = splitSceneSettings(name);
    const std::string found = locate(file, request.suiteFolder);
    if (!found.empty()) name = found + (settings.empty() ? "" : "?" + settings);
  }
  Scene scene = loadScene(name);
  prepared.environmentName = scene.environment ? scene.environment->source : "none";
  if (prepared.environmentName.empty()) prepared.environmentName = "built-in";
  if (environment) {
    scene.environment = std::move(environment);
    const std::vector<std::string>& said = scene.environment->warnings;
    scene.warnings.insert(scene.warnings.end(), said.begin(), said.end());
    prepared.environmentName = request.environment;
  }
  if (!scene.environment && (request.environmentRotation || request.environmentScale)) {
    failUsage(fmt::format("{}: has no environment to rotate or scale; give one with --environment",
                          request.scene));
  }
  if (request.environmentRotation) {
    scene.environment->rotation = radiansOf(*request.environmentRotation);
  }
  if (request.environmentScale) scene.environment->scale = float(*request.environmentScale);
  prepared.contentHash = scene.contentHash;
  if (scene.environment) {
    prepared.contentHash = hashEnvironment(*scene.environment, scene.contentHash);
  }
  // Report an unknown camera before the slow compilation.
  setCamera(prepared, scene, request.camera);
  scene.mainCamera = prepared.camera;
  prepared.scene = CompiledScene::build(std::move(scene));
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  prepared.loadTimeMs = spent.count();
  return prepared;
}

PreparedScene withSettings(const PreparedScene& loaded, const std::string& settings) {
  const Scene& before = loaded.scene->source();
  const std::string own = settingsOfScene(before);
  Scene scene = loadSceneFile(before.source, own.empty() ? settings : own + "&" + settings);
  scene.environment = before.environment;
  scene.mainCamera = loaded.camera;
  PreparedScene prepared = loaded;
  prepared.contentHash = scene.contentHash;
  if (scene.environment)
    prepared.contentHash = hashEnvironment(*scene.environment, scene.contentHash);
  prepared.scene = CompiledScene::build(std::move(scene));
  return prepared;
}

PreparedScene withLights(const PreparedScene& loaded,
                         const std::shared_ptr<const CompiledScene>& scene,
                         const std::string& words) {
  PreparedScene prepared = loaded;
  prepared.scene = scene;
  const std::vector<float> factors = lightFactors(scene->source());
  if (factors.empty()) return prepared;
  prepared.contentHash =
      XXH3_64bits_withSeed(factors.data(), factors.size() * sizeof(float), loaded.contentHash);
  prepared.lights = words;
  return prepared;
}

void chooseCamera(PreparedScene& prepared, const std::string& nameOrIndex) {
  const Scene& scene = prepared.scene->source();
  setCamera(prepared, scene, nameOrIndex);
  if (prepared.camera == scene.mainCamera) return;
  const SceneOrigin before = originOf(scene, scene.mainCamera),
                    after = originOf(scene, prepared.camera);
  if (before.viewSize == 0.0 && after.viewSize == 0.0) return;
  Scene other = scene;
  other.mainCamera = prepared.camera;
  prepared.scene = CompiledScene::build(std::move(other));
}

void printWarnings(const PreparedScene& prepared) {
  for (const std::string& warning : prepared.scene->warnings()) logWarning(warning);
  for (const std::string& note : prepared.scene->source().notes) logInfo(note);
  for (const std::string& note : materialNotes(prepared.scene->source())) logInfo(note);
}

void completeResolution(const PreparedScene& prepared, uint32_t& width, uint32_t& height) {
  const Scene& scene = prepared.scene->source();
  const SceneCamera& camera = scene.cameras.at(prepared.camera);
  const double aspect = camera.aspect;
  const bool hasFilm = camera.film.x > 0 && camera.film.x <= kMaxSide && camera.film.y <= kMaxSide;
  if (width == 0 && height == 0 && hasFilm) {
    width = camera.film.x;
    height = camera.film.y;
  }
  const double ratio = aspect > 0.0 ? aspect : 1.0;
  if (width == 0 && height == 0) width = 512;
  if (width != 0 && height != 0) return;
  const double wanted = std::round(width == 0 ? height * ratio : width / ratio);
  // Check as a double: the ratio may be anything.
  if (!(wanted >= 1.0 && wanted <= double(kMaxSide))) {
    failInput(
        fmt::format("{}: camera '{}' has the aspect ratio {:g}: {} pixels {} would be {:g} {}, "
                    "which must be 1 to {}; give both width and height",
                    scene.name, prepared.cameraName, aspect, width == 0 ? height : width,
                    width == 0 ? "high" : "wide", wanted, width == 0 ? "wide" : "high", kMaxSide));
  }
  (width == 0 ? width : height) = uint32_t(wanted);
}

std::string hexHash(uint64_t hash) { return fmt::format("{:016x}", hash); }

std::map<std::string, std::string> describe(const PreparedScene& prepared,
                                            const SessionConfig& config) {
  const Scene& source = prepared.scene->source();
  const std::string settings = settingsOfScene(source);
  std::map<std::string, std::string> words = {
      {"program", "restlab"},
      {"scene", source.name},
      {"scene_source", source.source.empty()
                           ? "built-in"
                           : source.source.string() + (settings.empty() ? "" : "?" + settings)},
      {"scene_hash", hexHash(prepared.contentHash)},
      {"environment", prepared.environmentName},
      {"width", std::to_string(config.width)},
      {"height", std::to_string(config.height)},
      {"component", componentName(config.components)},
      {"kernel", kernelChoiceName(config.kernels)},
      {"source_hash", buildInfo().sourceHash},
      {"reference_sources", buildInfo().referenceHash},
  };
  for (const auto& [key, text] : transportTexts(config)) words[key] = text;
  for (const auto& [key, value] : settingValues(config)) words[key] = value;
  describeCamera(source.cameras.at(prepared.camera), words);
  words["camera"] = prepared.cameraName;
  words["camera_index"] = std::to_string(prepared.camera);
  if (source.environment) {
    words["environment_rotation"] = rotationText(source.environment->rotation);
    words["environment_scale"] = fmt::format("{:.9g}", source.environment->scale);
  }
  if (!prepared.lights.empty()) words["lights"] = prepared.lights;
  const ParameterMap all = resolveParameters(findMethod(config), config.parameters);
  for (const auto& [key, value] : all) words["parameter." + key] = parameterText(value);
  return words;
}

void describeCamera(const SceneCamera& camera, std::map<std::string, std::string>& words) {
  std::string matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix +=
          fmt::format("{}{:.9g}", matrix.empty() ? "" : " ", camera.cameraToWorld[column][row]);
    }
  }
  words["camera"] = camera.name;
  words["camera_index"] = "none";
  words["camera_to_world"] = matrix;
  // Erase what an earlier camera left.
  for (const char* word : {"camera_mirrored", "camera_shift"}) words.erase(word);
  if (camera.isMirrored) words["camera_mirrored"] = "true";
  if (camera.shift != glm::dvec2(0.0))
    words["camera_shift"] = fmt::format("{:.9g} {:.9g}", camera.shift.x, camera.shift.y);
  words["camera_yfov"] = fmt::format("{:.9g}", camera.yfov);
}

std::string cameraWords(const SceneCamera& camera) {
  std::string words =
      fmt::format("{} {:a} {:a} {:a}", camera.kind, camera.yfov, camera.xmag, camera.ymag);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      words += fmt::format(" {:a}", camera.cameraToWorld[column][row]);
  }
  if (camera.isMirrored) words += " mirrored";
  if (camera.shift != glm::dvec2(0.0))
    words += fmt::format(" shift {:a} {:a}", camera.shift.x, camera.shift.y);
  return words;
}

}  // namespace restlab
