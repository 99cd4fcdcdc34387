#include "experiments/view/live_view.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/method.h"
#include "core/method_settings.h"
#include "core/scene/light_factor.h"

namespace restlab {

namespace {

// Those of another method's parameters that this one has.
ParameterMap parametersFor(const SessionConfig& config) {
  ParameterMap kept;
  for (const ParameterInfo& info : findMethod(config).parameters()) {
    const auto found = config.parameters.find(info.name);
    if (found != config.parameters.end()) kept.insert(*found);
  }
  return kept;
}

// A whole number is a number, too.
ParameterValue valueFor(const ParameterInfo& info, const ParameterValue& value) {
  const int64_t* whole = std::get_if<int64_t>(&value);
  if (whole && std::holds_alternative<double>(info.defaultValue)) return double(*whole);
  return value;
}

}  // namespace

LiveView::LiveView(const PreparedScene& prepared, const std::vector<SessionConfig>& panes,
                   const ReferenceStore& store)
    : loaded_(prepared),
      prepared_(prepared),
      camera_(prepared.scene->source().cameras.at(prepared.camera)),
      reference_(store) {
  for (const SessionConfig& config : panes) {
    Pane& pane = panes_.emplace_back();
    pane.config = config;
    pane.session = sessionOf(config);
  }
  beginEpoch(true);
}

void LiveView::apply(const ViewCommand& command) {
  std::visit([this](const auto& one) { change(one); }, command);
}

void LiveView::renderFrames() {
  for (Pane& pane : panes_) pane.stats = pane.session->frame();
  if (!reference_.isThere()) return;
  const Image half0 = reference_.half0(), half1 = reference_.half1();
  for (Pane& pane : panes_) pane.error.add(pane.session->radiance(), half0, half1);
}

LiveView::Pane& LiveView::paneOf(uint32_t index) {
  if (index >= panes_.size()) failUsage(fmt::format("pane {}: there are {}", index, panes_.size()));
  return panes_[index];
}

std::unique_ptr<Session> LiveView::sessionOf(const SessionConfig& config) const {
  auto session = std::make_unique<Session>(prepared_.scene, config);
  session->setCamera(camera_);
  return session;
}

void LiveView::beginEpoch(bool isAnotherPicture) {
  ++epoch_;
  for (Pane& pane : panes_) pane.error.restart();
  if (!isAnotherPicture) return;
  ReferenceConfig config = referenceConfigOf(panes_.front().session->config());
  config.camera = camera_;
  reference_.begin(prepared_, config);
}

void LiveView::change(const SetSetting& command) {
  Pane& pane = paneOf(command.pane);
  SessionConfig config = pane.config;
  const std::vector<MethodSetting>& settings = methodSettings();
  const auto setting = std::find_if(settings.begin(), settings.end(),
                                    [&](const MethodSetting& s) { return s.key == command.key; });
  if (setting == settings.end()) {
    std::vector<std::string> keys;
    for (const MethodSetting& s : settings) keys.emplace_back(s.key);
    failUsage(fmt::format("'{}': is no setting of a method (known: {}){}", command.key,
                          fmt::join(keys, ", "), didYouMean(command.key, keys)));
  }
  config.*(setting->value) = command.value;
  // Modes and caches are the integrator's.
  if (setting->value == &SessionConfig::integrator) config.mode = config.cache = "";
  config.parameters = parametersFor(config);
  pane.session = sessionOf(config);
  pane.config = config;
  pane.layer.clear();
  beginEpoch(false);
}

void LiveView::change(const SetParameter& command) {
  Pane& pane = paneOf(command.pane);
  const std::vector<ParameterInfo> known = findMethod(pane.config).parameters();
  const auto info = std::find_if(known.begin(), known.end(),
                                 [&](const ParameterInfo& p) { return p.name == command.name; });
  if (info == known.end()) {
    std::vector<std::string> names;
    for (const ParameterInfo& p : known) names.push_back(p.name);
    failUsage(fmt::format("pane {}: has no parameter '{}'{}", command.pane, command.name,
                          didYouMean(command.name, names)));
  }
  if (command.value) {
    const ParameterValue value = valueFor(*info, *command.value);
    pane.session->setParameters({{command.name, value}});
    pane.config.parameters[command.name] = value;
  } else {
    // Defaults of a part may be another part's: a new session knows.
    SessionConfig config = pane.config;
    config.parameters.erase(command.name);
    pane.session = sessionOf(config);
    pane.config = config;
  }
  beginEpoch(false);
}

void LiveView::change(const MoveCamera& command) {
  SceneCamera camera = camera_;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      camera.cameraToWorld[column][row] = command.toWorld[size_t(4 * column + row)];
  }
  if (command.yfov) camera.yfov = *command.yfov;
  camera_ = camera;
  for (Pane& pane : panes_) pane.session->setCamera(camera_);
  beginEpoch(true);
}

void LiveView::change(const Resize& command) {
  const uint32_t width = panes_.front().config.width, height = panes_.front().config.height;
  const auto resize = [this](uint32_t w, uint32_t h) {
    for (Pane& pane : panes_) {
      pane.session->resize(w, h);
      pane.session->setCamera(camera_);
      pane.config.width = w;
      pane.config.height = h;
    }
  };
  try {
    resize(command.width, command.height);
  } catch (const Error&) {
    resize(width, height);  // where there was memory before
    throw;
  }
  beginEpoch(true);
}

void LiveView::change(const SetLight& command) {
  Scene scene = loaded_.scene->source();
  requireLight(scene, command.name);
  auto lights = lights_;
  std::erase_if(lights, [&](const auto& light) { return light.first == command.name; });
  lights.emplace_back(command.name, command.factor);
  std::string words;
  for (const auto& [name, factor] : lights) {
    scene = withLightFactor(std::move(scene), name, factor);
    words += fmt::format("{}{} x{}", words.empty() ? "" : ", ", name, factor);
  }
  const PreparedScene shown = withLights(loaded_, CompiledScene::build(std::move(scene)), words);
  for (Pane& pane : panes_) pane.session->setScene(shown.scene);
  lights_ = std::move(lights);
  prepared_ = shown;
  beginEpoch(true);
}

void LiveView::change(const ShowLayer& command) {
  Pane& pane = paneOf(command.pane);
  const std::vector<std::string> names = findMethod(pane.config).aovNames();
  if (!command.name.empty() && std::find(names.begin(), names.end(), command.name) == names.end()) {
    failUsage(fmt::format("layer '{}': is unknown (known: {}){}", command.name,
                          fmt::join(names, ", "), didYouMean(command.name, names)));
  }
  pane.layer = command.name;
}

void LiveView::change(const Restart&) {
  for (Pane& pane : panes_) pane.session->reset(++pane.config.seed);
  beginEpoch(false);
}

}  // namespace restlab
