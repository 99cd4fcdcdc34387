#include "core/scene/gltf/mesh.h"

#include <fmt/format.h>

#include "core/scene/gltf/attributes.h"
#include "core/scene/gltf/material.h"
#include "core/scene/gltf/triangles.h"

namespace restlab::gltf {
namespace {

// Returns the vertices that the triangles use, in the accessors' order, and renumbers the
// triangles. A primitive that shares a large vertex buffer thus keeps only its own part.
std::vector<uint32_t> compactVertices(std::vector<glm::uvec3>& triangles, size_t vertexCount) {
  std::vector<uint32_t> renumbered(vertexCount, rl::RL_INVALID);
  for (const glm::uvec3& t : triangles) {
    for (int c = 0; c < 3; ++c) renumbered[t[c]] = 0;
  }
  std::vector<uint32_t> used;
  for (size_t i = 0; i < vertexCount; ++i) {
    if (renumbered[i] == rl::RL_INVALID) continue;
    renumbered[i] = static_cast<uint32_t>(used.size());
    used.push_back(static_cast<uint32_t>(i));
  }
  for (glm::uvec3& t : triangles) {
    t = {renumbered[t.x], renumbered[t.y], renumbered[t.z]};
  }
  return used;
}

}  // namespace

MeshImporter::MeshImporter(const Document& document, Scene& scene, Report& report)
    : document_(document),
      scene_(scene),
      report_(report),
      parts_(document.model.meshes.size()),
      finite_(document.model.accessors.size()) {}

std::optional<MeshGeometry> MeshImporter::decode(const tinygltf::Primitive& primitive,
                                                 const std::string& name,
                                                 const std::string& place) {
  const tinygltf::Model& model = document_.model;
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) {
    report_.warn("no positions", place, "has no POSITION attribute and is not drawn");
    return std::nullopt;
  }
  checkAttributes(model, primitive, place, report_);
  checkFinite(model, primitive, place, finite_, report_);
  const size_t vertexCount = model.accessors[static_cast<size_t>(position->second)].count;
  if (vertexCount >= rl::RL_INVALID) {
    report_.fail(place,
                 fmt::format("{} vertices; fewer than {} expected", vertexCount, rl::RL_INVALID));
  }
  // Check the memory first: many primitives may share one buffer, and each makes a copy.
  const size_t indexCount = primitive.indices < 0
                                ? vertexCount
                                : model.accessors[static_cast<size_t>(primitive.indices)].count;
  constexpr uint64_t kVertexBytes = 4 + sizeof(glm::vec3);  // renumbering and position
  constexpr uint64_t kIndexBytes = 4 + sizeof(glm::uvec3);
  report_.takeMemory(place, fmt::format("{} vertices and {} indices", vertexCount, indexCount),
                     vertexCount * kVertexBytes + indexCount * kIndexBytes);
  MeshGeometry geometry;
  geometry.name = name;
  geometry.triangles = readTriangles(model, primitive, vertexCount, place, report_);
  if (geometry.triangles.empty()) {
    report_.warn("no triangles", place, "holds no triangle and is not drawn");
    return std::nullopt;
  }
  const std::vector<uint32_t> used = compactVertices(geometry.triangles, vertexCount);
  readAttributes(model, primitive, used, place, geometry, report_);
  return geometry;
}

const std::vector<MeshImporter::Part>& MeshImporter::parts(size_t meshIndex) {
  std::optional<std::vector<Part>>& known = parts_[meshIndex];
  if (known) return *known;
  known.emplace();
  const tinygltf::Mesh& mesh = document_.model.meshes[meshIndex];
  const std::string meshName = mesh.name.empty() ? fmt::format("meshes[{}]", meshIndex) : mesh.name;
  for (size_t p = 0; p < mesh.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = mesh.primitives[p];
    const std::string place = fmt::format("meshes[{}].primitives[{}]", meshIndex, p);
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
      const bool isPoints = primitive.mode == TINYGLTF_MODE_POINTS;
      report_.warn("points and lines", place,
                   fmt::format("{} are not drawn", isPoints ? "points" : "lines"));
      ++scene_.skippedPrimitives;
      continue;
    }
    const auto [it, isNew] =
        geometries_.try_emplace(Key(primitive.attributes, primitive.indices, primitive.mode));
    if (isNew) {
      const std::string name =
          mesh.primitives.size() == 1 ? meshName : fmt::format("{}[{}]", meshName, p);
      added_.push_back(&it->second);
      if (std::optional<MeshGeometry> geometry = decode(primitive, name, place)) {
        it->second = static_cast<uint32_t>(scene_.geometries.size());
        scene_.geometries.push_back(std::move(*geometry));
      }
    }
    if (!it->second) continue;
    const uint32_t material = primitive.material >= 0
                                  ? static_cast<uint32_t>(primitive.material)
                                  : defaultMaterial(scene_, document_.model.materials.size());
    known->push_back({*it->second, material});
    warnMissingUvs(scene_.materials[material], scene_.geometries[*it->second], place);
  }
  return *known;
}

void MeshImporter::warnMissingUvs(const SceneMaterial& material, const MeshGeometry& geometry,
                                  const std::string& place) {
  std::vector<uint32_t> textures(std::begin(material.data.textures),
                                 std::end(material.data.textures));
  for (const ClosureValue& value : material.closure) textures.push_back(value.texture);
  for (const uint32_t texture : textures) {
    if (texture == rl::RL_INVALID) continue;
    const uint32_t set = scene_.textureUses[texture].uvSet;
    if (!geometry.uvs[set].empty()) continue;
    report_.warn("missing UVs", place,
                 fmt::format("has no TEXCOORD_{}, which its material '{}' reads; (0, 0) is used",
                             set, material.name));
    return;
  }
}

void MeshImporter::checkUnusedMeshes() {
  const size_t geometryCount = scene_.geometries.size(), materialCount = scene_.materials.size();
  const size_t skipped = scene_.skippedPrimitives;
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i]) continue;
    added_.clear();
    parts(i);
    // Reset to nullopt: nothing may refer to the dropped geometries, and other unused meshes need
    // not decode them again.
    for (std::optional<uint32_t>* geometry : added_) geometry->reset();
    scene_.geometries.resize(geometryCount);
    scene_.materials.resize(materialCount);
    scene_.skippedPrimitives = skipped;
  }
}

}  // namespace restlab::gltf
