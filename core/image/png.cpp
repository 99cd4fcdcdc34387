#include <fmt/format.h>

#include "core/error.h"
#include "core/image/atomic_file.h"
#include "core/image/image.h"
#include "core/image/srgb.h"

// Static, so that another library's copy of stb_image_write cannot clash with this one.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace restlab {
namespace {

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
  const std::vector<uint8_t> bytes = srgbBytes(image, exposure);
  AtomicFile output(file);
  if (stbi_write_png_to_func(appendBytes, &output.stream(), int(image.width), int(image.height), 3,
                             bytes.data(), int(image.width) * 3) == 0) {
    failInput(fmt::format("{}: PNG compression failed", file.string()));
  }
  output.commit();
}

}  // namespace restlab
