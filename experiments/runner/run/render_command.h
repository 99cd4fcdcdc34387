// A command line that renders something again.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/run/prepare.h"

namespace restlab {

// The scene and the environment by names that work from any folder.
SceneRequest fromAnywhere(SceneRequest request);

// `render` with scene, camera and environment of the request, size and light of `picture` and the
// method of `method`, as this program was called. Seed, frame and output are left to the caller.
std::vector<std::string> renderWords(const SceneRequest& request, const SessionConfig& picture,
                                     const SessionConfig& method);

}  // namespace restlab
