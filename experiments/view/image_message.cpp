#include "experiments/view/image_message.h"

#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace restlab {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

Bytes imageMessage(ImageHeader header, const Image& image) {
  header.width = image.width;
  header.height = image.height;
  const size_t values = 3 * image.pixels.size();
  const bool isHalf = header.format == PixelFormat::halves;
  Bytes bytes(kImageHeaderBytes + values * (isHalf ? sizeof(half) : sizeof(float)));
  std::byte* at = bytes.data();
  const auto write = [&](const void* from, size_t count) {
    std::memcpy(at, from, count);
    at += count;
  };
  write("RLI1", 4);
  for (const uint32_t word :
       {header.slot, uint32_t(header.format), header.width, header.height, header.frame})
    write(&word, sizeof word);
  write(&header.epoch, sizeof header.epoch);
  if (!isHalf) {
    write(image.pixels.data(), values * sizeof(float));
    return bytes;
  }
  for (const glm::vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      // Clamp finite values: an infinity would be taken for a fault of the renderer.
      const float most = HALF_MAX;
      const half value(std::isfinite(pixel[c]) ? std::clamp(pixel[c], -most, most) : pixel[c]);
      write(&value, sizeof value);
    }
  }
  return bytes;
}

}  // namespace restlab
