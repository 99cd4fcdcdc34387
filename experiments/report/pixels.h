// Images inside the report: which part of them, and as which text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// A report holds whole images of at most kReportImagePixels, or of its share of kReportTotalPixels
// where that is less; of larger ones it holds a crop of that size. A pixel takes about 10 bytes of
// the file, so that a report stays below some 30 MB however many images a sweep has.
constexpr size_t kReportImagePixels = size_t(1) << 20;
constexpr size_t kReportTotalPixels = size_t(3) << 20;

// Pixels that each of `images` images may hold, at least 1.
size_t reportPixelLimit(size_t images);

// A part of an image in its pixels.
struct Crop {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Crop&) const = default;
};

// At most `limit` pixels (and at least one) in the proportions of the images, which have one size:
// all of it, else the part with the largest mean of min(1, sum |d| / (sum |r| + 0.01)) over pixels
// and images, d = image - reference, sums over channels (no single firefly decides; what is not
// finite counts 1). Where `reference` is null or the only image: the centre.
Crop chooseCrop(const std::vector<const Image*>& images, const Image* reference, size_t limit);

// Base64 of a zlib stream of the crop's 32-bit floats, losslessly: twelve planes of one byte a
// pixel, row by row from the top; of R its bytes from the most to the least significant one, then
// of G, of B.
std::string packPixels(const Image& image, const Crop& crop);

// The inverse; throws Error (badInput) where the text is not that of so many pixels.
Image unpackPixels(std::string_view text, uint32_t width, uint32_t height);

// RFC 4648, with padding. decodeBase64 throws Error (badInput) at another character.
std::string encodeBase64(std::string_view bytes);
std::string decodeBase64(std::string_view text);

}  // namespace restlab
