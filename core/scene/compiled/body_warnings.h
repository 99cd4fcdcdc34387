// Warnings about bodies that a path cannot follow as the author meant.
#pragma once

#include <string>
#include <vector>

#include "core/scene/compiled/bodies.h"
#include "core/scene/scene.h"

namespace restlab {

// Returns warnings about: closed bodies whose faces point inwards; more nested bodies than a list
// of media holds; orthographic cameras whose film lies in several media; lights without area that
// do not reach what lies behind a transmitting surface.
std::vector<std::string> bodyWarnings(const Scene& scene, const Bodies& bodies);

}  // namespace restlab
