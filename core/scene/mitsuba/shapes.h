// Shapes, groups of shapes and their instances.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/scene/mitsuba/bsdf.h"

namespace restlab::mitsuba {

class Shapes {
 public:
  Shapes(const Context& context, Textures& textures, Bsdfs& bsdfs)
      : context_(context), textures_(textures), bsdfs_(bsdfs) {}

  // Adds a shape of the scene: its mesh, once for all that share it, and an instance.
  void add(const Element& element);

 private:
  // File or plugin, index of the shape in it, face normals, flipped, flipped coordinates, tangents.
  using MeshKey = std::tuple<std::string, size_t, bool, bool, bool, bool>;

  void addShape(const Element& element, const glm::dmat4& groupToWorld, const std::string& name);
  void addInstances(const Element& element);
  uint32_t meshOf(const Element& element, Parameters& p, bool hasTangents, glm::dmat4& toWorld);
  MeshGeometry readMesh(const Element& element, const MeshKey& key);
  uint32_t curvesOf(const Element& element, Parameters& p, glm::dmat4& toWorld);
  glm::dmat4 placed(const Element& element, Parameters& p);

  const Context& context_;
  Textures& textures_;
  Bsdfs& bsdfs_;
  std::map<MeshKey, uint32_t> meshes_;
  struct Curves {
    uint32_t geometry;
    glm::dvec3 centre;
  };
  std::map<std::string, Curves> curves_;  // by plugin, file and transform
  // The file that was read last: serialized ones hold many shapes.
  std::string lastFile_;
  std::vector<uint8_t> lastBytes_;
  size_t shapes_ = 0;
  bool saysCurved_ = false;  // a note of one curved shape is enough
};

}  // namespace restlab::mitsuba
