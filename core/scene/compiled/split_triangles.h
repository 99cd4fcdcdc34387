// Splitting of huge triangles that pass near the camera: the error of a point is that of its
// triangle's farthest corner.
#pragma once

#include <optional>

#include "core/scene/compiled/scene_origin.h"

namespace restlab {

struct SplitMesh {
  MeshGeometry mesh;                   // positions are kept; new ones follow at the end
  std::vector<glm::dvec3> positionsW;  // all vertices, metres, in the world
};

// Splits triangles that reach too far for their distance from the camera and from what it looks at.
// Returns nullopt if there are none, always if `origin.viewSize` is 0. The surface stays in place;
// neighbours of pieces stay whole, so that an edge may have points on one side only.
std::optional<SplitMesh> splitHugeTriangles(const MeshGeometry& mesh, const glm::dmat4& toWorld,
                                            const SceneOrigin& origin);

}  // namespace restlab
