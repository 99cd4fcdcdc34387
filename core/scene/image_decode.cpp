#include "core/scene/image_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>

namespace restlab {
namespace {

static_assert(STBI_MAX_DIMENSIONS == kMaxImageSize);

// A file in memory that knows whether the decoder asked for more than there is: the decoder itself
// goes on with zeros.
struct Source {
  const std::vector<uint8_t>& bytes;
  size_t position = 0;
  bool readBeyondEnd = false;
};

int readSource(void* user, char* data, int size) {
  Source& source = *static_cast<Source*>(user);
  const size_t count = std::min(static_cast<size_t>(size), source.bytes.size() - source.position);
  std::memcpy(data, source.bytes.data() + source.position, count);
  source.position += count;
  if (count == 0) source.readBeyondEnd = true;
  return static_cast<int>(count);
}

void skipSource(void* user, int count) {
  Source& source = *static_cast<Source*>(user);
  const int64_t target = static_cast<int64_t>(source.position) + count;
  if (target > static_cast<int64_t>(source.bytes.size())) source.readBeyondEnd = true;
  source.position = static_cast<size_t>(
      std::clamp<int64_t>(target, 0, static_cast<int64_t>(source.bytes.size())));
}

int endOfSource(void* user) {
  const Source& source = *static_cast<Source*>(user);
  return source.position >= source.bytes.size();
}

constexpr stbi_io_callbacks kCallbacks = {readSource, skipSource, endOfSource};

struct StbiFree {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

std::string decoderMessage(const Source& source) {
  if (source.readBeyondEnd) return "truncated";
  const char* reason = stbi_failure_reason();
  return fmt::format("cannot be decoded ({})", reason ? reason : "unknown reason");
}

std::string checkSize(int width, int height) {
  if (width <= 0 || height <= 0) return fmt::format("{}x{} pixels", width, height);
  if (width > static_cast<int>(kMaxImageSize) || height > static_cast<int>(kMaxImageSize)) {
    return fmt::format("{}x{} pixels; at most {} a side are read", width, height, kMaxImageSize);
  }
  return "";
}

uint32_t packRgba(uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
  return r | (g << 8) | (b << 16) | (a << 24);
}

}  // namespace

std::string sniffImageType(const std::vector<uint8_t>& bytes) {
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()),
                              std::min<size_t>(bytes.size(), 16));
  if (head.substr(0, 8) == "\x89PNG\r\n\x1a\n") return "image/png";
  if (head.substr(0, 3) == "\xff\xd8\xff") return "image/jpeg";
  if (head.substr(0, 10) == "#?RADIANCE" || head.substr(0, 6) == "#?RGBE") {
    return "image/vnd.radiance";
  }
  return "";
}

std::string checkImageHeader(const std::vector<uint8_t>& bytes) {
  const std::string type = sniffImageType(bytes);
  if (type != "image/png" && type != "image/jpeg") return "not a PNG or JPEG image";
  Source source{bytes};
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &channels)) {
    return decoderMessage(source);
  }
  return checkSize(width, height);
}

std::string decodeImage(const std::vector<uint8_t>& bytes, DecodedImage& image) {
  if (std::string problem = checkImageHeader(bytes); !problem.empty()) return problem;
  Source depthSource{bytes};
  image.roundedFrom16Bit = stbi_is_16_bit_from_callbacks(&kCallbacks, &depthSource) != 0;
  Source source{bytes};
  int width = 0, height = 0, channels = 0;
  std::unique_ptr<void, StbiFree> pixels(
      image.roundedFrom16Bit ? static_cast<void*>(stbi_load_16_from_callbacks(
                                   &kCallbacks, &source, &width, &height, &channels, 4))
                             : static_cast<void*>(stbi_load_from_callbacks(
                                   &kCallbacks, &source, &width, &height, &channels, 4)));
  if (!pixels || source.readBeyondEnd) return decoderMessage(source);
  image.width = static_cast<uint32_t>(width);
  image.height = static_cast<uint32_t>(height);
  image.texels.resize(size_t(image.width) * image.height);
  if (image.roundedFrom16Bit) {
    const uint16_t* values = static_cast<const uint16_t*>(pixels.get());
    // Nearest of 256 levels: v / 65535 * 255, rounded.
    const auto round = [&](size_t i) { return (uint32_t(values[i]) + 128u) / 257u; };
    for (size_t i = 0; i < image.texels.size(); ++i) {
      image.texels[i] =
          packRgba(round(4 * i), round(4 * i + 1), round(4 * i + 2), round(4 * i + 3));
    }
  } else {
    const uint8_t* values = static_cast<const uint8_t*>(pixels.get());
    for (size_t i = 0; i < image.texels.size(); ++i) {
      image.texels[i] =
          packRgba(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]);
    }
  }
  return "";
}

std::string decodeHdr(const std::vector<uint8_t>& bytes, DecodedHdr& image) {
  if (sniffImageType(bytes) != "image/vnd.radiance") return "not a Radiance HDR image";
  Source infoSource{bytes};
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &infoSource, &width, &height, &channels)) {
    return decoderMessage(infoSource);
  }
  if (std::string problem = checkSize(width, height); !problem.empty()) return problem;
  Source source{bytes};
  std::unique_ptr<float, StbiFree> pixels(
      stbi_loadf_from_callbacks(&kCallbacks, &source, &width, &height, &channels, 3));
  if (!pixels || source.readBeyondEnd) return decoderMessage(source);
  image.width = static_cast<uint32_t>(width);
  image.height = static_cast<uint32_t>(height);
  image.pixels.resize(size_t(image.width) * image.height);
  std::memcpy(image.pixels.data(), pixels.get(), image.pixels.size() * sizeof(glm::vec3));
  return "";
}

}  // namespace restlab
