// A scene in which nothing mirrors and nothing is seen through.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Returns the scene with materials that scatter diffusely alone. Of glTF's lobes the Lambert one
// stays, with the share that metal and transmission leave it (of a texture: its mean). `mirror`,
// `power_lobe` and `conductor` become black; other closures, and bodies that scatter inside, stay.
Scene matteScene(Scene scene);

}  // namespace restlab
