// Builds a command line that renders an image again.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/suite/prepare.h"

namespace restlab {

// Replaces the scene and the environment by names that work from any folder.
SceneRequest fromAnywhere(SceneRequest request);

// Returns `render` with scene, camera and environment of the request, size and light of `picture`
// and the method of `method`, starting with this program's name. The caller adds seed, frame and
// output.
std::vector<std::string> renderWords(const SceneRequest& request, const SessionConfig& picture,
                                     const SessionConfig& method);

}  // namespace restlab
