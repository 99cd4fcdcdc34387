// Main loop of the viewer: runs the pages' commands, renders while a page is open or tev listens,
// and sends the images. All of it happens on the thread that calls run(); the server's thread only
// queues.
//
// While a hand moves the camera frames are smaller (moving_size.h), and panes that no page shows
// render nothing.
//
// A round is one frame of each pane; commands run between rounds, so that both panes show the same
// camera. A command that changes frames drops a long round as a whole: no history, number or time
// knows of it. The next round then has kPatienceS before it is dropped, so that a drag shows
// frames. Samples of the reference are dropped in the same way.
//
// The reference gets samples between rounds, never inside a timed frame, once the picture has
// stayed the same for kStillS. It gets at most one second for every two of rounds, or all of the
// time while panes are paused.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/view/moving_size.h"
#include "experiments/view/tev_sender.h"
#include "experiments/view/view_sender.h"

namespace restlab {

class ViewLoop {
 public:
  static constexpr double kStillS = 0.5;
  static constexpr double kReferenceShare = 0.5;  // fraction of the time of rounds
  // Shorter rounds are never dropped.
  static constexpr double kLongRoundS = 0.1;
  static constexpr double kPatienceS = 4.0;
  static constexpr uint64_t kMostReferenceSpp = uint64_t(1) << 20;
  // A page with more unread bytes gets no further picture file.
  static constexpr size_t kMostUnreadBytes = 32 << 20;
  // Limit of written sessions: anyone with the address can ask for files.
  static constexpr uint32_t kMostSessions = 256;

  // Serves from here on. `saveFolder`: folder for sessions; empty: only pages get them. `tev`: also
  // gets the images.
  ViewLoop(LiveView& view, ViewFacts facts, const ViewServerOptions& options,
           std::filesystem::path saveFolder, const std::optional<TevAddress>& tev = {});

  std::string url() const { return sender_.url(); }
  // Runs until stop(). Throws Error (interrupted) on a signal, and what a frame throws.
  void run();
  // Callable from any thread.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  void take(const std::vector<PageEvent>& events);
  void welcome(ClientId page);
  // Returns true if the state has changed.
  bool obey(ClientId page, const ViewCommand& command);
  void change(const ViewCommand& command);
  void save(ClientId page, const std::string& name);
  std::string tooManySessions() const;

  // Returns a check that says whether rendering is to end. Commands do not end it within
  // `patienceS`.
  LiveView::StopCheck stopCheck(double patienceS = 0.0) const;
  // As stopCheck(); also tells pages how far a long frame is.
  LiveView::StopCheck tellingStopCheck(double patienceS);
  void renderRound();
  bool renderFrames(const LiveView::StopCheck& isStopped);
  void answerProbes();
  // True if a pane in view shows a smaller frame or another camera, which even a paused one
  // replaces.
  bool owesFrame() const;
  // Lets panes render that a visible page shows.
  void applySeen();
  // Adds a sample to the reference. Returns true if one was due.
  bool refine();
  // Sends everything that a page has missed while hidden.
  void showAll();
  void showPanes();
  // Sends new images of panes that show no method.
  void showStanding(bool isUrgent);
  // True if no frame is due.
  bool isStanding() const {
    return (isPaused_ && !owesFrame()) || !view_.rendersAny() || measurement_.isRunning();
  }
  // Runs `restlab run` on the current settings. Nothing renders meanwhile: its times need a quiet
  // machine.
  void measure(const std::string& name);
  void followMeasurement();
  void showReference(bool isUrgent);
  void showWhatIsExact();
  void showTev();
  void tellNumbers();
  bool isStill() const;

  LiveView& view_;
  const ViewFacts facts_;
  const std::filesystem::path saveFolder_;
  PageEvents events_;
  ViewSender sender_;
  std::atomic<bool> isStopped_{false};
  bool isPaused_ = false;
  uint64_t movedEpoch_ = 0;  // epoch of the last move of the camera
  MovingSize movingSize_;
  std::map<std::pair<ClientId, uint32_t>, Probe> waitingProbes_;  // by pane, asked while it moves
  uint32_t lastDivisor_ = 1;                                      // of the last round
  uint32_t filesWritten_ = 0;                                     // saved sessions
  Measurement measurement_;
  uint64_t withoutReference_ = 0;  // picture whose reference has no memory
  Clock::time_point changed_, pictureChanged_;
  double referenceCreditS_ = 0.0;
  bool wasDropped_ = false;  // the last round was dropped
  Clock::time_point referenceShown_;
  std::pair<uint64_t, uint64_t> shownReference_{0, 0};  // epoch and samples
  struct Standing {
    uint64_t epoch = 0, count = 0;
    Clock::time_point time;
  };
  std::map<uint32_t, Standing> shownStanding_;  // by pane
  std::optional<TevSender> tev_;
  // Images that tev has, by slot: connection, epoch and frames or samples.
  std::map<uint32_t, std::array<uint64_t, 3>> shownTev_;
};

}  // namespace restlab
