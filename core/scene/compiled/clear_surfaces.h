// Removal of surfaces that no ray can notice.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Removes instances that neither bend, tint, dim nor emit light: index of refraction 1 (within
// RL_CLEAR_CONTRAST), full transmission, white, no absorption. Such surfaces would cost rays time,
// and shadow rays would end at them. A solid that may meet another body stays, as it can displace
// that body's medium. A line in scene.warnings names the removed instances.
void leaveOutClearSurfaces(Scene& scene);

}  // namespace restlab
