// Mesh primitives: triangles of lists, strips and fans, and their vertex attributes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/scene/gltf/document.h"
#include "core/scene/gltf/report.h"
#include "core/scene/scene.h"

namespace restlab::gltf {

class MeshImporter {
 public:
  // One drawable primitive of a mesh.
  struct Part {
    uint32_t geometry;
    uint32_t material;
  };

  // The scene's materials must be those of the document, in the same order.
  MeshImporter(const Document& document, Scene& scene, Report& report);

  // Returns the drawable primitives of a mesh, decoded into the scene's geometries at the first
  // call. Primitives of the same accessors share a geometry, whatever their materials.
  const std::vector<Part>& parts(size_t mesh);

  // Decodes meshes that no node uses, to report their faults, and drops the result.
  void checkUnusedMeshes();

 private:
  // Attributes, indices and mode: determine the geometry of a primitive.
  using Key = std::tuple<std::map<std::string, int>, int, int>;

  std::optional<MeshGeometry> decode(const tinygltf::Primitive& primitive, const std::string& name,
                                     const std::string& place);
  void warnMissingUvs(const SceneMaterial& material, const MeshGeometry& geometry,
                      const std::string& place);

  const Document& document_;
  Scene& scene_;
  Report& report_;
  std::vector<std::optional<std::vector<Part>>> parts_;
  std::map<Key, std::optional<uint32_t>> geometries_;  // nullopt: not drawable
  std::vector<std::optional<uint32_t>*> added_;        // entries of geometries_ that one mesh added
  std::vector<bool> finite_;                           // accessors known to hold finite numbers
};

}  // namespace restlab::gltf
