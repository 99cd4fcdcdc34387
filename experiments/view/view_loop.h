// The viewer at work: does what pages ask, renders while a page is open or tev listens, and shows
// what comes out.
// All of it happens on the thread that calls run(); the server's thread only queues.
//
// What pages ask for is done between rounds, a round being one frame of each pane: both show the
// same camera. A command waits for a round at most, which is not ended in its middle: a history
// that lost half a frame would be none.
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
  static constexpr uint64_t kMostReferenceSpp = uint64_t(1) << 20;

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
  void save(ClientId page);

  void renderRound();
  // True where a sample was due.
  bool refine();
  // What a page that somebody sees from now on has missed.
  void showAll();
  void showPanes();
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
  uint64_t withoutReference_ = 0;  // the picture that has no memory for one
  Clock::time_point changed_, pictureChanged_;
  double referenceCreditS_ = 0.0;
  Clock::time_point referenceShown_;
  std::pair<uint64_t, uint64_t> shownReference_{0, 0};  // its epoch and samples
  std::optional<TevSender> tev_;
  // Of each slot what tev has: connection, epoch and frames or samples.
  std::map<uint32_t, std::array<uint64_t, 3>> shownTev_;
};

}  // namespace restlab
