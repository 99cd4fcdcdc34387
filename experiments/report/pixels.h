// Images inside the report: choice of a crop, and encoding as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// Largest number of pixels for which a report holds whole images; for larger images it holds a crop
// of that size. kReportTotalPixels is shared by all images of a report: at about 10 bytes per
// pixel, a report stays below some 30 MB even for a large sweep.
constexpr size_t kReportImagePixels = size_t(1) << 20;
constexpr size_t kReportTotalPixels = size_t(3) << 20;

// Pixels that each of `images` images may hold, at least 1.
size_t reportPixelLimit(size_t images);

// Part of an image, in its pixels.
struct Crop {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Crop&) const = default;
};

// Chooses a crop of at most `limit` pixels (at least one) with the proportions of the images, which
// have one size. If they fit: the whole image. Otherwise the part with the largest mean of min(1,
// sum |d| / (sum |r| + 0.01)) over pixels and images, d = image - reference, sums over channels;
// the minimum keeps a single firefly from deciding, non-finite values count 1. The centre if
// `reference` is null or the only image.
Crop chooseCrop(const std::vector<const Image*>& images, const Image* reference, size_t limit);

// Encodes the crop losslessly: base64 of a zlib stream of its 32-bit floats in twelve planes of one
// byte per pixel, row by row from the top; the bytes of R from the most to the least significant
// one, then those of G, then of B.
std::string packPixels(const Image& image, const Crop& crop);

// Inverse of packPixels(). Throws Error (badInput) if the text does not hold that many pixels.
Image unpackPixels(std::string_view text, uint32_t width, uint32_t height);

// Base64 of RFC 4648, with padding. decodeBase64 throws Error (badInput) on any other character.
std::string encodeBase64(std::string_view bytes);
std::string decodeBase64(std::string_view text);

}  // namespace restlab
