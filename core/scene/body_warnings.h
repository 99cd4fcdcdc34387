// Warnings about bodies that a path cannot follow as their author meant.
#pragma once

#include <string>
#include <vector>

#include "core/scene/bodies.h"
#include "core/scene/scene.h"

namespace restlab {

// Lines about: closed bodies whose faces point inwards; more bodies inside each other than a list
// of media holds; orthographic cameras whose film lies in several media; lamps without an area,
// whose light does not reach what lies behind a surface that transmits.
std::vector<std::string> bodyWarnings(const Scene& scene, const Bodies& bodies);

}  // namespace restlab
