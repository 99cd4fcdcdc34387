// Triangles of a huge mesh that pass near the camera, in pieces: the error of a point is that of
// its triangle's farthest corner.
#pragma once

#include <optional>

#include "core/scene/scene_origin.h"

namespace restlab {

struct SplitMesh {
  MeshGeometry mesh;                   // positions stay as they were; new ones are at their end
  std::vector<glm::dvec3> positionsW;  // of all vertices, metres, in the world
};

// Splits what reaches too far for its distance from the camera and from what the camera looks at.
// Nothing where no triangle does, which is so wherever `origin.viewSize` is 0. A face stays where
// it is; neighbours of pieces stay whole, so that an edge may have points on one side only.
std::optional<SplitMesh> splitHugeTriangles(const MeshGeometry& mesh, const glm::dmat4& toWorld,
                                            const SceneOrigin& origin);

}  // namespace restlab
