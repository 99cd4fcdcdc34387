// Shapes as kernels and hierarchies see them.
#pragma once

#include <vector>

#include "core/backend/embree.h"
#include "core/dialect/types.h"
#include "core/scene/scene.h"

namespace restlab {

// The record of a shape, whose parameters are appended to `words`.
rl::Geometry shapeRecord(const ShapeGeometry& shape, std::vector<glm::uvec4>& words);

// Box in world space of each instance of a shape, moved out by the rounding error of a ray's
// transform; not set for others.
std::vector<RTCBounds> boxesOfShapes(const Scene& scene,
                                     const std::vector<rl::Geometry>& geometries,
                                     const std::vector<rl::Instance>& instances);

// Embree's geometry of one instance of a shape. `box` must live as long as it.
RTCGeometry newShape(RTCDevice device, const RTCBounds& box);

}  // namespace restlab
