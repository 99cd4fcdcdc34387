// Mask of pixels that show a light directly. At their edges the pixel filter alone causes an error
// that no method can lower in one frame, and that often outweighs all other errors together.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiments/runner/suite/prepare.h"

namespace restlab {

// Returns one byte per pixel: 1 if none of 64 samples saw emission or environment directly.
// `config` gives scene, camera, size and filter. `camera`: replaces the scene's.
std::vector<uint8_t> pixelsWithoutLights(const PreparedScene& prepared, SessionConfig config,
                                         const std::optional<SceneCamera>& camera = {});

}  // namespace restlab
