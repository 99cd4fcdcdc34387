// The decoders behind image_decode.h, a file each.
#pragma once

#include "core/scene/image_decode.h"

namespace restlab {

// As checkImageHeader() and decodeImage(), which has made room for the texels.
std::string checkPngHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodePng(const std::vector<uint8_t>& bytes, DecodedImage& image);
std::string checkJpegHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodeJpeg(const std::vector<uint8_t>& bytes, DecodedImage& image);

// What is wrong with a size; "" where nothing is.
std::string checkPixelCount(uint64_t width, uint64_t height);
// With a file of `found` bytes where no encoding of this size has less than `fewest`.
std::string checkFileSize(uint64_t found, uint64_t fewest, const ImageSize& size);

inline uint32_t packRgba(uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
  return r | (g << 8) | (b << 16) | (a << 24);
}

}  // namespace restlab
