// State of a viewer: methods on one camera that render frame by frame in turn, so that their times
// compare, and the reference of that view. A pane may also show the reference or the image of a
// file. It has no thread and no page of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene_file/scene_settings.h"
#include "experiments/view/live_reference.h"
#include "experiments/view/running_error.h"
#include "experiments/view/view_history.h"
#include "experiments/view/view_images.h"

namespace restlab {

class LiveView {
 public:
  // All panes have one size; the picture's settings are those of the first. `images`: files that
  // panes can show besides, of the picture set here.
  LiveView(const PreparedScene& prepared, ViewSettings settings, const ReferenceStore& store,
           ViewImages images = {});
  // Shows only images, a pane for each, with their reference if they have one; renders nothing.
  LiveView(ViewImages images, ViewSettings settings);
  // Uses the scene's camera and light.
  LiveView(const PreparedScene& prepared, const std::vector<SessionConfig>& panes,
           const ReferenceStore& store);

  // Runs a page's command. Throws Error with one line and leaves the settings unchanged. Commands
  // that change no picture (Pause, Look, Probe, SaveSession, ...) are ignored: the caller handles
  // them.
  void apply(const ViewCommand& command);

  // Drops the frame or sample if it returns true before the end (Session::frameUnless).
  using StopCheck = std::function<bool()>;
  // Renders the next frame of each seen pane that shows a method, in turn. Returns false if
  // dropped: then all panes are as if no frame had begun.
  bool renderFrames(const StopCheck& isStopped = {});
  // Renders the first frame of panes without one, as after a change of the method. Returns whether
  // there were any.
  bool renderFirstFrames(const StopCheck& isStopped = {});
  // Renders the next frames at width and height over `divisor`, while a hand moves the camera; 1:
  // whole size. Smaller frames are rendered by sessions of their own, with their own histories: the
  // histories of whole frames go on from the last one. Any other change than that of the camera
  // sets it back to 1.
  void setDivisor(uint32_t divisor);
  uint32_t divisor() const { return divisor_; }
  // Shortest side of a smaller frame, in pixels: a size that would be below is not divided further.
  static constexpr uint32_t kLeastMovingSide = 16;
  // Panes that are not seen render nothing. All are seen at first.
  void setSeen(size_t pane, bool isSeen) { panes_.at(pane).isSeen = isSeen; }
  bool isSeen(size_t pane) const { return panes_.at(pane).isSeen; }
  // Pane whose frame is under way and the done fraction of its work, for a callback of
  // renderFrames().
  std::pair<size_t, double> progress() const;
  // Adds one sample to the reference. Returns false if it was dropped.
  bool refineReference(const StopCheck& isStopped = {});
  // Takes a longer reference that another program has stored meanwhile; the numbers begin anew.
  void takeKeptReference();
  // Shows another table of the folder of results. Throws Error, as readResultsImages() does, and
  // changes nothing; (badUsage) if no folder of results is shown.
  void showTable(const std::string& name);
  // Stores the reference for other programs.
  void keepReference() { reference_.keep(); }

  // Changes with the picture or a method.
  uint64_t epoch() const { return epoch_; }
  // Epoch since which the pane shows what it does: numbers from before must not be mixed in. A
  // change of one pane's method leaves the others'.
  uint64_t begun(size_t pane) const { return panes_.at(pane).begun; }
  // Epoch since which the picture is the same: older images show another one.
  uint64_t pictureBegun() const { return pictureBegun_; }
  // Increases when the reference starts anew.
  uint64_t picture() const { return picture_; }
  // Whole frames of the pane since begun().
  uint64_t age(size_t pane) const { return panes_.at(pane).age; }
  size_t panes() const { return panes_.size(); }
  const ViewSettings& settings() const { return settings_; }
  const ViewHistory& history() const { return history_; }
  // Seed of the first session and of all references; restarts do not change it.
  uint32_t firstSeed() const { return firstSeed_; }
  // False if only images are shown: there is no scene, session or method.
  bool hasScene() const { return loaded_.scene != nullptr; }
  const PreparedScene& loaded() const { return loaded_; }
  const ViewImages& images() const { return images_; }
  // Names of everything that panes can show.
  std::vector<std::string> sources() const;
  // True if the pane shows a method.
  bool renders(size_t pane) const { return settings_.panes.at(pane).source == kMethodSource; }
  // True if a seen pane shows a method.
  bool rendersAny() const;
  // Image that the pane shows; null if there is none yet.
  const Image* picture(size_t pane) const;
  // Count behind the picture: frames of a method, samples of the reference, 1 for a file.
  uint64_t pictureCount(size_t pane) const;
  // Session of the pane's method at whole size, also while the pane shows something else.
  const Session& session(size_t pane) const { return *panes_.at(pane).session; }
  // Session of the pane's newest frame, which may be a smaller one.
  const Session& shownSession(size_t pane) const;
  // True if the pane's newest frame is a smaller one.
  bool isMoving(size_t pane) const { return panes_.at(pane).showsMoving; }
  const FrameStats& stats(size_t pane) const { return panes_.at(pane).stats; }
  // Frames since the history of the pane's newest frame began.
  uint64_t frames(size_t pane) const;
  // Epoch of the pane's last frame: a paused pane still shows an older one. The image of a file
  // belongs to the picture that was set at first; for any other picture its epoch is 0.
  uint64_t epochOf(size_t pane) const;
  // True if nothing was changed during the history: a session started with the current settings has
  // the same history.
  bool hasPlainHistory(size_t pane) const { return panes_.at(pane).isPlain; }
  const std::string& layer(size_t pane) const { return settings_.panes.at(pane).layer; }
  // True if the history began under another light and was not told of the change.
  bool hasOldLight(size_t pane) const {
    return panes_.at(pane).frames > 0 && panes_.at(pane).hasOldLight;
  }
  // Error of the frames of this epoch that had a reference.
  const RunningError& error(size_t pane) const { return panes_.at(pane).error; }
  const LiveReference& reference() const { return reference_; }
  // The [[material]] tables of a scene file, as loaded, and with the kinds that are set; none of
  // other scenes.
  const std::vector<ListedMaterial>& loadedMaterials() const { return loadedMaterials_; }
  const std::vector<ListedMaterial>& fileMaterials() const { return fileMaterials_; }
  // Scene with the materials and the light that are set.
  const PreparedScene& shown() const { return prepared_; }
  const SceneCamera& camera() const { return settings_.camera; }

