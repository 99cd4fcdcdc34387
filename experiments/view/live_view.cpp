#include "experiments/view/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/frame/method.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/view/view_memory.h"

namespace restlab {

namespace {

bool hasHistory(const SessionConfig& config) {
  const Method method = findMethod(config);
  return method.hasHistory(resolveParameters(method, config.parameters));
}

// True if a size, a method or a parameter differs.
bool needsOtherMemory(const ViewSettings& a, const ViewSettings& b) {
  for (size_t i = 0; i < a.panes.size(); ++i) {
    const SessionConfig &before = a.panes[i].config, &after = b.panes[i].config;
    if (!isSameSize(before, after) || !isSameMethod(before, after) ||
        before.parameters != after.parameters)
      return true;
  }
  return false;
}

// Ignores layers and seeds.
bool differsInCameraAlone(const ViewSettings& a, const ViewSettings& b) {
  ViewSettings moved = a;
  moved.camera = b.camera;
  for (size_t i = 0; i < moved.panes.size(); ++i) moved.panes[i].layer = b.panes[i].layer;
  return isSame(moved, b);
}

std::optional<FrameStats> nextFrame(Session& session, const LiveView::StopCheck& isStopped) {
  return isStopped ? session.frameUnless(isStopped) : std::optional(session.frame());
}

}  // namespace

ViewSettings settingsOf(const PreparedScene& prepared, const std::vector<SessionConfig>& panes) {
  ViewSettings settings;
  for (const SessionConfig& config : panes) settings.panes.push_back({withNames(config), ""});
  settings.camera = prepared.scene->source().cameras.at(prepared.camera);
  return settings;
}

ViewSettings settingsOf(const ViewImages& images) {
  ViewSettings settings;
  for (const FileImage& one : images.list) {
    PaneSettings& pane = settings.panes.emplace_back();
    pane.config.width = one.image.width;
    pane.config.height = one.image.height;
    pane.source = one.name;
  }
  return settings;
}

LiveView::LiveView(const PreparedScene& prepared, const std::vector<SessionConfig>& panes,
                   const ReferenceStore& store)
    : LiveView(prepared, settingsOf(prepared, panes), store) {}

LiveView::LiveView(const PreparedScene& prepared, ViewSettings settings,
                   const ReferenceStore& store, ViewImages images)
    : loaded_(prepared),
      edited_(prepared),
      prepared_(prepared),
      images_(std::move(images)),
      settings_(std::move(settings)),
      first_(settings_),
      reference_(store) {
  firstSeed_ = settings_.firstSeed.value_or(settings_.panes.front().config.seed);
  loadedMaterials_ = materialsOf(loaded_, {});
  fileMaterials_ = materialsOf(loaded_, settings_.materials);
  edited_ = editedBy(settings_.materials);
  prepared_ = litBy(edited_, settings_.lights);
  requireMemory(settings_);
  for (const PaneSettings& pane : settings_.panes)
    panes_.emplace_back().session = sessionOf(pane.config, prepared_, settings_.camera);
  beginEpoch(true);
}

LiveView::LiveView(ViewImages images, ViewSettings settings)
    : images_(std::move(images)),
      settings_(std::move(settings)),
      first_(settings_),
      panes_(settings_.panes.size()),
      reference_(ReferenceStore{}) {
  if (images_.reference) reference_.show(*images_.reference);
  beginEpoch(true);
}

void LiveView::apply(const ViewCommand& command) {
  if (std::holds_alternative<Pause>(command) || std::holds_alternative<Look>(command) ||
      std::holds_alternative<AdaptMotion>(command) || std::holds_alternative<Probe>(command) ||
      std::holds_alternative<SaveSession>(command) || std::holds_alternative<Measure>(command) ||
      std::holds_alternative<CancelMeasure>(command) ||
      std::holds_alternative<SavePicture>(command))
    return;
  if (const auto* table = std::get_if<ShowTable>(&command)) return showTable(table->name);
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
  ViewChange change = changedBy(
      command, settings_, {hasScene() ? &loaded_.scene->source() : nullptr, sources(), firstSeed_});
  if (isSame(change.settings, settings_)) return;
  become(std::move(change.settings));
  history_.add(before, change.target, change.text);
  if (const auto* copy = std::get_if<CopyMethod>(&command)) giveOwnSeed(copy->to);
}

bool LiveView::renderFrames(const StopCheck& isStopped) {
  if (!rendersAny()) return true;
  struct Finished {
    Pane* pane;
    Session* session;
    FrameStats stats;
  };
  std::vector<Finished> finished;
  bool mayStop = true;
  for (size_t i = 0; i < panes_.size(); ++i) {
    if (!renders(i) || !isSeen(i)) continue;
    underWay_ = i;
    Session& session = nextSession(i);
    const auto stats = nextFrame(session, mayStop ? isStopped : StopCheck());
    if (!stats) {
      // Keep the panes in step: undo the frames of panes that have already rendered.
      for (const Finished& before : finished) before.session->takeBack();
      return false;
    }
    mayStop = mayStop && session.canTakeBack();
    finished.push_back({&panes_[i], &session, *stats});
  }
  for (const Finished& one : finished) addFrame(*one.pane, one.stats);
  return true;
}

bool LiveView::renderFirstFrames(const StopCheck& isStopped) {
  bool isAny = false;
  for (size_t i = 0; i < panes_.size(); ++i) {
    if (frames(i) > 0 || !renders(i) || !isSeen(i)) continue;
    underWay_ = i;
    const auto stats = nextFrame(nextSession(i), isStopped);
    if (!stats) break;
    addFrame(panes_[i], *stats);
    isAny = true;
  }
  return isAny;
}

void LiveView::setDivisor(uint32_t divisor) {
  const SessionConfig& size = settings_.panes.front().config;
  const uint32_t most = std::min(size.width, size.height) / kLeastMovingSide;
  divisor_ = std::clamp(divisor, 1u, std::max(1u, most));
}

Session& LiveView::nextSession(size_t i) {
  Pane& pane = panes_[i];
  if (divisor_ == 1) return *pane.session;
  SessionConfig config = settings_.panes[i].config;
  config.width /= divisor_;
  config.height /= divisor_;
  if (!pane.moving || !isSameSize(pane.moving->config(), config)) {
    pane.moving = sessionOf(config, prepared_, settings_.camera);
    pane.movingFrames = 0;
  }
  return *pane.moving;
}

std::pair<size_t, double> LiveView::progress() const {
  const Pane& pane = panes_.at(underWay_);
  const Session& session = divisor_ > 1 && pane.moving ? *pane.moving : *pane.session;
  return {underWay_, session.frameFraction()};
}

const Session& LiveView::shownSession(size_t pane) const {
  return isMoving(pane) ? *panes_[pane].moving : session(pane);
}

uint64_t LiveView::frames(size_t pane) const {
  const Pane& one = panes_.at(pane);
  return one.showsMoving ? one.movingFrames : one.frames;
}

void LiveView::addFrame(Pane& pane, const FrameStats& stats) {
  pane.stats = stats;
  pane.showsMoving = divisor_ > 1;
  ++(pane.showsMoving ? pane.movingFrames : pane.frames);
  (pane.showsMoving ? pane.movingEpoch : pane.epoch) = epoch_;
  if (!pane.showsMoving) ++pane.age;
  if (!reference_.hasImage() || pane.showsMoving) return;
  pane.error.add(pane.session->radiance(), reference_.mean(), reference_.half0(),
                 reference_.half1(), reference_.spp());
}

bool LiveView::refineReference(const StopCheck& isStopped) {
  if (!reference_.addSample(isStopped)) return false;
  measureImages();
  return true;
}

void LiveView::takeKeptReference() {
  if (reference_.takeKept()) beginEpoch(false);
}

void LiveView::showTable(const std::string& name) {
  if (images_.folder.empty()) failUsage("table: no folder of results is shown, which has tables");
  if (name.empty()) failUsage("table: the name is empty");
  if (name == images_.table) return;
  images_ = readResultsImages(images_.folder, name, images_.anyReference);
  settings_ = first_ = settingsOf(images_);
  panes_ = std::vector<Pane>(settings_.panes.size());
  reference_.show(*images_.reference);
  beginEpoch(true);
}

std::vector<std::string> LiveView::sources() const {
  std::vector<std::string> sources;
  if (hasScene()) sources.emplace_back(kMethodSource);
  if (hasScene() || images_.reference) sources.emplace_back(kReferenceSource);
  for (const FileImage& one : images_.list) sources.push_back(one.name);
  return sources;
}

bool LiveView::rendersAny() const {
  for (size_t i = 0; i < panes_.size(); ++i)
    if (renders(i) && isSeen(i)) return true;
  return false;
}

const FileImage* LiveView::imageOf(size_t pane) const {
  return images_.find(settings_.panes.at(pane).source);
}

const Image* LiveView::picture(size_t pane) const {
  if (renders(pane)) return frames(pane) > 0 ? &shownSession(pane).radiance() : nullptr;
  if (const FileImage* image = imageOf(pane)) return &image->image;
  return reference_.hasImage() ? &reference_.mean() : nullptr;
}

uint64_t LiveView::pictureCount(size_t pane) const {
  if (renders(pane)) return frames(pane);
  return imageOf(pane) != nullptr ? 1 : reference_.spp();
}

uint64_t LiveView::epochOf(size_t pane) const {
  if (renders(pane)) return isMoving(pane) ? panes_[pane].movingEpoch : panes_.at(pane).epoch;
  return imageOf(pane) == nullptr || isSamePicture(settings_, first_) ? epoch_ : 0;
}

void LiveView::measureImages() {
  for (size_t i = 0; i < panes_.size(); ++i) {
    const FileImage* image = imageOf(i);
    if (image == nullptr || epochOf(i) != epoch_ || !reference_.hasImage()) continue;
    panes_[i].error.restart();
    panes_[i].error.add(image->image, reference_.mean(), reference_.half0(), reference_.half1(),
                        reference_.spp());
  }
}

std::unique_ptr<Session> LiveView::sessionOf(const SessionConfig& config,
                                             const PreparedScene& shown,
                                             const SceneCamera& camera) const {
  auto session = std::make_unique<Session>(shown.scene, config);
  session->setCamera(camera);
  return session;
}

size_t LiveView::bytesPerPixelOf(size_t pane, const SessionConfig& config) const {
  const bool runsInPane = pane < panes_.size() &&
                          isSameMethod(settings_.panes[pane].config, config) &&
                          settings_.panes[pane].config.parameters == config.parameters;
  return runsInPane ? hostBytesPerPixel(session(pane), config.width, config.height)
                    : hostBytesPerPixelOf(loaded_, config);
}

uint64_t LiveView::heldBytes() const {
  uint64_t bytes = 0;
  for (const Pane& pane : panes_) {
    const SessionConfig& config = pane.session->config();
    const uint64_t pixels = uint64_t(config.width) * config.height;
    // A session that cannot take a frame back may still hold copies; they are not counted.
    bytes += pixels * hostBytesPerPixel(*pane.session, config.width, config.height) *
             (pane.session->canTakeBack() ? 2 : 1);
  }
  return bytes;
}

void LiveView::requireMemory(const ViewSettings& next) const {
  const SessionConfig& size = next.panes.front().config;
  const std::optional<uint64_t> available = availableMemory();
  if (fitsSurely(size.width, size.height, available)) return;
  std::vector<size_t> bytes;
  for (size_t i = 0; i < next.panes.size(); ++i)
    bytes.push_back(bytesPerPixelOf(i, next.panes[i].config));
  const SessionConfig half = referenceSession(loaded_, referenceConfigOf(size));
  requireViewMemory(size.width, size.height,
                    viewBytesPerPixel(bytes, hostBytesPerPixelOf(loaded_, half)),
                    heldBytes() + reference_.heldBytes(), available);
}

PreparedScene LiveView::editedBy(const MaterialEdits& edits) const {
  return edits.empty() ? loaded_ : withSettings(loaded_, settingsText(edits));
}

PreparedScene LiveView::litBy(const PreparedScene& unlit, const LightFactors& lights) {
  if (lights.empty()) return unlit;
  Scene scene = unlit.scene->source();
  std::string words;
  for (const auto& [name, factor] : absoluteLights(lights)) {
    scene = withLightFactor(std::move(scene), name, factor);
    words += fmt::format("{}{} x{}", words.empty() ? "" : ", ", name, factor);
  }
  return withLights(unlit, CompiledScene::build(std::move(scene)), words);
}

void LiveView::beginPane(Pane& pane) {
  pane.error.restart();
  pane.begun = epoch_;
  pane.age = 0;
}

void LiveView::beginEpoch(bool isAnotherPicture) {
  ++epoch_;
  for (Pane& pane : panes_) beginPane(pane);
  if (isAnotherPicture) beginPicture();
  measureImages();
}

void LiveView::beginPicture() {
  ++picture_;
  pictureBegun_ = epoch_;
  if (!hasScene()) return;
  ReferenceConfig config = referenceConfigOf(panes_.front().session->config());
  config.camera = settings_.camera;
  config.seed = firstSeed_;
  reference_.begin(prepared_, config);
}

void LiveView::endMoving() {
  divisor_ = 1;
  for (Pane& pane : panes_) {
    pane.moving.reset();
    pane.showsMoving = false;
  }
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
    // Go back to the old size, which had memory. If this fails, no session is usable: give up.
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

// Does everything that may throw first: new sessions, then changes that a kept session may refuse.
void LiveView::become(ViewSettings next) {
  // Keep the current seeds unless one is set: an undone step must not repeat an old run.
  for (size_t i = 0; i < panes_.size(); ++i)
    if (settings_.panes[i].seedsSet == next.panes[i].seedsSet)
      next.panes[i].config.seed = settings_.panes[i].config.seed;
  const bool isAnotherPicture = !isSamePicture(settings_, next);
  if (!differsInCameraAlone(settings_, next)) endMoving();
  // Other materials may need other kernels: sessions begin anew.
  const bool isEdited = settings_.materials != next.materials;
  const PreparedScene edited = isEdited ? editedBy(next.materials) : edited_;
  auto materials = isEdited ? materialsOf(loaded_, next.materials) : fileMaterials_;
  const PreparedScene shown =
      isEdited || settings_.lights != next.lights ? litBy(edited, next.lights) : prepared_;
  std::vector<std::unique_ptr<Session>> made(panes_.size());
  std::vector<Pane*> kept;
  std::vector<bool> isChanged(panes_.size(), isAnotherPicture);
  if (needsOtherMemory(settings_, next)) requireMemory(next);
  for (size_t i = 0; i < panes_.size(); ++i) {
    const SessionConfig &before = settings_.panes[i].config, &after = next.panes[i].config;
    if (isSameMethod(before, after) && !isEdited) {
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
    isChanged[i] = isChanged[i] || made[i] || before != after;
    if (!made[i] && before != after) setParameters(panes_[i], next.panes[i].config);
  }
  for (Pane* pane : kept) pane->session->setCamera(next.camera);
  for (Pane& pane : panes_)
    if (pane.moving) pane.moving->setCamera(next.camera);
  for (size_t i = 0; i < panes_.size(); ++i) {
    Pane& pane = panes_[i];
    if (made[i]) {
      pane.session = std::move(made[i]);
      pane.frames = 0;
    }
    if (settings_.panes[i].source != next.panes[i].source ||
        settings_.panes[i].seedsSet != next.panes[i].seedsSet) {
      pane.session->reset(next.panes[i].config.seed);
      pane.frames = 0;
      isChanged[i] = true;
    }
    const bool isNew = pane.frames == 0;
    const bool isTouched =
        isAnotherPicture || settings_.panes[i].config.parameters != next.panes[i].config.parameters;
    pane.isPlain = isNew || (pane.isPlain && !isTouched);
    pane.hasOldLight = !isNew && hasHistory(next.panes[i].config) &&
                       (pane.hasOldLight || settings_.lights != next.lights);
  }
  settings_ = std::move(next);
  fileMaterials_ = std::move(materials);
  edited_ = edited;
  prepared_ = shown;
  if (isAnotherPicture) return beginEpoch(true);
  if (std::find(isChanged.begin(), isChanged.end(), true) == isChanged.end()) return;
  ++epoch_;
  for (size_t i = 0; i < panes_.size(); ++i)
    if (isChanged[i]) beginPane(panes_[i]);
  measureImages();
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
  endMoving();
  panes_[pane].session->reset(seed);
  panes_[pane].frames = 0;
  panes_[pane].isPlain = true;
  panes_[pane].hasOldLight = false;
}

void LiveView::restart() {
  const bool isAny = std::any_of(settings_.panes.begin(), settings_.panes.end(),
                                 [](const PaneSettings& p) { return p.source == kMethodSource; });
  if (!isAny) failUsage("restart: no pane shows a method");
  endMoving();
  for (size_t i = 0; i < panes_.size(); ++i) {
    panes_[i].session->reset(++settings_.panes[i].config.seed);
    panes_[i].frames = 0;
    panes_[i].isPlain = true;
    panes_[i].hasOldLight = false;
  }
  beginEpoch(false);
}

}  // namespace restlab
