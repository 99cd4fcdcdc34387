// Mask of pixels that show an object.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image/metrics/mask.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab {

// Returns 1 for a pixel if the ray through its centre first hits one of the objects. An object is a
// name of instances in the scene, or a number as in the AOV layer `object`. `config` gives camera
// and size; `camera`: replaces the scene's. Throws Error (badUsage) with the nearest name.
PixelMask pixelsOfObjects(const PreparedScene& prepared, SessionConfig config,
                          const std::vector<std::string>& objects,
                          const std::optional<SceneCamera>& camera = {});

}  // namespace restlab
