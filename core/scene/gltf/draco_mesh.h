// One mesh of KHR_draco_mesh_compression. The only code that calls Draco's library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// An accessor, as the values that are decoded for it see it.
struct DracoTarget {
  std::string place;      // for error lines
  std::string accessor;   // "accessors[1]", for error lines
  uint32_t id = 0;        // of the attribute, in the stream
  int componentType = 0;  // as in glTF
  size_t components = 1;  // of an element
  uint64_t count = 0;     // elements
  bool normalized = false;
  size_t componentBytes = 1;

  size_t elementBytes() const { return componentBytes * components; }
};

struct DracoRequest {
  const uint8_t* bytes = nullptr;
  size_t size = 0;
  std::string place;
  std::string source;  // "bufferViews[0]", for error lines
  DracoTarget indices;
  std::vector<DracoTarget> attributes;  // at least one
};

// Bytes that decoding may still take, for all meshes of a file together. Draco's streams may claim
// any number of vertices, so that each claim is taken from here before memory is.
struct DracoBudget {
  uint64_t left = 0;
};

// Packed elements: the indices, then those of each attribute, each at a multiple of four bytes.
struct DracoElements {
  std::vector<uint8_t> bytes;
  size_t indices = 0;              // where they begin
  std::vector<size_t> attributes;  // where each begins
};

// Decodes a mesh whose counts are those of its targets. Fails with a line where the stream is
// damaged, is no mesh, has other counts or lacks an attribute; memory is bounded by the budget.
DracoElements decodeDracoMesh(const DracoRequest& request, DracoBudget& budget, Report& report);

}  // namespace restlab::gltf
