#include "core/scene/image_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

namespace {

// What the decoder may allocate at once. It takes the lengths of chunks at their word, and inflates
// data until they end. What it allocates is zero: it decodes by Huffman tables that a JPEG never
// defined.
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
  return old ? std::realloc(old, bytes) : std::calloc(1, bytes);
}

}  // namespace

#define STBI_MALLOC(bytes) reallocateLimited(nullptr, bytes)
#define STBI_REALLOC(old, bytes) reallocateLimited(old, bytes)
#define STBI_FREE(old) std::free(old)
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

std::string checkSize(int width, int height) {
  if (width <= 0 || height <= 0) return fmt::format("{}x{} pixels", width, height);
  if (width > static_cast<int>(kMaxImageSize) || height > static_cast<int>(kMaxImageSize)) {
    return fmt::format("{}x{} pixels; at most {} a side are read", width, height, kMaxImageSize);
  }
  return "";
}

uint32_t bigEndian(const uint8_t* bytes) {
  return uint32_t(bytes[0]) << 24 | uint32_t(bytes[1]) << 16 | uint32_t(bytes[2]) << 8 | bytes[3];
}

// The fewest bytes that a PNG of this size can have: deflate shrinks to 1 / 1032 at most.
uint64_t fewestPngBytes(const std::vector<uint8_t>& bytes, const ImageSize& size) {
  constexpr size_t kTypeAt = 12, kDepthAt = 24, kColourAt = 25;
  uint64_t bitsPerPixel = 1;
  if (bytes.size() > kColourAt && bigEndian(&bytes[kTypeAt]) == 0x49484452u) {  // "IHDR"
    constexpr std::array<uint64_t, 7> kChannels = {1, 1, 3, 1, 2, 1, 4};
    bitsPerPixel = bytes[kDepthAt] * kChannels[std::min<size_t>(bytes[kColourAt], 6)];
  }
  return (size.width * bitsPerPixel / 8 + 1) * size.height / 1032;
}

// The decoder copies the first chunk of pixels to nowhere where there is nothing to copy.
bool beginsWithoutPixels(const std::vector<uint8_t>& png) {
  constexpr size_t kSignature = 8, kChunkHeader = 8, kChunkSum = 4;
  for (uint64_t at = kSignature; at + kChunkHeader <= png.size();) {
    const uint64_t length = bigEndian(&png[at]);
    if (bigEndian(&png[at + 4]) == 0x49444154u) return length == 0;  // "IDAT"
    at += kChunkHeader + length + kChunkSum;
  }
  return false;
}

// Of a JPEG: a block of 8 x 8 pixels takes a bit at least, in the first scan of a progressive one.
uint64_t fewestJpegBytes(const ImageSize& size) {
  return uint64_t(size.width) * size.height / (64 * 8);
}

// Huffman tables of a segment, from `at` to `end`. The decoder has room for 256 codes and does not
// ask how many there are; it reads each table whole, also beyond the segment.
std::string checkHuffmanTables(const std::vector<uint8_t>& bytes, size_t at, size_t end) {
  constexpr size_t kLengths = 16, kMaxCodes = 256;
  while (at < end) {
    size_t codes = 0;
    for (size_t i = at + 1; i < std::min(at + 1 + kLengths, bytes.size()); ++i) codes += bytes[i];
    if (codes > kMaxCodes) {
      return fmt::format("a Huffman table of {} codes; at most {} expected", codes, kMaxCodes);
    }
    at += 1 + kLengths + codes;
  }
  return "";
}

// The segments of a JPEG.
std::string checkJpegSegments(const std::vector<uint8_t>& bytes) {
  constexpr uint8_t kHuffmanTables = 0xc4, kScan = 0xda;
  // Each may go over all pixels, and costs a file a dozen bytes. Programs write a dozen at most.
  constexpr size_t kMaxScans = 100;
  size_t scans = 0;
  for (size_t at = 2; at + 4 <= bytes.size();) {
    if (bytes[at] != 0xff) {
      ++at;  // coded data, in which a 0xff is followed by zero or is a marker
      continue;
    }
    const uint8_t marker = bytes[at + 1];
    const bool hasLength = marker >= 0xc0 && marker != 0xff && !(marker >= 0xd0 && marker <= 0xd9);
    const size_t next = at + (marker == 0xff ? 1 : 2) +
                        (hasLength ? size_t(bytes[at + 2]) << 8 | bytes[at + 3] : 0);
    if (marker == kScan && ++scans > kMaxScans) {
      return fmt::format("more than {} scans", kMaxScans);
    }
    if (marker == kHuffmanTables) {
      const std::string problem = checkHuffmanTables(bytes, at + 4, next);
      if (!problem.empty()) return problem;
    }
    at = next;
  }
  return "";
}

// Of a Radiance HDR: rows are flat, or four runs after four bytes, a run of at most 127 pixels
// being two bytes.
uint64_t fewestHdrBytes(const ImageSize& size) {
  const uint64_t width = size.width, flat = 4 * width, runs = 4 + 4 * 2 * ((width + 126) / 127);
  return size.height * (width < 8 ? flat : std::min(flat, runs));
}

std::string checkBytes(uint64_t found, uint64_t fewest, const ImageSize& size) {
  if (found >= fewest) return "";
  return fmt::format("{}x{} pixels in {} bytes; at least {} expected (truncated or corrupt)",
                     size.width, size.height, found, fewest);
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

std::string checkImageHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  const std::string type = sniffImageType(bytes);
  if (type != "image/png" && type != "image/jpeg") return "not a PNG or JPEG image";
  if (type == "image/jpeg") {
    if (std::string problem = checkJpegSegments(bytes); !problem.empty()) return problem;
  }
  if (type == "image/png" && beginsWithoutPixels(bytes))
    return "the first chunk of pixels is empty";
  Source source{bytes};
  limitDecoder(source, ImageSize());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &channels)) {
    return decoderMessage(source);
  }
  if (std::string problem = checkSize(width, height); !problem.empty()) return problem;
  size = {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
  if (type == "image/png") {
    return checkBytes(bytes.size(), fewestPngBytes(bytes, size), size);
  }
  return checkBytes(bytes.size(), fewestJpegBytes(size), size);
}

std::string decodeImage(const std::vector<uint8_t>& bytes, DecodedImage& image) {
  ImageSize size;
  if (std::string problem = checkImageHeader(bytes, size); !problem.empty()) return problem;
  Source depthSource{bytes};
  image.roundedFrom16Bit = stbi_is_16_bit_from_callbacks(&kCallbacks, &depthSource) != 0;
  Source source{bytes};
  limitDecoder(source, size);
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

std::string checkHdrHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  if (sniffImageType(bytes) != "image/vnd.radiance") return "not a Radiance HDR image";
  Source source{bytes};
  limitDecoder(source, ImageSize());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &channels)) {
    return decoderMessage(source);
  }
  if (std::string problem = checkSize(width, height); !problem.empty()) return problem;
  size = {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
  return checkBytes(bytes.size(), fewestHdrBytes(size), size);
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
