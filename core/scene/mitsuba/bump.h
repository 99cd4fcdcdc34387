// Heights of a bump map as a map of normals. Its slopes are metres over metres, so it is made for
// the surface that it lies on.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/scene.h"

namespace restlab::mitsuba {

// A surface by its texture coordinates.
struct UvScale {
  glm::dvec2 metres{1.0};  // for a step of 1 in u and in v, on average over the area
  double side = 1.0;       // -1: v runs to the right of u, seen from the front
  double spread = 1.0;     // largest over smallest size of a triangle's coordinates
};
// `toWorld`: of the mesh. Without texture coordinates, the default.
UvScale uvScaleOf(const MeshGeometry& mesh, const glm::dmat4& toWorld);

// Normals, as bytes of glTF's normal maps, of heights in metres: `scale` times the red channel of
// the image as `use` reads it.
TextureImage normalsOf(const TextureUse& use, const TextureImage& heights, double scale,
                       const UvScale& surface);

}  // namespace restlab::mitsuba
