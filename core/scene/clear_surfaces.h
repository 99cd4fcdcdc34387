// Surfaces that no ray can notice.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Takes out instances that neither bend, tint, dim nor emit light: an index of refraction of 1
// (within RL_CLEAR_CONTRAST), all transmission, white, no absorption. Rays would pay for them, and
// shadow rays end at any surface that transmits. A solid that may meet another body stays, as it
// can displace that body's medium. One line in scene.warnings names what was taken out.
void leaveOutClearSurfaces(Scene& scene);

}  // namespace restlab