 private:
  struct Pane {
    std::unique_ptr<Session> session;
    FrameStats stats;
    RunningError error;
    uint64_t frames = 0;
    uint64_t epoch = 0;  // epoch of the last frame
    uint64_t begun = 0, age = 0;
    bool isPlain = true, hasOldLight = false;
    bool isSeen = true;
    // Renders smaller frames; made when they are first wanted.
    std::unique_ptr<Session> moving;
    uint64_t movingFrames = 0, movingEpoch = 0;
    bool showsMoving = false;  // the last frame was a smaller one
  };

  // Counts a finished frame.
  void addFrame(Pane& pane, const FrameStats& stats);
  // Session that renders the pane's next frame. Throws Error as the constructor of Session does.
  Session& nextSession(size_t pane);
  void endMoving();
  const FileImage* imageOf(size_t pane) const;
  // Measures the errors of images against the current reference.
  void measureImages();
  std::unique_ptr<Session> sessionOf(const SessionConfig& config, const PreparedScene& shown,
                                     const SceneCamera& camera) const;
  // Bytes per pixel in host memory of a pane with `config`.
  size_t bytesPerPixelOf(size_t pane, const SessionConfig& config) const;
  // Bytes of host memory held by the panes.
  uint64_t heldBytes() const;
  // Throws Error (deviceUnavailable) if there is not enough memory for `next`.
  void requireMemory(const ViewSettings& next) const;
  static PreparedScene litBy(const PreparedScene& unlit, const LightFactors& lights);
  PreparedScene editedBy(const MaterialEdits& edits) const;
  // Restarts the numbers of a pane.
  void beginPane(Pane& pane);
  // Restarts the numbers of all panes; for another picture the reference, too.
  void beginEpoch(bool isAnotherPicture);
  void beginPicture();

  // Renders `next` from the next frame on; restores the old settings if this throws.
  void become(ViewSettings next);
  bool setParameters(Pane& pane, const SessionConfig& config);
  void resize(const std::vector<Pane*>& panes, const SessionConfig& before,
              const SessionConfig& after);
  void restart();
  // Gives the pane a seed that no other pane has: with an equal seed a copy would show equal noise.
  void giveOwnSeed(size_t pane);

  const PreparedScene loaded_;  // as it was loaded
  PreparedScene edited_;        // with the materials that are set and the light that was loaded
  PreparedScene prepared_;      // with the light that is shown
  std::vector<ListedMaterial> loadedMaterials_, fileMaterials_;
  ViewImages images_;
  ViewSettings settings_;
  ViewSettings first_;  // settings for which the images were made
  ViewHistory history_;
  std::vector<Pane> panes_;
  LiveReference reference_;
  // Fixed: a stored reference is found again after the panes restart with other seeds.
  uint32_t firstSeed_ = 1;
  uint64_t epoch_ = 0, picture_ = 0, pictureBegun_ = 0;
  uint32_t divisor_ = 1;
  size_t underWay_ = 0;  // pane whose frame is under way
};

// Settings of panes with default names filled in, the scene's camera and its light.
ViewSettings settingsOf(const PreparedScene& prepared, const std::vector<SessionConfig>& panes);
// A pane for each image.
ViewSettings settingsOf(const ViewImages& images);

}  // namespace restlab
