// Shapes as fine meshes, for files and checks that know triangles alone.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// A mesh of the shape in its own space, 128 segments around, with the normals and the texture
// coordinates of the shape. Of a kind that is not known here: the triangles that stand in for it.
MeshGeometry fineMesh(const ShapeGeometry& shape);

}  // namespace restlab
