#include "experiments/runner/run/render_command.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/frame/method_settings.h"
#include "core/scene/scene.h"
#include "core/scene/scene_file/scene_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

// Searches in the same order as prepareScene().
std::string fileFromAnywhere(const std::string& name, const std::string& suiteFolder) {
  std::error_code status;
  const fs::path found = findAsset(name);
  if (!found.empty()) return fs::absolute(found, status).string();
  if (!suiteFolder.empty() && fs::exists(fs::path(suiteFolder) / name, status))
    return fs::absolute(fs::path(suiteFolder) / name, status).string();
  return name;
}

void add(Words& words, const std::string& option, const std::string& value) {
  if (!value.empty()) words.insert(words.end(), {option, value});
}

void addScene(const SceneRequest& request, Words& words) {
  words.push_back(request.scene);
  add(words, "--camera", request.camera);
  add(words, "--environment", request.environment);
  if (request.environmentRotation)
    add(words, "--environment-rotation", fmt::format("{}", *request.environmentRotation));
  if (request.environmentScale)
    add(words, "--environment-scale", fmt::format("{}", *request.environmentScale));
}

void addPicture(const SessionConfig& config, Words& words) {
  add(words, "--resolution", fmt::format("{}x{}", config.width, config.height));
  const std::vector<ParameterInfo> defaults = transportSchema().infos();
  const std::vector<ParameterInfo> own = transportSchema().infos(config);
  for (size_t i = 0; i < own.size(); ++i) {
    const ParameterValue& value = own[i].defaultValue;
    const bool isNumber = std::holds_alternative<int64_t>(value);
    if (!isNumber && value == defaults[i].defaultValue) continue;
    const bool* flag = std::get_if<bool>(&value);
    words.push_back(optionName(own[i].name, !flag || *flag));
    if (!flag) words.push_back(parameterText(value));
  }
  if (config.components != rl::RL_COMPONENT_ALL)
    add(words, "--component", componentName(config.components));
}

// Writes numbers to the last bit, unlike parameterText().
std::string valueText(const ParameterValue& value) {
  const double* number = std::get_if<double>(&value);
  return number ? fmt::format("{}", *number) : parameterText(value);
}

void addMethod(const SessionConfig& config, Words& words) {
  for (const MethodSetting& setting : methodSettings())
    add(words, std::string("--") + setting.key, config.*(setting.value));
  add(words, "--device", config.device);
  add(words, "--ray-tracing", config.rayTracing);
  if (config.kernels != defaultKernelChoice())
    add(words, "--kernels", kernelChoiceName(config.kernels));
  for (const auto& [name, value] : config.parameters)
    add(words, "--set", fmt::format("{}={}", name, valueText(value)));
}

}  // namespace

namespace {

std::string sceneFromAnywhere(const std::string& name, const std::string& suiteFolder) {
  const auto [file, settings] = splitSceneSettings(name);
  return fileFromAnywhere(file, suiteFolder) + (settings.empty() ? "" : "?" + settings);
}

}  // namespace

SceneRequest fromAnywhere(SceneRequest request) {
  if (!isBuiltinScene(request.scene))
    request.scene = sceneFromAnywhere(request.scene, request.suiteFolder);
  if (!request.environment.empty())
    request.environment = fileFromAnywhere(request.environment, request.suiteFolder);
  request.suiteFolder.clear();
  return request;
}

std::vector<std::string> renderWords(const SceneRequest& request, const SessionConfig& picture,
                                     const SessionConfig& method) {
  // Keep the name that this program was started with.
  Words words = {arguments().empty() ? "restlab" : arguments().front(), "render"};
  addScene(fromAnywhere(request), words);
  addPicture(picture, words);
  addMethod(method, words);
  return words;
}

}  // namespace restlab
