#include "experiments/report/pixels.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>

#include "core/base/error.h"

namespace restlab {
namespace {

constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

size_t reportPixelLimit(size_t images) {
  return std::min(kReportImagePixels,
                  kReportTotalPixels / std::clamp<size_t>(images, 1, kReportTotalPixels));
}

std::string encodeBase64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

std::string decodeBase64(std::string_view text) {
  std::string bytes;
  uint32_t word = 0, bits = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (const char c : text) {
    const size_t digit = std::string_view(kDigits).find(c);
    if (digit == std::string_view::npos)
      failInput("base64: a character that is none of its digits");
    word = word << 6 | uint32_t(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += char(word >> bits & 0xff);
  }
  return bytes;
}

std::string packPixels(const Image& image, const Crop& crop) {
  const size_t count = size_t(crop.width) * crop.height;
  std::string planes(count * 12, '\0');
  size_t at = 0;
  for (uint32_t y = crop.y; y < crop.y + crop.height; ++y) {
    for (uint32_t x = crop.x; x < crop.x + crop.width; ++x, ++at) {
      const glm::vec3& pixel = image.at(x, y);
      for (size_t c = 0; c < 3; ++c) {
        const uint32_t bits = std::bit_cast<uint32_t>(pixel[int(c)]);
        for (size_t b = 0; b < 4; ++b) {
          planes[(4 * c + b) * count + at] = char(bits >> (24 - 8 * b) & 0xff);
        }
      }
    }
  }
  uLongf size = compressBound(uLong(planes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(planes.data()), uLong(planes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();  // the only failure with a buffer of this size
  }
  return encodeBase64(std::string_view(packed).substr(0, size));
}

Image unpackPixels(std::string_view text, uint32_t width, uint32_t height) {
  const std::string packed = decodeBase64(text);
  const size_t count = size_t(width) * height;
  std::string planes(count * 12 + 1, '\0');  // one more, to detect too many bytes
  uLongf size = uLong(planes.size());
  const int status =
      uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size()));
  if (status != Z_OK || size != count * 12) {
    failInput(fmt::format("packed pixels: not those of {}x{} pixels", width, height));
  }
  Image image(width, height);
  for (size_t at = 0; at < count; ++at) {
    for (size_t c = 0; c < 3; ++c) {
      uint32_t bits = 0;
      for (size_t b = 0; b < 4; ++b) bits = bits << 8 | uint8_t(planes[(4 * c + b) * count + at]);
      image.pixels[at][int(c)] = std::bit_cast<float>(bits);
    }
  }
  return image;
}

}  // namespace restlab
