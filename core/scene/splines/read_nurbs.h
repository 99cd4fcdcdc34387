// A NURBS surface from a table of a scene file.
#pragma once

#include "core/base/config.h"
#include "core/scene/splines/nurbs.h"

namespace restlab {

// Reads degree, size, points, weights, knots_u and knots_v. Without knots the surface is clamped
// and uniform, without weights they are 1. Throws Error (badUsage) at the key that is wrong.
NurbsSurface readNurbs(const ConfigTable& table);

}  // namespace restlab
