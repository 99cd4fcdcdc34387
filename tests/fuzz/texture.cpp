#include <stdexcept>

#include "core/scene/textures/image_decode.h"
#include "tests/fuzz/entries.h"

namespace restlab::fuzz {

bool readTexture(const uint8_t* bytes, size_t count) {
  DecodedImage image;
  if (!decodeImage({bytes, bytes + count}, image).empty()) return false;
  if (image.texels.size() != size_t(image.width) * image.height)
    throw std::logic_error("texels that the size does not tell");
  return true;
}

}  // namespace restlab::fuzz
