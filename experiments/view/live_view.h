// What a viewer shows: methods on one camera, which render frame by frame in turn so that their
// times compare, and the reference of that view; in the place of a method also the reference or the
// image of a file. It has no thread and no page of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/view/live_reference.h"
#include "experiments/view/running_error.h"
#include "experiments/view/view_history.h"
#include "experiments/view/view_images.h"

namespace restlab {

class LiveView {
 public:
  // Of one size; what panes say of the picture is that of the first. `images`: what panes can show
  // besides, of the picture as it is set here.
  LiveView(const PreparedScene& prepared, ViewSettings settings, const ReferenceStore& store,
           ViewImages images = {});
  // Images alone, with their reference where they have one: nothing renders.
  LiveView(ViewImages images, ViewSettings settings);
  // The scene's camera and light.
  LiveView(const PreparedScene& prepared, const std::vector<SessionConfig>& panes,
           const ReferenceStore& store);

  // Does what a page asks. Throws Error in one line; what is set is then as it was. Pause, Look,
  // Probe and SaveSession change no picture and are the caller's.
  void apply(const ViewCommand& command);

  // A frame or a sample is dropped where it holds before the end (Session::frameUnless).
  using StopCheck = std::function<bool()>;
  // The next frame of each pane that shows a method, one after the other. False where they were
  // dropped: all of them, and everything is as if none had begun.
  bool renderFrames(const StopCheck& isStopped = {});
  // That of panes which have none, as after a change of the method. Returns whether there were any.
  bool renderFirstFrames(const StopCheck& isStopped = {});
  // One more sample of the reference. False where it was dropped.
  bool refineReference(const StopCheck& isStopped = {});
  // For other programs.
  void keepReference() { reference_.keep(); }

  // Another number: another picture or method, whose numbers are not those of before.
  uint64_t epoch() const { return epoch_; }
  // Rises where the reference begins anew.
  uint64_t picture() const { return picture_; }
  // Frames of each pane since the epoch began.
  uint64_t age() const { return age_; }
  size_t panes() const { return panes_.size(); }
  const ViewSettings& settings() const { return settings_; }
  const ViewHistory& history() const { return history_; }
  // Of the first session, and of all references: whatever began anew since.
  uint32_t firstSeed() const { return firstSeed_; }
  // False: images alone are shown, and there is no scene, session or method.
  bool hasScene() const { return loaded_.scene != nullptr; }
  const PreparedScene& loaded() const { return loaded_; }
  const ViewImages& images() const { return images_; }
  // What panes can show.
  std::vector<std::string> sources() const;
  // The pane shows a method.
  bool renders(size_t pane) const { return settings_.panes.at(pane).source == kMethodSource; }
  bool rendersAny() const;
  // What the pane shows; null while it has none.
  const Image* picture(size_t pane) const;
  // Of the picture: frames of a method, samples of the reference, 1 of a file.
  uint64_t pictureCount(size_t pane) const;
  // Of the method that the pane has, also while it shows something else.
  const Session& session(size_t pane) const { return *panes_.at(pane).session; }
  const FrameStats& stats(size_t pane) const { return panes_.at(pane).stats; }
  // Since its history began.
  uint64_t frames(size_t pane) const { return panes_.at(pane).frames; }
  // That in which the pane's last frame was rendered: a pane that is paused shows what was.
  // An image of a file is of the picture that was set at first, and 0 in others.
  uint64_t epochOf(size_t pane) const;
  // A history in which nothing was changed: that of a session which began with what is set.
  bool hasPlainHistory(size_t pane) const { return panes_.at(pane).isPlain; }
  const std::string& layer(size_t pane) const { return settings_.panes.at(pane).layer; }
  // Its history began with other light than there is now, and knows nothing of the change.
  bool hasOldLight(size_t pane) const {
    return panes_.at(pane).frames > 0 && panes_.at(pane).hasOldLight;
  }
  // Of the frames since the epoch began for which there was a reference.
  const RunningError& error(size_t pane) const { return panes_.at(pane).error; }
  const LiveReference& reference() const { return reference_; }
  // With the light that is set.
  const PreparedScene& shown() const { return prepared_; }
  const SceneCamera& camera() const { return settings_.camera; }

 private:
  struct Pane {
    std::unique_ptr<Session> session;
    FrameStats stats;
    RunningError error;
    uint64_t frames = 0;
    uint64_t epoch = 0;  // of the last frame
    bool isPlain = true, hasOldLight = false;
  };

  // A whole frame counts from here on.
  void addFrame(Pane& pane, const FrameStats& stats);
  const FileImage* imageOf(size_t pane) const;
  // Errors of images, against the reference as it is.
  void measureImages();
  std::unique_ptr<Session> sessionOf(const SessionConfig& config, const PreparedScene& shown,
                                     const SceneCamera& camera) const;
  // Bytes in the host's memory, of a pane with that configuration.
  size_t bytesPerPixelOf(size_t pane, const SessionConfig& config) const;
  // Bytes that the panes hold in the host's memory.
  uint64_t heldBytes() const;
  // Throws Error (deviceUnavailable) where there is no memory for all of what is to be shown.
  void requireMemory(const ViewSettings& next) const;
  PreparedScene litBy(const LightFactors& lights) const;
  // Numbers begin anew; of another picture the reference does, too.
  void beginEpoch(bool isAnotherPicture);

  // Renders what is set there from the next frame on; where that throws, what was set before.
  void become(ViewSettings next);
  bool setParameters(Pane& pane, const SessionConfig& config);
  void resize(const std::vector<Pane*>& panes, const SessionConfig& before,
              const SessionConfig& after);
  void restart();
  // A seed that no other pane has: a copy with the same one would show the same noise.
  void giveOwnSeed(size_t pane);

  const PreparedScene loaded_;  // with the light that was loaded
  PreparedScene prepared_;      // with that which is shown
  const ViewImages images_;
  ViewSettings settings_;
  const ViewSettings first_;  // the picture of the images
  ViewHistory history_;
  std::vector<Pane> panes_;
  LiveReference reference_;
  // One that is kept is found again after the panes began anew, with other seeds.
  uint32_t firstSeed_ = 1;
  uint64_t epoch_ = 0, picture_ = 0, age_ = 0;
};

// The panes' settings with the names that are there where none was given, the scene's camera and
// its light.
ViewSettings settingsOf(const PreparedScene& prepared, const std::vector<SessionConfig>& panes);
// The first two images, or the only one and its reference.
ViewSettings settingsOf(const ViewImages& images);

}  // namespace restlab
