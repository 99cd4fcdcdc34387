// What a viewer shows: methods on one camera, which render frame by frame in turn so that their
// times compare, and the reference of that view. It has no thread and no page of its own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/view/command.h"
#include "experiments/view/live_reference.h"
#include "experiments/view/running_error.h"

namespace restlab {

class LiveView {
 public:
  // One configuration a pane, of one size; what they say of the picture is that of the first.
  LiveView(const PreparedScene& prepared, const std::vector<SessionConfig>& panes,
           const ReferenceStore& store);

  // Does what a page asks. Throws Error in one line; everything is then as it was. Pause and Probe
  // change no picture and are the caller's.
  void apply(const ViewCommand& command);

  // The next frame of each pane, one after the other.
  void renderFrames();
  // One more sample of the reference.
  void refineReference() { reference_.addSample(); }

  // Another number: another picture or method, whose numbers are not those of before.
  uint64_t epoch() const { return epoch_; }
  size_t panes() const { return panes_.size(); }
  const Session& session(size_t pane) const { return *panes_.at(pane).session; }
  const FrameStats& stats(size_t pane) const { return panes_.at(pane).stats; }
  const std::string& layer(size_t pane) const { return panes_.at(pane).layer; }
  // Of the frames since the epoch began for which there was a reference.
  const RunningError& error(size_t pane) const { return panes_.at(pane).error; }
  const LiveReference& reference() const { return reference_; }
  const SceneCamera& camera() const { return camera_; }

 private:
  struct Pane {
    SessionConfig config;
    std::unique_ptr<Session> session;
    FrameStats stats;
    RunningError error;
    std::string layer;
  };

  Pane& paneOf(uint32_t index);
  std::unique_ptr<Session> sessionOf(const SessionConfig& config) const;
  // Numbers begin anew; of another picture the reference does, too.
  void beginEpoch(bool isAnotherPicture);

  void change(const SetSetting& command);
  void change(const SetParameter& command);
  void change(const MoveCamera& command);
  void change(const Resize& command);
  void change(const SetLight& command);
  void change(const ShowLayer& command);
  void change(const Restart& command);
  void change(const Probe&) {}
  void change(const Pause&) {}

  const PreparedScene loaded_;                          // with the light that was loaded
  PreparedScene prepared_;                              // with that which is shown
  std::vector<std::pair<std::string, double>> lights_;  // factors, in the order of their setting
  SceneCamera camera_;
  std::vector<Pane> panes_;
  LiveReference reference_;
  uint64_t epoch_ = 0;
};

}  // namespace restlab
