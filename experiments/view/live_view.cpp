#include "experiments/view/live_view.h"

#include <fmt/format.h>

#include <utility>

#include "core/error.h"
#include "core/method.h"
#include "core/scene/light_factor.h"

namespace restlab {

namespace {

bool hasHistory(const SessionConfig& config) {
  const Method method = findMethod(config);
  return method.hasHistory(resolveParameters(method, config.parameters));
}

}  // namespace

ViewSettings settingsOf(const PreparedScene& prepared, const std::vector<SessionConfig>& panes) {
  ViewSettings settings;
  for (const SessionConfig& config : panes) settings.panes.push_back({withNames(config), ""});
  settings.camera = prepared.scene->source().cameras.at(prepared.camera);
  return settings;
}

LiveView::LiveView(const PreparedScene& prepared, const std::vector<SessionConfig>& panes,
                   const ReferenceStore& store)
    : LiveView(prepared, settingsOf(prepared, panes), store) {}

LiveView::LiveView(const PreparedScene& prepared, ViewSettings settings,
                   const ReferenceStore& store)
    : loaded_(prepared), prepared_(prepared), settings_(std::move(settings)), reference_(store) {
  if (!settings_.lights.empty()) prepared_ = litBy(settings_.lights);
  for (const PaneSettings& pane : settings_.panes)
    panes_.emplace_back().session = sessionOf(pane.config, prepared_, settings_.camera);
  beginEpoch(true);
}

void LiveView::apply(const ViewCommand& command) {
  if (std::holds_alternative<Pause>(command) || std::holds_alternative<Look>(command) ||
      std::holds_alternative<Probe>(command) || std::holds_alternative<SaveSession>(command))
    return;
  if (std::holds_alternative<Restart>(command)) return restart();
  const ViewSettings before = settings_;
  if (std::holds_alternative<Undo>(command)) {
    if (!history_.canUndo()) failUsage("undo: nothing was changed");
    become(history_.undone());
    return history_.undo(before);
  }
  if (std::holds_alternative<Redo>(command)) {
    if (!history_.canRedo()) failUsage("redo: nothing was undone");
    become(history_.redone());
    return history_.redo(before);
  }
  ViewChange change = changedBy(command, settings_, loaded_.scene->source());
  if (isSame(change.settings, settings_)) return;
  become(std::move(change.settings));
  history_.add(before, change.target, change.text);
  if (const auto* copy = std::get_if<CopyMethod>(&command)) giveOwnSeed(copy->to);
}

void LiveView::renderFrames() {
  for (Pane& pane : panes_) renderFrame(pane);
  ++age_;
}

bool LiveView::renderFirstFrames() {
  bool isAny = false;
  for (Pane& pane : panes_) {
    if (pane.frames > 0) continue;
    renderFrame(pane);
    isAny = true;
  }
  return isAny;
}

void LiveView::renderFrame(Pane& pane) {
  pane.stats = pane.session->frame();
  ++pane.frames;
  pane.epoch = epoch_;
  if (!reference_.isThere()) return;
  pane.error.add(pane.session->radiance(), reference_.mean(), reference_.half0(),
                 reference_.half1(), reference_.spp());
}

std::unique_ptr<Session> LiveView::sessionOf(const SessionConfig& config,
                                             const PreparedScene& shown,
                                             const SceneCamera& camera) const {
  auto session = std::make_unique<Session>(shown.scene, config);
  session->setCamera(camera);
  return session;
}

PreparedScene LiveView::litBy(const LightFactors& lights) const {
  if (lights.empty()) return loaded_;
  Scene scene = loaded_.scene->source();
  std::string words;
  for (const auto& [name, factor] : absoluteLights(lights)) {
    scene = withLightFactor(std::move(scene), name, factor);
    words += fmt::format("{}{} x{}", words.empty() ? "" : ", ", name, factor);
  }
  return withLights(loaded_, CompiledScene::build(std::move(scene)), words);
}

void LiveView::beginEpoch(bool isAnotherPicture) {
  ++epoch_;
  age_ = 0;
  for (Pane& pane : panes_) pane.error.restart();
  if (!isAnotherPicture) return;
  ++picture_;
  ReferenceConfig config = referenceConfigOf(panes_.front().session->config());
  config.camera = settings_.camera;
  if (!referenceSeed_) referenceSeed_ = config.seed;
  config.seed = *referenceSeed_;
  reference_.begin(prepared_, config);
}

bool LiveView::setParameters(Pane& pane, const SessionConfig& config) {
  const ParameterMap wanted = resolveParameters(findMethod(config), config.parameters);
  if (!pane.session->setParameters(wanted)) return false;
  pane.frames = 0;
  return true;
}

void LiveView::resize(const std::vector<Pane*>& panes, const SessionConfig& before,
                      const SessionConfig& after) {
  const auto resizeAll = [&](const SessionConfig& size) {
    for (Pane* pane : panes) {
      pane->frames = 0;
      pane->session->resize(size.width, size.height);
      pane->session->setCamera(settings_.camera);
    }
  };
  try {
    resizeAll(after);
  } catch (...) {
    // Where there was memory before. If there is none now, no session is whole: that is the end.
    try {
      resizeAll(before);
    } catch (const std::exception& error) {
      throw std::runtime_error(
          fmt::format("the size of before has no room any more: {}", error.what()));
    }
    for (Pane* pane : panes) {
      pane->isPlain = true;
      pane->hasOldLight = false;
    }
    beginEpoch(false);
    throw;
  }
}

// What may throw comes first: a session of another method, then what the others can say no to.
void LiveView::become(ViewSettings next) {
  // Runs go on with the seeds that they have: a step back is no run of before.
  for (size_t i = 0; i < panes_.size(); ++i)
    next.panes[i].config.seed = settings_.panes[i].config.seed;
  const bool isAnotherPicture = !isSamePicture(settings_, next);
  const PreparedScene shown = settings_.lights == next.lights ? prepared_ : litBy(next.lights);
  std::vector<std::unique_ptr<Session>> made(panes_.size());
  std::vector<Pane*> kept;
  bool isChanged = isAnotherPicture;
  for (size_t i = 0; i < panes_.size(); ++i) {
    const SessionConfig &before = settings_.panes[i].config, &after = next.panes[i].config;
    if (isSameMethod(before, after)) {
      kept.push_back(&panes_[i]);
    } else {
      made[i] = sessionOf(after, shown, next.camera);
    }
  }
  for (Pane* pane : kept) pane->session->setScene(shown.scene);
  const SessionConfig &sizeBefore = settings_.panes.front().config,
                      &sizeAfter = next.panes.front().config;
  if (!isSameSize(sizeBefore, sizeAfter)) resize(kept, sizeBefore, sizeAfter);
  for (size_t i = 0; i < panes_.size(); ++i) {
    const ParameterMap &before = settings_.panes[i].config.parameters,
                       &after = next.panes[i].config.parameters;
    isChanged = isChanged || made[i] || before != after;
    if (!made[i] && before != after) setParameters(panes_[i], next.panes[i].config);
  }
  for (Pane* pane : kept) pane->session->setCamera(next.camera);
  for (size_t i = 0; i < panes_.size(); ++i) {
    Pane& pane = panes_[i];
    if (made[i]) {
      pane.session = std::move(made[i]);
      pane.frames = 0;
    }
    const bool isNew = pane.frames == 0;
    const bool isTouched =
        isAnotherPicture || settings_.panes[i].config.parameters != next.panes[i].config.parameters;
    pane.isPlain = isNew || (pane.isPlain && !isTouched);
    pane.hasOldLight = !isNew && hasHistory(next.panes[i].config) &&
                       (pane.hasOldLight || settings_.lights != next.lights);
  }
  settings_ = std::move(next);
  prepared_ = shown;
  if (isChanged) beginEpoch(isAnotherPicture);
}

void LiveView::giveOwnSeed(size_t pane) {
  uint32_t& seed = settings_.panes[pane].config.seed;
  const auto isTaken = [&] {
    for (size_t i = 0; i < panes_.size(); ++i)
      if (i != pane && settings_.panes[i].config.seed == seed) return true;
    return false;
  };
  if (!isTaken()) return;
  while (isTaken()) ++seed;
  panes_[pane].session->reset(seed);
  panes_[pane].frames = 0;
  panes_[pane].isPlain = true;
  panes_[pane].hasOldLight = false;
}

void LiveView::restart() {
  for (size_t i = 0; i < panes_.size(); ++i) {
    panes_[i].session->reset(++settings_.panes[i].config.seed);
    panes_[i].frames = 0;
    panes_[i].isPlain = true;
    panes_[i].hasOldLight = false;
  }
  beginEpoch(false);
}

}  // namespace restlab
