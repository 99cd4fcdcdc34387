#include "experiments/view/picture_file.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/health_sum.h"
#include "experiments/view/view_session.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

// RAII: path of a temporary EXR, removed with the object. EXR files can only be written to a disk.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (fs::temp_directory_path() / "restlab-view-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      failInput(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
    folder_ = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  fs::path path() const { return folder_ / "picture.exr"; }

 private:
  fs::path folder_;
};

std::string bytesOf(const fs::path& file) {
  std::ifstream is(file, std::ios::binary);
  if (!is) failInput(fmt::format("{}: {}", file.string(), unreadableReason(file)));
  return {std::istreambuf_iterator<char>(is), {}};
}

bool isReference(const LiveView& view, size_t image) {
  return image >= view.panes() || view.settings().panes[image].source == kReferenceSource;
}

LayeredImage frameOf(const LiveView& view, size_t pane) {
  const Session& session = view.session(pane);
  const FrameStats& stats = view.stats(pane);
  const PreparedScene& shown = view.shown();
  LayeredImage file;
  file.layers[""] = session.radiance();
  auto& metadata = file.metadata = describe(shown, session.config());
  if (!isSameCamera(shown.scene->source().cameras.at(shown.camera), view.camera()))
    describeCamera(view.camera(), metadata);
  metadata.merge(provenanceWords());
  HealthSum health;
  health.add(stats);
  const std::string last = std::to_string(view.frames(pane) - 1);
  metadata["device"] = session.device();
  metadata["ray_tracing"] = session.rayTracing();
  metadata["kind"] = "image";
  metadata["seed"] = std::to_string(view.settings().panes[pane].config.seed);
  metadata["spp"] = "1";
  metadata["warmup_frames"] = metadata["frame"] = last;
  metadata["render_time_s"] = fmt::format("{:.6g}", stats.timeMs / 1000.0);
  metadata["health"] = health.text();
  metadata["features_needed"] = featureNames(session.featuresNeeded());
  metadata["features_left_out"] = featureNames(rl::RL_FEATURE_ALL & ~session.featuresUsed());
  if (!view.hasPlainHistory(pane))
    metadata["history"] = "camera, light or parameters were changed while it went on";
  return file;
}

}  // namespace

std::string pictureName(const LiveView& view, size_t image) {
  const bool isPane = image < view.panes();
  const std::string scene =
      view.hasScene() ? view.loaded().scene->source().name : std::string("image");
  const std::string name =
      !isPane           ? std::string(kReferenceSource)
      : view.hasScene() ? fmt::format("{}-{}", char('A' + int(image)), paneNames(view)[image])
                        : paneNames(view)[image];
  return safeFileName(fmt::format("{}-{}", scene, name)) + ".exr";
}

std::string pictureBytes(const LiveView& view, size_t image) {
  if (const FileImage* file =
          image < view.panes() ? view.images().find(view.settings().panes[image].source) : nullptr)
    return bytesOf(file->file);
  const TemporaryFile file;
  if (isReference(view, image)) {
    if (view.images().reference && !view.hasScene()) return bytesOf(view.images().referenceFile);
    if (!view.reference().hasImage()) failUsage("picture: there is no reference yet");
    writeReference(file.path(), view.reference().whole());
  } else {
    if (view.frames(image) == 0) failUsage("picture: no frame was rendered yet");
    if (view.isMoving(image))
      failUsage("picture: the camera moves, and the frame is smaller; ask when it rests");
    writeExr(file.path(), frameOf(view, image));
  }
  return bytesOf(file.path());
}

}  // namespace restlab
