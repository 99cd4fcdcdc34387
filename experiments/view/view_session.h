// What a viewer shows as a suite: a file that `restlab view` opens and `restlab run` measures.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/view/view_messages.h"

namespace restlab {

// A scene and what is set in it.
struct ViewStart {
  SceneRequest request;
  PreparedScene prepared;
  ViewSettings settings;
};

// Of a suite: the first scene, the first two methods that are rendered, the camera and the light of
// the measured frame. With one method the other pane has the average of path's frames. Throws Error
// with the place of what is wrong.
ViewStart startOfSuite(const std::filesystem::path& file);

// Layers are not in it: no suite has any. Throws Error (badUsage) where a suite cannot say what is
// set: a camera that looks straight up or down.
std::string sessionToml(const ViewFacts& facts, const LiveView& view);

// Of the panes' methods, each another one: "restir_gi (biased)", "path + accumulate".
std::vector<std::string> methodNames(const ViewSettings& settings);

// The scene and the environment by names that work from any folder.
SceneRequest fromAnywhere(SceneRequest request);

// The camera is not upright, as those of keyframes are: it is saved without its roll.
bool losesRoll(const LiveView& view);

}  // namespace restlab
