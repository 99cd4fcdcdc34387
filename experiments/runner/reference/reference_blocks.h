// Blocks of samples, by which references are summed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace restlab {

// Samples per pixel of a block, half of them of each half of a reference. Sums of complete blocks
// are added up in the order of the blocks (experiments/statistics/block_sum.h), so that blocks may
// be rendered elsewhere (reference_chunk.h). Up to one block the sum is that of samples one by one.
constexpr uint64_t kBlockSpp = 1024;

// Bytes of the sums of a block: of the two halves, and of the squares.
constexpr size_t kBlockBytesPerPixel = 3 * sizeof(glm::dvec3);

}  // namespace restlab
