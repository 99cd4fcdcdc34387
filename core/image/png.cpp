#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/image/atomic_file.h"
#include "core/image/color.h"
#include "core/image/image.h"

// Static, so that another library's copy of stb_image_write cannot clash with this one.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace restlab {
namespace {

// The comparisons are such that NaN cannot reach the conversion to an integer.
uint8_t encodeSrgb8(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear >= 1.0f) return 255;
  return uint8_t(encodeSrgb(linear) * 255.0f + 0.5f);
}

void appendBytes(void* stream, void* data, int size) {
  static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(data), size);
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image& image, float exposure) {
  // stb_image_write counts bytes in an int.
  if (image.pixels.empty() || image.pixels.size() != size_t(image.width) * image.height ||
      image.pixels.size() > (size_t(1) << 28) || image.width > (1u << 28)) {
    failInput(fmt::format("{}: cannot write a PNG of {}x{} pixels", file.string(), image.width,
                          image.height));
  }
  std::vector<uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const glm::vec3& pixel : image.pixels) {
    if (std::isnan(pixel.x) || std::isnan(pixel.y) || std::isnan(pixel.z)) {
      bytes.insert(bytes.end(), {255, 0, 255});  // magenta: a NaN must be seen
    } else {
      for (int c = 0; c < 3; ++c) bytes.push_back(encodeSrgb8(pixel[c] * exposure));
    }
  }
  AtomicFile output(file);
  if (stbi_write_png_to_func(appendBytes, &output.stream(), int(image.width), int(image.height), 3,
                             bytes.data(), int(image.width) * 3) == 0) {
    failInput(fmt::format("{}: PNG compression failed", file.string()));
  }
  output.commit();
}

}  // namespace restlab
