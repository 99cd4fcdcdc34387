#include "core/scene/textures/image_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/scene/textures/image_formats.h"

namespace restlab {

std::string checkPixelCount(uint64_t width, uint64_t height) {
  if (width == 0 || height == 0) return fmt::format("{}x{} pixels", width, height);
  if (width <= kMaxImageSize && height <= kMaxImageSize) return "";
  return fmt::format("{}x{} pixels; at most {} a side are read", width, height, kMaxImageSize);
}

std::string checkFileSize(uint64_t found, uint64_t fewest, const ImageSize& size) {
  if (found >= fewest) return "";
  return fmt::format("{}x{} pixels in {} bytes; at least {} expected (truncated or corrupt)",
                     size.width, size.height, found, fewest);
}

std::string sniffImageType(const std::vector<uint8_t>& bytes) {
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()),
                              std::min<size_t>(bytes.size(), 16));
  if (head.substr(0, 8) == "\x89PNG\r\n\x1a\n") return "image/png";
  if (head.substr(0, 3) == "\xff\xd8\xff") return "image/jpeg";
  if (head.substr(0, 10) == "#?RADIANCE" || head.substr(0, 6) == "#?RGBE")
    return "image/vnd.radiance";
  return "";
}

std::string checkImageHeader(const std::vector<uint8_t>& bytes, ImageSize& size) {
  const std::string type = sniffImageType(bytes);
  if (type == "image/png") return checkPngHeader(bytes, size);
  if (type == "image/jpeg") return checkJpegHeader(bytes, size);
  return "not a PNG or JPEG image";
}

std::string decodeImage(const std::vector<uint8_t>& bytes, DecodedImage& image) {
  ImageSize size;
  if (std::string problem = checkImageHeader(bytes, size); !problem.empty()) return problem;
  image.width = size.width;
  image.height = size.height;
  image.texels.resize(size_t(size.width) * size.height);
  return sniffImageType(bytes) == "image/png" ? decodePng(bytes, image) : decodeJpeg(bytes, image);
}

}  // namespace restlab
