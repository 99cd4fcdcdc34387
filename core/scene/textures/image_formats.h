// The decoders behind image_decode.h, one file each.
#pragma once

#include "core/scene/textures/image_decode.h"

namespace restlab {

// Same as checkImageHeader() and decodeImage() for one format; decodeImage() has sized `texels`.
std::string checkPngHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodePng(const std::vector<uint8_t>& bytes, DecodedImage& image);
std::string checkJpegHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodeJpeg(const std::vector<uint8_t>& bytes, DecodedImage& image);

// Returns the fault of a size, or "".
std::string checkPixelCount(uint64_t width, uint64_t height);
// Returns the fault of a file of `found` bytes if every encoding of this size has at least
// `fewest`, or "".
std::string checkFileSize(uint64_t found, uint64_t fewest, const ImageSize& size);

inline uint32_t packRgba(uint32_t r, uint32_t g, uint32_t b, uint32_t a) {
  return r | (g << 8) | (b << 16) | (a << 24);
}

}  // namespace restlab
