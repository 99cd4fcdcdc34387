// What a viewer shows as a suite: a file that `restlab view` opens and `restlab run` measures.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/view/view_messages.h"

namespace restlab {

// A scene and what is set in it; without a scene images alone.
struct ViewStart {
  SceneRequest request;
  PreparedScene prepared;
  ViewSettings settings;
  ViewImages images;
};

// Of a suite: the first scene, the first two methods that are rendered, the camera and the light of
// the measured frame. With one method the other pane has the average of path's frames. What panes
// show in the place of methods is in a table [view]; a file that holds no more shows images alone.
// Throws Error with the place of what is wrong; of images as readViewImages() does.
ViewStart startOfSuite(const std::filesystem::path& file, bool anyReference = false);

// Layers are not in it: no suite has any. Throws Error (badUsage) where a suite cannot say what is
// set: a camera that looks straight up or down. `name`: of the suite, and of its folder of results.
// Its reference gets the samples that the view's has, and kLeastReferenceSpp at least.
std::string sessionToml(const ViewFacts& facts, const LiveView& view, const std::string& name);
constexpr uint64_t kLeastReferenceSpp = 256;

// Of the scene and of now, as part of file names.
std::string sessionName(const LiveView& view);

// Of the panes' methods, each another one: "restir_gi (biased)", "path + accumulate".
std::vector<std::string> methodNames(const ViewSettings& settings);

// What panes show: the name of a method, "reference", or that of an image.
std::vector<std::string> paneNames(const LiveView& view);

// Throws Error (badInput) where methods are of another size than images beside them.
void requireSizeOf(const ViewImages& images, const ViewSettings& settings, bool hasScene);
// The same where images say that they are of another scene or setting than the methods.
void requireImagesOf(const ViewStart& start);

// The camera is not upright, as those of keyframes are: it is saved without its roll.
bool losesRoll(const LiveView& view);

}  // namespace restlab
