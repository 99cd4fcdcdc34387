// Radiance HDR by stb_image.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "core/scene/image_formats.h"

namespace {

// What the decoder may allocate at once.
struct DecoderLimit {
  size_t bytes = 0;
  bool wasExceeded = false;
};
thread_local DecoderLimit tLimit;

void* reallocateLimited(void* old, size_t bytes) {
  if (bytes > tLimit.bytes) {
    tLimit.wasExceeded = true;
    return nullptr;
  }
  return std::realloc(old, bytes);
}

}  // namespace

#define STBI_MALLOC(bytes) reallocateLimited(nullptr, bytes)
#define STBI_REALLOC(old, bytes) reallocateLimited(old, bytes)
#define STBI_FREE(old) std::free(old)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
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
  bool endsInOnes = false;  // ones instead of zeros: a run of zero pixels never fills a row
};

int readSource(void* user, char* data, int size) {
  Source& source = *static_cast<Source*>(user);
  const size_t count = std::min(static_cast<size_t>(size), source.bytes.size() - source.position);
  std::memcpy(data, source.bytes.data() + source.position, count);
  source.position += count;
  if (count > 0) return static_cast<int>(count);
  source.readBeyondEnd = true;
  if (!source.endsInOnes) return 0;
  std::memset(data, 1, static_cast<size_t>(size));
  return size;
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

constexpr size_t kHeaderLimit = size_t(1) << 22;  // enough for what precedes the pixels

void limitDecoder(const Source& source, const ImageSize& size) {
  // Four channels of 16 bits, twice as the buffer grows by doubling.
  tLimit = {kHeaderLimit + size_t(16) * size.width * size.height + 2 * source.bytes.size(), false};
}

std::string decoderMessage(const Source& source) {
  if (source.readBeyondEnd) return "truncated";
  if (tLimit.wasExceeded) return "damaged: holds more data than its pixels can be";
  const char* reason = stbi_failure_reason();
  return fmt::format("cannot be decoded ({})", reason ? reason : "unknown reason");
}

// Rows are flat, or four runs after four bytes, a run of at most 127 pixels
// being two bytes.
uint64_t fewestBytes(const ImageSize& size) {
  const uint64_t width = size.width, flat = 4 * width, runs = 4 + 4 * 2 * ((width + 126) / 127);
  return size.height * (width < 8 ? flat : std::min(flat, runs));
}

}  // namespace

std::string checkHdrHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  if (sniffImageType(bytes) != "image/vnd.radiance") return "not a Radiance HDR image";
  Source source{bytes};
  limitDecoder(source, ImageSize());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &channels)) {
    return decoderMessage(source);
  }
  if (std::string problem =
          checkPixelCount(uint64_t(std::max(width, 0)), uint64_t(std::max(height, 0)));
      !problem.empty())
    return problem;
  size = {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
  return checkFileSize(bytes.size(), fewestBytes(size), size);
}

std::string decodeHdr(const std::vector<uint8_t>& bytes, DecodedHdr& image) {
  ImageSize size;
  if (std::string problem = checkHdrHeader(bytes, size); !problem.empty()) return problem;
  Source source{bytes};
  source.endsInOnes = true;
  limitDecoder(source, size);
  int width = 0, height = 0, channels = 0;
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
