#include "core/scene/content_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace restlab {

uint64_t hashBytes(const void* bytes, size_t size, uint64_t previous) {
  return XXH3_64bits_withSeed(bytes, size, previous);
}

}  // namespace restlab
