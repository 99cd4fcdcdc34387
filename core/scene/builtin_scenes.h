// The makers of the built-in scenes, one file each; builtin.cpp names them.
#pragma once

#include "core/scene/scene.h"

namespace restlab::builtin {

Scene makeCornellBox();
Scene makeDoorAjar();
Scene makeManyLights();
Scene makeGlossyGallery();
Scene makeGlass();
Scene makeCourtyard();
Scene makeFurnace();
Scene makeSphereFurnace();
Scene makeQuadLight();

}  // namespace restlab::builtin
