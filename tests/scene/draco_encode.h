// Meshes compressed by Draco's own encoder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace restlab::test {

struct DracoInput {
  std::vector<float> positions;     // three a vertex
  std::vector<float> normals;       // likewise; may be empty
  std::vector<uint16_t> colors;     // four a vertex, normalised; may be empty
  std::vector<uint32_t> triangles;  // three indices each
};

// A grid of n x n squares in the plane z = 0, with normals and colours.
DracoInput dracoGrid(uint32_t n);

// Attributes have the ids 0 (positions), 1 (normals), 2 (colours). Sequential streams keep the
// order and every bit; edgebreaker's quantise positions to 14 bits and normals to 10.
std::string dracoMesh(const DracoInput& input, bool isSequential);
std::string dracoPointCloud(const DracoInput& input);

}  // namespace restlab::test
