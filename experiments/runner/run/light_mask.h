// Which pixels show a light directly. On their edges the pixel filter alone makes an error that no
// method can lower in one frame, and that often outweighs all other errors together.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiments/runner/run/prepare.h"

namespace restlab {

// `camera`: instead of the scene's. One byte a pixel: 1 where none of 64 samples saw emission or
// environment directly. `config` gives scene, camera, size and filter.
std::vector<uint8_t> pixelsWithoutLights(const PreparedScene& prepared, SessionConfig config,
                                         const std::optional<SceneCamera>& camera = {});

}  // namespace restlab
