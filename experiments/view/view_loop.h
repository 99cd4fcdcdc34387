// The viewer at work: does what pages ask, renders while a page is open or tev listens, and shows
// what comes out.
// All of it happens on the thread that calls run(); the server's thread only queues.
//
// What pages ask for is done between rounds, a round being one frame of each pane: both show the
// same camera. A command that changes frames does not wait for a round that takes long: it is
// dropped as a whole, and no history, number or time knows of it. The one after it has kPatienceS
// before that: who drags sees frames. Samples of the reference are dropped in the same way.
//
// The reference gets samples between rounds, never inside of a timed frame, once the picture has
// stayed the same for kStillS, and then at most one second for every two of rounds; all of the time
// while panes are paused.
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

#include "experiments/view/tev_sender.h"
#include "experiments/view/view_sender.h"

namespace restlab {

class ViewLoop {
 public:
  static constexpr double kStillS = 0.5;
  static constexpr double kReferenceShare = 0.5;  // of the time of rounds
  // A round that takes less is waited for.
  static constexpr double kLongRoundS = 0.1;
  static constexpr double kPatienceS = 4.0;
  static constexpr uint64_t kMostReferenceSpp = uint64_t(1) << 20;
  // A page that has more to take gets no further picture.
  static constexpr size_t kMostUnreadBytes = 32 << 20;
  // Whoever knows the address can ask for files; so many are written.
  static constexpr uint32_t kMostSessions = 256;

  // Serves from here on. `saveFolder`: where sessions are written; empty: pages alone get them.
  // `tev`: who gets the images, too.
  ViewLoop(LiveView& view, ViewFacts facts, const ViewServerOptions& options,
           std::filesystem::path saveFolder, const std::optional<TevAddress>& tev = {});

  std::string url() const { return sender_.url(); }
  // Until stop(). Throws Error (interrupted) where a signal has come, and what a frame throws.
  void run();
  // From any thread.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  void take(const std::vector<PageEvent>& events);
  void welcome(ClientId page);
  // True where the state is another.
  bool obey(ClientId page, const ViewCommand& command);
  void change(const ViewCommand& command);
  void save(ClientId page, const std::string& name);
  std::string tooManySessions() const;

  // Says whether what renders is to end. For a while commands do not end it.
  LiveView::StopCheck stopCheck(double patienceS = 0.0) const;
  void renderRound();
  // True where a sample was due.
  bool refine();
  // What a page that somebody sees from now on has missed.
  void showAll();
  void showPanes();
  // Of panes that show no method: what pages have not seen.
  void showStanding(bool isUrgent);
  // No frame is due.
  bool isStanding() const { return isPaused_ || !view_.rendersAny() || measurement_.isRunning(); }
  // `restlab run` of what is set. Nothing renders meanwhile: times are those of a quiet machine.
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
  uint32_t filesWritten_ = 0;  // sessions
  Measurement measurement_;
  uint64_t withoutReference_ = 0;  // the picture that has no memory for one
  Clock::time_point changed_, pictureChanged_;
  double referenceCreditS_ = 0.0;
  double roundS_ = 0.0;      // of the last one
  bool wasDropped_ = false;  // the last one
  Clock::time_point referenceShown_;
  std::pair<uint64_t, uint64_t> shownReference_{0, 0};  // its epoch and samples
  struct Standing {
    uint64_t epoch = 0, count = 0;
    Clock::time_point time;
  };
  std::map<uint32_t, Standing> shownStanding_;  // by pane
  std::optional<TevSender> tev_;
  // Of each slot what tev has: connection, epoch and frames or samples.
  std::map<uint32_t, std::array<uint64_t, 3>> shownTev_;
};

}  // namespace restlab
