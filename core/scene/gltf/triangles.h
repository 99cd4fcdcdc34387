// Triangles of one primitive, in terms of its vertices.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/gltf/document.h"
#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// Reads the triangles of a list, strip or fan with counter-clockwise fronts. All indices are below
// `vertexCount`. Fails on other indices; warns of incomplete triangles.
std::vector<glm::uvec3> readTriangles(const tinygltf::Model& model,
                                      const tinygltf::Primitive& primitive, size_t vertexCount,
                                      const std::string& place, Report& report);

}  // namespace restlab::gltf
