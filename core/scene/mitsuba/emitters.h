// Emitters: lamps without area, and what surrounds the scene.
#pragma once

#include "core/scene/mitsuba/textures.h"

namespace restlab::mitsuba {

// Adds an emitter of the scene itself. Those of shapes are read by areaEmission().
void addEmitter(const Element& element, const Context& context);

// Radiance of an area emitter.
TexturedColor areaEmission(const Element& element, const Context& context, Textures& textures);

}  // namespace restlab::mitsuba
