// Parts of the loop for a moved camera, panes in view and long frames.
#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "core/base/error.h"
#include "experiments/view/view_loop.h"

namespace restlab {

namespace {

double elapsedS(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

LiveView::StopCheck ViewLoop::tellingStopCheck(double patienceS) {
  constexpr double kLongS = 0.4, kIntervalS = 0.25;
  const auto start = Clock::now();
  auto told = std::make_shared<Clock::time_point>(start);  // the check is copied
  const auto thread = std::this_thread::get_id();
  return [this, check = stopCheck(patienceS), start, told, thread] {
    // Only this thread sends; with others it would race.
    if (std::this_thread::get_id() == thread && elapsedS(start) >= kLongS &&
        elapsedS(*told) >= kIntervalS) {
      *told = Clock::now();
      const auto [pane, fraction] = view_.progress();
      sender_.tellProgress(progressText(pane, view_.frames(pane) + 1, fraction));
    }
    return check();
  };
}

void ViewLoop::answerProbes() {
  for (const auto& [key, probe] : std::exchange(waitingProbes_, {})) {
    const ClientId page = key.first;
    try {
      sender_.tell(page, probeText(facts_, view_, probe));
    } catch (const Error& error) {
      sender_.tell(page, errorText(error.what(), ""));
    }
  }
}

bool ViewLoop::owesFrame() const {
  for (size_t i = 0; i < view_.panes(); ++i) {
    if (!view_.renders(i) || !view_.isSeen(i) || view_.frames(i) == 0) continue;
    if (view_.isMoving(i) || view_.epochOf(i) < movedEpoch_) return true;
  }
  return false;
}

void ViewLoop::applySeen() {
  const uint64_t seen = tev_ ? ~uint64_t(0) : sender_.seenPanes();
  bool isOther = false;
  for (size_t i = 0; i < std::min<size_t>(view_.panes(), 64); ++i) {
    const bool isSeen = (seen >> i & 1) != 0;
    isOther = isOther || isSeen != view_.isSeen(i);
    view_.setSeen(i, isSeen);
  }
  if (isOther) movingSize_.rendered(1, 0.0);  // rounds take another time now
}

}  // namespace restlab
