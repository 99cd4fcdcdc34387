// Cameras as Python names them.
#pragma once

#include <pybind11/pybind11.h>

#include "core/scene/scene.h"

namespace restlab::python {

// Returns `camera` with what the keywords say: position and target in metres, direction, up, yfov
// in degrees. `up` is that of the camera unless given. Throws Error (badUsage) naming the keyword.
SceneCamera cameraWith(const SceneCamera& camera, const pybind11::kwargs& keywords);

// Returns name, position, direction, up and yfov in degrees, unit vectors; None for the angle of an
// orthographic camera.
pybind11::dict cameraDict(const SceneCamera& camera);

}  // namespace restlab::python
