// Vertex attributes of one primitive.
#pragma once

#include <string>
#include <vector>

#include "core/scene/gltf/document.h"
#include "core/scene/gltf/report.h"
#include "core/scene/scene.h"

namespace restlab::gltf {

// Fails unless every attribute has a format that glTF or KHR_mesh_quantization allows and as many
// elements as POSITION. Warns of attributes that are not read, and of those that need
// KHR_mesh_quantization without declaring it.
void checkAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                     const std::string& place, Report& report);

// Fails if an attribute that is read holds NaN or infinity, naming the vertex. `finite` marks the
// accessors already checked.
void checkFinite(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                 const std::string& place, std::vector<bool>& finite, Report& report);

// Fills positions, normals, tangents, colours and UVs of `geometry` from the vertices `used`
// (indices into the accessors); geometry.triangles index into the result. Normals get unit length;
// zero ones take the direction of the triangles around them, with a warning.
void readAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                    const std::vector<uint32_t>& used, const std::string& place,
                    MeshGeometry& geometry, Report& report);

}  // namespace restlab::gltf
