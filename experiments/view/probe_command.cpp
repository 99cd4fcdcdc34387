// A pixel of a pane as a command line.
#include <fmt/format.h>

#include "core/method_settings.h"
#include "experiments/runner/run/build_info.h"
#include "experiments/view/view_session.h"

namespace restlab {

namespace {

using Words = std::vector<std::string>;

void addScene(const ViewFacts& facts, const LiveView& view, Words& words) {
  const SceneRequest request = fromAnywhere(facts.request);
  words.push_back(request.scene);
  const auto add = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  if (!request.camera.empty()) add("--camera", request.camera);
  if (!request.environment.empty()) add("--environment", request.environment);
  if (request.environmentRotation)
    add("--environment-rotation", fmt::format("{}", *request.environmentRotation));
  if (request.environmentScale)
    add("--environment-scale", fmt::format("{}", *request.environmentScale));
  const SessionConfig& config = view.settings().panes.front().config;
  add("--resolution", fmt::format("{}x{}", config.width, config.height));
  add("--max-bounces", std::to_string(config.maxBounces));
  if (config.components != rl::RL_COMPONENT_ALL)
    add("--component", componentName(config.components));
  if (config.pixelFilter != rl::RL_FILTER_BOX) add("--filter", filterName(config.pixelFilter));
  if (config.multiscatter) words.emplace_back("--multiscatter");
}

// To the last bit, unlike parameterText().
std::string valueText(const ParameterValue& value) {
  const double* number = std::get_if<double>(&value);
  return number ? fmt::format("{}", *number) : parameterText(value);
}

void addMethod(const SessionConfig& config, Words& words) {
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  for (const MethodSetting& setting : methodSettings())
    add(std::string("--") + setting.key, config.*(setting.value));
  add("--device", config.device);
  add("--ray-tracing", config.rayTracing);
  if (config.russianRoulette) words.emplace_back("--rr");
  if (!config.specialise) words.emplace_back("--general");
  for (const auto& [name, value] : config.parameters)
    add("--set", fmt::format("{}={}", name, valueText(value)));
}

}  // namespace

std::string probeCommand(const ViewFacts& facts, const LiveView& view, const Probe& probe) {
  const PreparedScene& loaded = view.loaded();
  const ViewSettings& settings = view.settings();
  const SceneCamera& own = loaded.scene->source().cameras.at(loaded.camera);
  if (!settings.lights.empty() || !isSameCamera(own, settings.camera) ||
      !view.hasPlainHistory(probe.pane))
    return "";
  const SessionConfig& config = settings.panes.at(probe.pane).config;
  // As this program was called, so that it is found again.
  Words words = {arguments().empty() ? "restlab" : arguments().front(), "render"};
  addScene(facts, view, words);
  addMethod(config, words);
  for (const std::string& word : {std::string("--pixel"), fmt::format("{},{}", probe.x, probe.y),
                                  std::string("--seed"), std::to_string(config.seed),
                                  std::string("--frame"), std::to_string(view.frames(probe.pane))})
    words.push_back(word);
  return shellCommand(words);
}

}  // namespace restlab
