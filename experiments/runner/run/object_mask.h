// Which pixels show an object.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image/mask.h"
#include "experiments/runner/run/prepare.h"

namespace restlab {

// 1 where the ray through the pixel's centre first meets one of the objects. An object is a name
// that instances of the scene have, or a number as in the AOV layer `object`. `config` gives camera
// and size; `camera`: instead of the scene's. Throws Error (badUsage) with the nearest name.
PixelMask pixelsOfObjects(const PreparedScene& prepared, SessionConfig config,
                          const std::vector<std::string>& objects,
                          const std::optional<SceneCamera>& camera = {});

}  // namespace restlab
