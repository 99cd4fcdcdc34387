// The makers of the built-in scenes, one file each; builtin.cpp names them.
#pragma once

#include <optional>

#include "core/scene/scene.h"

namespace restlab::builtin {

Scene makeCornellBox();
Scene makeDoorAjar();
Scene makeManyLights();
Scene makeGlossyGallery();
Scene makeGlass();
Scene makeCourtyard();
Scene makeFurnace(double albedo);
// Lambert without a roughness, else metal that reflects everything.
Scene makeSphereFurnace(std::optional<double> roughness);
// `edge`: factor on the light's edges, at constant power.
Scene makeQuadLight(double edge);

}  // namespace restlab::builtin
