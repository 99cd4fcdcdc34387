// Triangles near the surface of a field.
#pragma once

#include "core/scene/field/program.h"
#include "core/scene/scene.h"

namespace restlab {

// A mesh with a vertex in each cell of a grid over the box through which the surface goes, seen
// from outside counter-clockwise. No triangles: no cell has both signs.
MeshGeometry fieldStandIn(const FieldProgram& program);

// Gives a stand-in the normals of the field; each triangle gets vertices of its own, so that edges
// of solids stay sharp. Where the field has no gradient, the triangle's normal.
void addFieldNormals(const FieldProgram& program, MeshGeometry& mesh);

}  // namespace restlab
