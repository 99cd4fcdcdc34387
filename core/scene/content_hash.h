// 64-bit hash of a sequence of byte blocks (XXH3, each block seeded with the hash before it).
#pragma once

#include <cstddef>
#include <cstdint>

namespace restlab {

// `previous` is 0 for the first block.
uint64_t hashBytes(const void* bytes, size_t size, uint64_t previous);

}  // namespace restlab
