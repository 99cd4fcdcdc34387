#include "experiments/view/view_loop.h"

#include <fmt/format.h>

#include <stdlib.h>

#include <algorithm>
#include <new>
#include <optional>
#include <thread>

#include "core/backend/stop.h"
#include "core/error.h"
#include "core/method.h"
#include "experiments/runner/run/interrupt.h"
#include "experiments/view/view_session.h"
#include "experiments/view/view_session_file.h"

namespace restlab {

namespace {

using std::chrono::milliseconds;

// How long a signal may wait for, where there is nothing to do.
constexpr milliseconds kIdle{100}, kShort{20};
constexpr milliseconds kReferenceInterval{500};

double secondsSince(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

// Processes that want to run, for each thread of the machine.
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

// What has come of one page, read.
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
      patience = kIdle;
      if (!sender_.hasPages() && !(tev_ && tev_->connection() > 0)) continue;
      if (!isPaused_) renderRound();
      if (isPaused_ && view_.renderFirstFrames()) {
        showPanes();
        tellNumbers();
      }
      const bool isRefined = refine();
      showWhatIsExact();
      showTev();
      patience = isPaused_ && !isRefined ? kShort : milliseconds{0};
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
    if (event.kind == PageEvent::Kind::closed) sender_.closed(event.client);
    if (event.kind != PageEvent::Kind::said) continue;
    try {
      said.push_back({event.client, event.text, parseViewCommand(event.text)});
    } catch (const Error& error) {
      sender_.tell(event.client, errorText(error.what(), event.text));
    }
  }
  bool isOther = false;
  for (size_t i = 0; i < said.size(); ++i) {
    // Of a drag its end is enough.
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
  if (isOther) sender_.tellState(stateText(view_, isPaused_));
}

void ViewLoop::welcome(ClientId page) {
  // The first frame says how bright the page is to show it.
  if (view_.frames(0) == 0 && !isPaused_) view_.renderFrames();
  sender_.opened(page);
  sender_.tell(page, helloText(facts_, view_));
  sender_.tell(page, stateText(view_, isPaused_));
  showAll();
}

bool ViewLoop::obey(ClientId page, const ViewCommand& command) {
  if (const auto* look = std::get_if<Look>(&command)) {
    sender_.setSeen(page, look->on);
    if (look->on) showAll();
    return false;
  }
  if (const auto* probe = std::get_if<Probe>(&command)) {
    sender_.tell(page, probeText(facts_, view_, *probe));
    return false;
  }
  if (std::holds_alternative<SaveSession>(command)) {
    save(page);
    return false;
  }
  change(command);
  return true;
}

void ViewLoop::change(const ViewCommand& command) {
  if (const auto* pause = std::get_if<Pause>(&command)) {
    isPaused_ = pause->on;
    return;
  }
  const uint64_t epoch = view_.epoch(), picture = view_.picture();
  view_.apply(command);
  if (view_.epoch() != epoch) changed_ = Clock::now();
  if (view_.picture() != picture) {
    pictureChanged_ = changed_;
    referenceCreditS_ = 0.0;
  }
  if (isPaused_) showPanes();  // another layer, say
}

void ViewLoop::save(ClientId page) {
  const std::string toml = sessionToml(facts_, view_);
  std::string name = "session.toml";
  if (!saveFolder_.empty()) {
    try {
      name = writeSession(saveFolder_, toml);
      const std::string file = (saveFolder_ / name).lexically_normal().string();
      sender_.tell(page, saidText(fmt::format("{}: written", file)));
    } catch (const Error& error) {
      sender_.tell(page, saidText(fmt::format("{}; the page has the session", error.what())));
    }
  }
  sender_.tell(page, savedText(name, toml));
  if (losesRoll(view_))
    sender_.tell(page, saidText("the camera of the session is upright: no keyframe has a roll"));
}

void ViewLoop::renderRound() {
  const Clock::time_point start = Clock::now();
  view_.renderFrames();
  showPanes();
  tellNumbers();
  // What is saved up is spent at once where samples take longer than rounds, and is bounded.
  referenceCreditS_ = std::min(referenceCreditS_ + kReferenceShare * secondsSince(start), 60.0);
}

bool ViewLoop::refine() {
  const LiveReference& reference = view_.reference();
  // Rounds may be longer than that: who drags has said more meanwhile.
  if (secondsSince(pictureChanged_) < kStillS || events_.areWaiting()) return false;
  if (reference.spp() >= kMostReferenceSpp || view_.picture() == withoutReference_) return false;
  if (!isPaused_ && referenceCreditS_ < reference.sampleMs() / 1000.0) return false;
  const Clock::time_point start = Clock::now();
  try {
    view_.refineReference();
  } catch (const FrameStopped&) {
    throw;
  } catch (const std::exception& error) {  // two more sessions may find no memory
    withoutReference_ = view_.picture();
    sender_.tellAll(errorText(fmt::format("no reference of this picture: {}", error.what()), ""));
    return false;
  }
  if (!isPaused_) referenceCreditS_ = std::max(0.0, referenceCreditS_ - secondsSince(start));
  showReference(false);
  return true;
}

void ViewLoop::showAll() {
  showPanes();
  showReference(true);
  tellNumbers();
}

bool ViewLoop::isStill() const {
  return isPaused_ || (secondsSince(changed_) >= kStillS && !events_.areWaiting());
}

void ViewLoop::showPanes() {
  for (uint32_t i = 0; i < view_.panes(); ++i) {
    if (view_.frames(i) == 0) continue;
    ImageHeader header;
    header.slot = i;
    header.frame = uint32_t(view_.frames(i));
    header.epoch = view_.epochOf(i);
    sender_.show(header, view_.session(i).radiance(), isStill());
    if (view_.layer(i).empty()) continue;
    header.slot = kFirstLayerSlot + i;
    // Names are to the last bit: a rounded one is another.
    sender_.show(header, view_.session(i).aov(view_.layer(i)),
                 isStill() || isNameLayer(view_.settings().panes[i]));
  }
}

void ViewLoop::showReference(bool isUrgent) {
  const LiveReference& reference = view_.reference();
  const std::pair now{view_.epoch(), reference.spp()};
  if (!reference.isThere()) return;
  if (!isUrgent && (now == shownReference_ || Clock::now() - referenceShown_ < kReferenceInterval))
    return;
  ImageHeader header;
  header.slot = kReferenceSlot;
  header.frame = uint32_t(reference.spp());
  header.epoch = view_.epoch();
  sender_.show(header, reference.mean(), isStill());
  shownReference_ = now;
  referenceShown_ = Clock::now();
  if (isPaused_) tellNumbers();
}

// Panes that stand are shown to the last bit; the reference again after each change, as pages go by
// epochs.
void ViewLoop::showWhatIsExact() {
  if (isPaused_ && (sender_.isRounded(0) || sender_.isRounded(1))) showPanes();
  showReference(isStill() && sender_.isRounded(kReferenceSlot));
}

// What tev has not seen, where it is time for another image.
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
    show(i, fmt::format("restlab {}", char('A' + int(i))), view_.frames(i),
         [&]() -> const Image& { return view_.session(i).radiance(); });
  }
  const LiveReference& reference = view_.reference();
  show(kReferenceSlot, "restlab reference", reference.isThere() ? reference.spp() : 0,
       [&]() -> const Image& { return reference.mean(); });
}

void ViewLoop::tellNumbers() {
  sender_.tellNumbers(numbersText(view_, sender_.transport(), loadOfMachine()));
}

}  // namespace restlab
