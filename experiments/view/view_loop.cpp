#include "experiments/view/view_loop.h"

#include <fmt/format.h>

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <thread>

#include "core/backend/stop.h"
#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/view/picture_file.h"
#include "experiments/view/view_session.h"
#include "experiments/view/view_session_file.h"

namespace restlab {

namespace {

using std::chrono::milliseconds;

// Longest wait for events when there is nothing to do; a signal may have to wait as long.
constexpr milliseconds kIdle{100}, kShort{20};
constexpr milliseconds kReferenceInterval{500};

double secondsSince(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

// Load average per thread of the machine.
double loadOfMachine() {
  double average = 0.0;
  const double threads = std::max(1u, std::thread::hardware_concurrency());
  return getloadavg(&average, 1) == 1 ? average / threads : std::nan("");
}

bool isNameLayer(const PaneSettings& pane) {
  const std::vector<const LayerInfo*> layers = findMethod(pane.config).layers();
  return pane.layer == "object" ||
         std::any_of(layers.begin(), layers.end(), [&](const LayerInfo* layer) {
           return layer->isName && layer->name == pane.layer;
         });
}

// Parsed message of a page.
struct Said {
  ClientId page = 0;
  std::string text;
  ViewCommand command;
};

}  // namespace

ViewLoop::ViewLoop(LiveView& view, ViewFacts facts, const ViewServerOptions& options,
                   std::filesystem::path saveFolder, const std::optional<TevAddress>& tev)
    : view_(view),
      facts_(std::move(facts)),
      saveFolder_(std::move(saveFolder)),
      sender_(options, events_),
      changed_(Clock::now()),
      pictureChanged_(changed_) {
  if (tev) tev_.emplace(*tev);
}

void ViewLoop::run() {
  milliseconds patience{0};
  try {
    while (!isStopped_) {
      throwIfInterrupted("the viewer ends");
      take(events_.take(patience));
      followMeasurement();
      patience = kIdle;
      if (!sender_.hasPages() && !(tev_ && tev_->connection() > 0)) continue;
      if (!isStanding()) renderRound();
      if (isStanding() && !measurement_.isRunning() && view_.renderFirstFrames(stopCheck())) {
        showPanes();
        tellNumbers();
      }
      const bool isRefined = refine();
      showWhatIsExact();
      showTev();
      patience = isStanding() && !isRefined ? kShort : milliseconds{0};
    }
  } catch (const FrameStopped&) {
    throwIfInterrupted("the viewer ends");
    throw;
  }
}

void ViewLoop::stop() {
  isStopped_ = true;
  events_.wake();
}

void ViewLoop::take(const std::vector<PageEvent>& events) {
  std::vector<Said> said;
  for (const PageEvent& event : events) {
    if (event.kind == PageEvent::Kind::opened) welcome(event.client);
    if (event.kind == PageEvent::Kind::closed) {
      sender_.closed(event.client);
      std::erase_if(waitingProbes_,
                    [&](const auto& waiting) { return waiting.first.first == event.client; });
      applySeen();
    }
    if (event.kind != PageEvent::Kind::said) continue;
    try {
      said.push_back({event.client, event.text, parseViewCommand(event.text)});
    } catch (const Error& error) {
      sender_.tell(event.client, errorText(error.what(), event.text));
    }
  }
  bool isOther = false;
  for (size_t i = 0; i < said.size(); ++i) {
    // Run only the last of consecutive commands on one target, such as a drag.
    const std::string target = targetOf(said[i].command);
    if (!target.empty() && i + 1 < said.size() && targetOf(said[i + 1].command) == target) continue;
    try {
      isOther = obey(said[i].page, said[i].command) || isOther;
    } catch (const Error& error) {
      sender_.tell(said[i].page, errorText(error.what(), said[i].text));
    } catch (const std::bad_alloc&) {
      sender_.tell(said[i].page, errorText("out of memory", said[i].text));
    }
  }
  if (events_.takeLost())
    sender_.tellAll(errorText("commands come faster than they can be done: some were lost", ""));
  if (!isOther) return;
  sender_.tellState(stateText(view_, {isPaused_, movingSize_.isAdaptive()}));
  if (isStanding()) tellNumbers();
}

void ViewLoop::welcome(ClientId page) {
  // Render a first frame: the exposure in hello is computed from it.
  if (view_.frames(0) == 0 && !isStanding()) view_.renderFrames();
  sender_.opened(page);
  applySeen();
  sender_.tell(page, helloText(facts_, view_));
  sender_.tell(page, stateText(view_, {isPaused_, movingSize_.isAdaptive()}));
  showAll();
  if (measurement_.state() != Measurement::State::none)
    sender_.tell(page, measureText(measurement_));
}

bool ViewLoop::obey(ClientId page, const ViewCommand& command) {
  if (const auto* look = std::get_if<Look>(&command)) {
    const bool wasHidden = sender_.isHidden(page);
    sender_.setSeen(page, look->on, look->panes);
    applySeen();
    if (look->on && wasHidden) showAll();
    return false;
  }
  if (const auto* probe = std::get_if<Probe>(&command)) {
    if (probe->pane < view_.panes() && view_.isMoving(probe->pane)) {
      waitingProbes_[{page, probe->pane}] = *probe;
    } else {
      sender_.tell(page, probeText(facts_, view_, *probe));
    }
    return false;
  }
  if (const auto* session = std::get_if<SaveSession>(&command)) {
    save(page, session->name);
    return false;
  }
  if (const auto* picture = std::get_if<SavePicture>(&command)) {
    if (const size_t bytes = sender_.bytesUnread(page); bytes > kMostUnreadBytes) {
      failUsage(fmt::format(
          "picture: the page has not taken {} MiB that it asked for; ask again when it has",
          bytes >> 20));
    }
    sender_.tell(page,
                 fileText(pictureName(view_, picture->image), pictureBytes(view_, picture->image)));
    return false;
  }
  if (const auto* wanted = std::get_if<Measure>(&command)) {
    measure(wanted->name);
    return false;
  }
  if (std::holds_alternative<CancelMeasure>(command)) {
    measurement_.cancel();
    return false;
  }
  if (measurement_.isRunning())
    failUsage("a measurement is under way, and nothing renders beside it; cancel it first");
  change(command);
  return true;
}

void ViewLoop::change(const ViewCommand& command) {
  if (const auto* pause = std::get_if<Pause>(&command)) {
    isPaused_ = pause->on;
    return;
  }
  if (const auto* adapt = std::get_if<AdaptMotion>(&command))
    return movingSize_.setAdaptive(adapt->on);
  const auto* set = std::get_if<SetSetting>(&command);
  const bool isPreparing = set != nullptr && set->key != "source";
  if (isPreparing) sender_.tellProgress(preparingText());
  const uint64_t epoch = view_.epoch(), picture = view_.picture();
  const SceneCamera camera = view_.camera();
  try {
    view_.apply(command);
  } catch (...) {
    // A state ends what pages say of the preparation.
    if (isPreparing) sender_.tellState(stateText(view_, {isPaused_, movingSize_.isAdaptive()}));
    throw;
  }
  if (view_.epoch() != epoch) changed_ = Clock::now();
  if (!isSameCamera(camera, view_.camera())) movedEpoch_ = view_.epoch();
  if (std::holds_alternative<MoveCamera>(command) && view_.epoch() != epoch) {
    // Smaller frames show the move: a whole one before them may be dropped at once.
    if (movingSize_.isAdaptive() && !movingSize_.isMoving(changed_)) wasDropped_ = false;
    movingSize_.move(changed_);
  }
  if (view_.picture() != picture) {
    pictureChanged_ = changed_;
    referenceCreditS_ = 0.0;
  }
  if (isPaused_) showPanes();  // such as another layer
}

void ViewLoop::measure(const std::string& name) {
  if (measurement_.isRunning()) failUsage("measure: one is under way; cancel it first");
  if (!view_.hasScene()) failUsage("measure: images of files are shown, and nothing is rendered");
  if (saveFolder_.empty()) failUsage("measure: there is no folder for its results");
  if (filesWritten_ >= kMostSessions) failUsage(fmt::format("measure: {}", tooManySessions()));
  const std::string suite =
      freeSessionName(saveFolder_, name.empty() ? sessionName(view_) : safeFileName(name));
  writeTextFile(saveFolder_ / (suite + ".toml"), sessionToml(facts_, view_, suite));
  ++filesWritten_;
  // Store the reference: the run need not render its samples again.
  view_.keepReference();
  const std::filesystem::path program =
      facts_.program.empty() ? std::filesystem::read_symlink("/proc/self/exe") : facts_.program;
  measurement_.begin(program, saveFolder_, suite + ".toml", resultsOfSession(suite).string());
  sender_.tellAll(measureText(measurement_));
}

void ViewLoop::followMeasurement() {
  if (!measurement_.poll()) return;
  if (!measurement_.isRunning()) {
    view_.takeKeptReference();
    sender_.tellState(stateText(view_, {isPaused_, movingSize_.isAdaptive()}));
  }
  if (measurement_.state() == Measurement::State::finished) {
    std::ifstream file(measurement_.report(), std::ios::binary);
    sender_.setReport({std::istreambuf_iterator<char>(file), {}});
  }
  sender_.tellAll(measureText(measurement_));
}

std::string ViewLoop::tooManySessions() const {
  return fmt::format("this viewer has written {} sessions, which is the most; start another one",
                     filesWritten_);
}

void ViewLoop::save(ClientId page, const std::string& given) {
  std::string stem = given.empty() ? "session" : safeFileName(given);
  const bool isWritten = !saveFolder_.empty() && filesWritten_ < kMostSessions;
  if (isWritten) stem = freeSessionName(saveFolder_, stem);
  const std::string toml = sessionToml(facts_, view_, given.empty() ? sessionName(view_) : stem);
  const std::string name = stem + ".toml";
  if (!saveFolder_.empty() && !isWritten)
    sender_.tell(page, saidText(tooManySessions() + "; the page has the session"));
  if (isWritten) {
    try {
      const std::string file = (saveFolder_ / name).lexically_normal().string();
      writeTextFile(file, toml);
      ++filesWritten_;
      sender_.tell(page, saidText(fmt::format("{}: written", file)));
    } catch (const Error& error) {
      sender_.tell(page, saidText(fmt::format("{}; the page has the session", error.what())));
    }
  }
  sender_.tell(page, savedText(name, toml));
  if (losesRoll(view_))
    sender_.tell(page, saidText("the camera of the session is upright: no keyframe has a roll"));
}

LiveView::StopCheck ViewLoop::stopCheck(double patienceS) const {
  return [this, patienceS, start = Clock::now()] {
    return isStopped_ || (events_.areChangesWaiting() && secondsSince(start) >= patienceS);
  };
}

void ViewLoop::renderRound() {
  const Clock::time_point start = Clock::now();
  view_.setDivisor(movingSize_.divisor(start));
  const uint32_t divisor = view_.divisor();
  bool isNew = false;    // a first frame may take any time
  bool isFirst = false;  // sessions of smaller frames may have to be made
  for (size_t i = 0; i < view_.panes(); ++i) {
    if (!view_.renders(i) || !view_.isSeen(i)) continue;
    isNew = isNew || view_.frames(i) == 0;
    isFirst = isFirst || (divisor > 1 && (!view_.isMoving(i) || divisor != lastDivisor_));
  }
  const double lastS = movingSize_.roundS(divisor);
  const bool isShort = !isNew && lastS > 0.0 && lastS < kLongRoundS;
  wasDropped_ = !renderFrames(isShort ? LiveView::StopCheck()
                                      : tellingStopCheck(wasDropped_ ? kPatienceS : 0.0));
  if (wasDropped_) return;
  lastDivisor_ = divisor;
  if (!isFirst) movingSize_.rendered(divisor, secondsSince(start));
  if (divisor == 1) answerProbes();
  showPanes();
  tellNumbers();
  // Credit is spent at once if samples take longer than rounds; bound it.
  referenceCreditS_ = std::min(referenceCreditS_ + kReferenceShare * secondsSince(start), 60.0);
}

bool ViewLoop::renderFrames(const LiveView::StopCheck& isStopped) {
  try {
    return view_.renderFrames(isStopped);
  } catch (const Error& error) {
    if (view_.divisor() == 1 || error.code() == ExitCode::interrupted) throw;
    movingSize_.setAdaptive(false);
    view_.setDivisor(1);
    sender_.tellAll(errorText(fmt::format("no smaller frames: {}", error.what()), ""));
    sender_.tellState(stateText(view_, {isPaused_, false}));
    return false;
  }
}

bool ViewLoop::refine() {
  const LiveReference& reference = view_.reference();
  if (!view_.hasScene() || measurement_.isRunning()) return false;
  if (isPaused_ && owesFrame()) return false;
  // Rounds may be longer than kStillS: a drag may have sent more commands meanwhile.
  if (secondsSince(pictureChanged_) < kStillS || events_.areWaiting()) return false;
  if (reference.spp() >= kMostReferenceSpp || view_.picture() == withoutReference_) return false;
  if (!isStanding() && referenceCreditS_ < reference.sampleMs() / 1000.0) return false;
  const Clock::time_point start = Clock::now();
  try {
    if (!view_.refineReference(stopCheck())) return false;
  } catch (const FrameStopped&) {
    throw;
  } catch (const std::exception& error) {  // two more sessions may find no memory
    withoutReference_ = view_.picture();
    sender_.tellAll(errorText(fmt::format("no reference of this picture: {}", error.what()), ""));
    return false;
  }
  if (!isStanding()) referenceCreditS_ = std::max(0.0, referenceCreditS_ - secondsSince(start));
  showReference(false);
  return true;
}

void ViewLoop::showAll() {
  showPanes();
  showStanding(true);
  showReference(true);
  tellNumbers();
}

bool ViewLoop::isStill() const {
  if (movingSize_.isMoving(Clock::now())) return false;
  return isStanding() || (secondsSince(changed_) >= kStillS && !events_.areWaiting());
}

void ViewLoop::showPanes() {
  for (uint32_t i = 0; i < view_.panes(); ++i) {
    if (view_.frames(i) == 0 || !view_.renders(i)) continue;
    ImageHeader header;
    header.slot = i;
    header.frame = uint32_t(view_.frames(i));
    header.epoch = view_.epochOf(i);
    sender_.show(header, view_.shownSession(i).radiance(), isStill());
    if (view_.layer(i).empty()) continue;
    header.slot = kFirstLayerSlot + i;
    // Name layers (IDs) must be exact: a rounded ID is another one.
    sender_.show(header, view_.shownSession(i).aov(view_.layer(i)),
                 isStill() || isNameLayer(view_.settings().panes[i]));
  }
}

void ViewLoop::showStanding(bool isUrgent) {
  for (uint32_t i = 0; i < view_.panes(); ++i) {
    const Image* picture = view_.renders(i) ? nullptr : view_.picture(i);
    if (picture == nullptr) continue;
    ImageHeader header;
    header.slot = i;
    header.frame = uint32_t(view_.pictureCount(i));
    header.epoch = view_.epochOf(i);
    if (!view_.hasScene()) {
      sender_.showOnce(header, *picture);
      continue;
    }
    Standing& shown = shownStanding_[i];
    const bool isNew = shown.epoch != view_.epoch();
    const bool isOther = shown.count != header.frame || (isStill() && sender_.isRounded(i));
    const bool isDue = isOther && Clock::now() - shown.time >= kReferenceInterval;
    if (!isUrgent && !isNew && !isDue) continue;
    sender_.show(header, *picture, isStill());
    shown = {view_.epoch(), header.frame, Clock::now()};
  }
}

void ViewLoop::showReference(bool isUrgent) {
  const LiveReference& reference = view_.reference();
  const std::pair now{view_.epoch(), reference.spp()};
  if (!reference.hasImage()) return;
  if (!isUrgent && (now == shownReference_ || Clock::now() - referenceShown_ < kReferenceInterval))
    return;
  ImageHeader header;
  header.slot = kReferenceSlot;
  header.frame = uint32_t(reference.spp());
  header.epoch = view_.epoch();
  if (view_.hasScene()) {
    sender_.show(header, reference.mean(), isStill());
  } else {
    sender_.showOnce(header, reference.mean());
  }
  shownReference_ = now;
  referenceShown_ = Clock::now();
  if (isStanding()) tellNumbers();
}

// Sends exact images of panes that stand still. Sends the reference again after each change: pages
// match images by epoch.
void ViewLoop::showWhatIsExact() {
  if (isPaused_ && (sender_.isRounded(0) || sender_.isRounded(1))) showPanes();
  showStanding(false);
  showReference(isStill() && sender_.isRounded(kReferenceSlot));
}

// Sends tev the images that it has not seen, if it is time for another one.
void ViewLoop::showTev() {
  if (!tev_) return;
  const uint64_t connection = tev_->connection();
  const auto show = [&](uint32_t slot, const std::string& name, uint64_t count,
                        const auto& imageOf) {
    const std::array now{connection, view_.epoch(), count};
    if (count == 0 || shownTev_[slot] == now || !tev_->takes(name)) return;
    tev_->show(name, imageOf());
    shownTev_[slot] = now;
  };
  for (uint32_t i = 0; i < view_.panes(); ++i) {
    show(i,
         "restlab " + (view_.hasScene() ? std::string(1, char('A' + int(i)))
                                        : view_.settings().panes[i].source),
         view_.picture(i) != nullptr ? view_.pictureCount(i) : 0,
         [&]() -> const Image& { return *view_.picture(i); });
  }
  const LiveReference& reference = view_.reference();
  show(kReferenceSlot, "restlab reference", reference.hasImage() ? reference.spp() : 0,
       [&]() -> const Image& { return reference.mean(); });
}

void ViewLoop::tellNumbers() {
  sender_.tellNumbers(numbersText(view_, sender_.transport(), loadOfMachine()));
}

}  // namespace restlab
