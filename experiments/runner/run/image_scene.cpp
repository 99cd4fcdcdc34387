#include "experiments/runner/run/image_scene.h"

#include <fmt/format.h>

#include <cstdlib>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/mitsuba/mitsuba.h"
#include "core/scene/scene_file/scene_file.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

// Returns whether the environment is the scene's own, of which an image knows no file.
bool hasEnvironment(const std::string& name, const std::string& environment) {
  const std::string file = splitSceneSettings(name).first;
  if (!isBuiltinScene(name) && !isSceneFile(file) && !isMitsubaFile(file)) return false;
  const Scene scene = loadScene(name);
  if (!scene.environment) return false;
  const std::string& own = scene.environment->source;
  return own == environment || (own.empty() && environment == "built-in");
}

}  // namespace

ImageScene sceneOfImage(const std::string& file,
                        const std::map<std::string, std::string>& metadata) {
  const auto word = [&](const char* key) {
    const auto found = metadata.find(key);
    if (found == metadata.end()) {
      failInput(fmt::format("{}: does not say which scene it shows ({} is missing)", file, key));
    }
    return found->second;
  };
  const auto side = [&](const char* key) {
    const unsigned long value = std::strtoul(word(key).c_str(), nullptr, 10);
    if (value < 1 || value > kMaxSide) {
      failInput(fmt::format("{}: {} is {}, not 1 to {}", file, key, word(key), kMaxSide));
    }
    return uint32_t(value);
  };
  SceneRequest request;
  request.scene = word("scene_source") == "built-in" ? word("scene") : word("scene_source");
  request.camera = word("camera_index");
  const std::string environment = word("environment");
  if (environment != "none") {
    request.environmentRotation = std::strtod(word("environment_rotation").c_str(), nullptr);
    request.environmentScale = std::strtod(word("environment_scale").c_str(), nullptr);
  }
  const std::string hash = word("scene_hash");
  ImageScene scene;
  scene.config.width = side("width");
  scene.config.height = side("height");
  for (const ParameterInfo& info : transportSchema().infos()) {
    if (info.name != "filter") continue;
    const ParameterValue filter = parseParameter(info, word("filter"), file);
    transportSchema().assign(scene.config, {{info.name, filter}});
  }
  try {
    if (environment != "none" && !hasEnvironment(request.scene, environment))
      request.environment = environment;
    scene.prepared = prepareScene(request);
  } catch (const Error& error) {
    throw Error(ExitCode::badInput,
                fmt::format("{}: its scene cannot be traced again: {}", file, error.what()));
  }
  if (hexHash(scene.prepared.contentHash) != hash) {
    failInput(fmt::format("{}: {} is not the scene that was rendered: its hash is {}, not {}", file,
                          request.scene, hexHash(scene.prepared.contentHash), hash));
  }
  scene.config.camera = scene.prepared.camera;
  return scene;
}

}  // namespace restlab
