// Strands of Mitsuba's scenes: lines "x y z radius" in a text file.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "core/scene/mitsuba/mesh_files.h"

namespace restlab::mitsuba {

bool isCurveFile(const std::string& type);

// Reads strands with their points taken to the world; radii stay as they are, as Mitsuba's do. The
// shape has its middle at the origin, for precision, and belongs at `centre`. Throws Error
// (badInput).
MeshGeometry readCurves(const Bytes& bytes, const std::string& file, const std::string& type,
                        const glm::dmat4& pointsToWorld, glm::dvec3& centre);

}  // namespace restlab::mitsuba
