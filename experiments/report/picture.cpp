#include "experiments/report/picture.h"

#include <algorithm>

#include "core/image/io/png.h"
#include "core/image/io/srgb.h"

namespace restlab {
namespace {

// Source pixels of one target pixel: begin, end and the weights of the first and the last one.
struct Span {
  uint32_t begin, end;
  double first, last;  // 1 in between
};

Span spanOf(uint32_t target, uint32_t targets, uint32_t sources) {
  const double from = double(target) * sources / targets;
  const double to = double(target + 1) * sources / targets;
  Span span;
  span.begin = std::min(uint32_t(from), sources - 1);
  span.end = std::clamp(uint32_t(std::max(0.0, to - 1e-9)) + 1, span.begin + 1, sources);
  span.first = span.end == span.begin + 1 ? to - from : double(span.begin + 1) - from;
  span.last = to - double(span.end - 1);
  return span;
}

}  // namespace

Picture pictureOf(const Image& image, const Crop& crop, float exposure, uint32_t scale) {
  Image part(crop.width, crop.height);
  for (uint32_t y = 0; y < crop.height; ++y) {
    for (uint32_t x = 0; x < crop.width; ++x) part.at(x, y) = image.at(crop.x + x, crop.y + y);
  }
  const std::vector<uint8_t> bytes = srgbBytes(part, exposure);
  Picture picture = {crop.width * scale, crop.height * scale, {}};
  picture.bytes.reserve(size_t(picture.width) * picture.height * 3);
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      const auto pixel =
          bytes.begin() + std::ptrdiff_t(3 * (size_t(y / scale) * crop.width + x / scale));
      picture.bytes.insert(picture.bytes.end(), pixel, pixel + 3);
    }
  }
  return picture;
}

Image resized(const Image& image, uint32_t width, uint32_t height) {
  Image out(width, height);
  for (uint32_t y = 0; y < height; ++y) {
    const Span rows = spanOf(y, height, image.height);
    for (uint32_t x = 0; x < width; ++x) {
      const Span columns = spanOf(x, width, image.width);
      glm::dvec3 sum(0.0);
      double weights = 0.0;
      for (uint32_t sy = rows.begin; sy < rows.end; ++sy) {
        const double wy = sy == rows.begin ? rows.first : sy + 1 == rows.end ? rows.last : 1.0;
        for (uint32_t sx = columns.begin; sx < columns.end; ++sx) {
          const double wx = sx == columns.begin     ? columns.first
                            : sx + 1 == columns.end ? columns.last
                                                    : 1.0;
          sum += wx * wy * glm::dvec3(image.at(sx, sy));
          weights += wx * wy;
        }
      }
      out.at(x, y) = glm::vec3(sum / weights);
    }
  }
  return out;
}

std::string encodePng(const Picture& picture, const std::map<std::string, std::string>& metadata) {
  return encodePng("a picture", picture.width, picture.height, picture.bytes.data(), metadata);
}

}  // namespace restlab
