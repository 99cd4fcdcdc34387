// Normals of meshes from their faces.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Gives each vertex the mean normal of the faces around it, weighted by their angles there. Faces
// that meet at an edge under more than `degrees` (0 to 180, between their normals) do not share
// one: vertices at such an edge are doubled. Vertices in one place count as one, as at the seams of
// textures. Faces that cancel out keep the normal of one of them;
// faces without an area join no others and take a neighbour's.
void smoothNormals(MeshGeometry& mesh, double degrees);

// Takes the normals away, so that faces are flat.
void flattenNormals(MeshGeometry& mesh);

}  // namespace restlab
