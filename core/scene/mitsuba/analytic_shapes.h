// Shapes of Mitsuba that are given by formulas. Curved ones are fine meshes here, with the normals
// of the formula.
#pragma once

#include <string>

#include "core/scene/scene.h"

namespace restlab::mitsuba {

// Returns whether the shape is rectangle, disk, sphere, cylinder or cube.
bool isAnalytic(const std::string& type);
// Returns whether its mesh is an approximation.
bool isCurved(const std::string& type);

// The shape in its own space: rectangle and cube from -1 to 1, disk and sphere of radius 1, an open
// cylinder of radius 1 from z = 0 to 1. Texture coordinates are Mitsuba's.
MeshGeometry analyticShape(const std::string& type);

}  // namespace restlab::mitsuba
