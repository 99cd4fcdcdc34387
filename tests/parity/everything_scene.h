// A scene of few triangles that needs every feature of a kernel.
#pragma once

#include "core/scene/scene.h"

namespace restlab::parity {

// The Cornell box with textures, a normal map, vertex colours, alpha, metal, glass with absorption,
// a mirrored second instance, punctual lights, an emissive texture and, through the missing wall, a
// sky.
Scene makeEverythingScene();

}  // namespace restlab::parity
