// Stores a viewer's settings as a suite: a file that `restlab view` opens and `restlab run`
// measures.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/view/view_messages.h"

namespace restlab {

// Scene and settings of a suite; without a scene only images.
struct ViewStart {
  SceneRequest request;
  PreparedScene prepared;
  ViewSettings settings;
  ViewImages images;
};

// Reads a suite: the first scene, the first two rendered methods, the camera and the light of the
// measured frame. With one method the other pane gets the average of path's frames. The table
// [view] says what panes show instead of methods; a file with only this table shows only images, by
// name or those of a folder of results.
// Throws Error with the place of a mistake; for images as readViewImages() does.
ViewStart startOfSuite(const std::filesystem::path& file, bool anyReference = false);

// Writes the suite. Layers are left out: suites have none. Throws Error (badUsage) if a suite
// cannot express the settings: a camera that looks straight up or down. `name`: name of the suite
// and of its folder of results. The suite's reference gets as many samples as the view's, at least
// kLeastReferenceSpp.
std::string sessionToml(const ViewFacts& facts, const LiveView& view, const std::string& name);
constexpr uint64_t kLeastReferenceSpp = 256;

// Name made of the scene and the time, for file names.
std::string sessionName(const LiveView& view);

// Distinct names of the panes' methods: "restir_gi (biased)", "path + accumulate".
std::vector<std::string> methodNames(const ViewSettings& settings);

// Names of what panes show: a method, "reference" or an image.
std::vector<std::string> paneNames(const LiveView& view);

// Throws Error (badInput) if methods have another size than the images beside them.
void requireSizeOf(const ViewImages& images, const ViewSettings& settings, bool hasScene);
// Throws if images say that they are of another scene or setting than the methods.
void requireImagesOf(const ViewStart& start);

// True if the camera has a roll, which is lost in the suite: keyframes are upright.
bool losesRoll(const LiveView& view);

}  // namespace restlab
