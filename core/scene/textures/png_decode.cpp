// PNG by libspng. Values are taken unchanged: glTF ignores gamma and colour profiles.
#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "core/scene/textures/image_formats.h"

namespace restlab {

namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

std::string messageOf(int error) {
  if (error == SPNG_IO_EOF) return "truncated";
  return fmt::format("cannot be decoded ({})", spng_strerror(error));
}

// Removes the chunks that no pixel depends on: texts, times, profiles. libspng 0.7.3 stops at 1000
// of them, whatever its limits. Everything after a truncated chunk is kept.
std::vector<uint8_t> pixelsAlone(const std::vector<uint8_t>& bytes) {
  constexpr size_t kSignatureBytes = 8, kChunkBytes = 12;
  std::vector<uint8_t> kept(
      bytes.begin(), bytes.begin() + std::ptrdiff_t(std::min(bytes.size(), kSignatureBytes)));
  size_t at = kept.size();
  while (bytes.size() - at >= kChunkBytes) {
    const uint64_t length = uint64_t(bytes[at]) << 24 | uint64_t(bytes[at + 1]) << 16 |
                            uint64_t(bytes[at + 2]) << 8 | bytes[at + 3];
    if (length > bytes.size() - at - kChunkBytes) break;
    const std::string_view type(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    const auto begin = bytes.begin() + std::ptrdiff_t(at);
    at += kChunkBytes + length;
    // Critical chunks have an upper case name.
    const bool isCritical = (type[0] & 0x20) == 0;
    if (isCritical || type == "tRNS")
      kept.insert(kept.end(), begin, bytes.begin() + std::ptrdiff_t(at));
  }
  kept.insert(kept.end(), bytes.begin() + std::ptrdiff_t(at), bytes.end());
  return kept;
}

// Reads the header. `bytes` must outlive the result.
Context open(const std::vector<uint8_t>& bytes, spng_ihdr& header, std::string& problem) {
  Context context(spng_ctx_new(0), &spng_ctx_free);
  if (!context) throw std::bad_alloc();
  spng_set_image_limits(context.get(), kMaxImageSize, kMaxImageSize);
  // Limit chunks, and the texts kept from them, to the size of the file, whatever they declare.
  spng_set_chunk_limits(context.get(), bytes.size(), bytes.size());
  spng_set_crc_action(context.get(), SPNG_CRC_ERROR, SPNG_CRC_DISCARD);
  spng_set_png_buffer(context.get(), bytes.data(), bytes.size());
  const int error = spng_get_ihdr(context.get(), &header);
  if (error == SPNG_EUSER_WIDTH || error == SPNG_EUSER_HEIGHT) {
    problem = fmt::format("more than {} pixels a side", kMaxImageSize);
  } else if (error != 0) {
    problem = messageOf(error);
  }
  return context;
}

// Deflate compresses to 1 / 1032 at best.
uint64_t fewestBytes(const spng_ihdr& header) {
  constexpr std::array<uint64_t, 7> kChannels = {1, 1, 3, 1, 2, 1, 4};
  const uint64_t bitsPerPixel = header.bit_depth * kChannels.at(header.color_type);
  return (header.width * bitsPerPixel / 8 + 1) * header.height / 1032;
}

}  // namespace

std::string checkPngHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  spng_ihdr header = {};
  std::string problem;
  const Context context = open(bytes, header, problem);
  if (!problem.empty()) return problem;
  if (problem = checkPixelCount(header.width, header.height); !problem.empty()) return problem;
  size = {header.width, header.height};
  return checkFileSize(bytes.size(), fewestBytes(header), size);
}

std::string decodePng(const std::vector<uint8_t>& bytes, DecodedImage& image) {
  spng_ihdr header = {};
  std::string problem;
  const std::vector<uint8_t> kept = pixelsAlone(bytes);
  const Context context = open(kept, header, problem);
  if (!problem.empty()) return problem;
  image.roundedFrom16Bit = header.bit_depth == 16;
  const spng_format format = image.roundedFrom16Bit ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
  std::vector<uint16_t> values;
  if (image.roundedFrom16Bit) values.resize(4 * image.texels.size());
  void* out = image.roundedFrom16Bit ? static_cast<void*>(values.data()) : image.texels.data();
  const size_t room = image.texels.size() * (image.roundedFrom16Bit ? 8 : 4);
  int error = spng_decode_image(context.get(), out, room, format, SPNG_DECODE_TRNS);
  // Read to the end of the file: the checksum of the last image data stands after it.
  if (error == 0 && spng_decode_chunks(context.get()) == SPNG_ECHUNK_CRC) error = SPNG_ECHUNK_CRC;
  if (error != 0) return messageOf(error);
  if (!image.roundedFrom16Bit) return "";
  // Round to the nearest of 256 levels: v / 65535 * 255.
  const auto round = [&](size_t i) { return (uint32_t(values[i]) + 128u) / 257u; };
  for (size_t i = 0; i < image.texels.size(); ++i)
    image.texels[i] = packRgba(round(4 * i), round(4 * i + 1), round(4 * i + 2), round(4 * i + 3));
  return "";
}

}  // namespace restlab
