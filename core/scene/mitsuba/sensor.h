// Sensors as cameras. Mitsuba's look along +Z, with +X to the left of the image.
#pragma once

#include "core/scene/mitsuba/parameters.h"

namespace restlab::mitsuba {

void addSensor(const Element& element, const Context& context);

}  // namespace restlab::mitsuba
