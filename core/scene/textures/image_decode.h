// Decoding of PNG, JPEG and Radiance HDR from memory.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace restlab {

// Width and height above which an image is refused before any allocation.
inline constexpr uint32_t kMaxImageSize = 16384;

struct DecodedImage {
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> texels;  // RGBA8, R in the low byte, row 0 on top
  bool roundedFrom16Bit = false;
};

// Radiance HDR: exposures and colour corrections of the header are divided out, and colours are
// linear Rec. 709.
struct DecodedHdr {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;   // row 0 on top
  bool isConverted = false;        // from other primaries: values below 0 lie outside Rec. 709
  std::vector<std::string> notes;  // remarks about the file
};

// "image/png", "image/jpeg", "image/vnd.radiance", or "" for anything else.
std::string sniffImageType(const std::vector<uint8_t>& bytes);

struct ImageSize {
  uint32_t width = 0, height = 0;
};

// Return "" on success, else the fault ("truncated", "16385x2 pixels, at most ..."). A file that
// ends early is an error even if the decoder would fill the rest with grey. A size is refused
// before any allocation if the file has too few bytes for it, however well compressed.
std::string checkImageHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodeImage(const std::vector<uint8_t>& bytes, DecodedImage& image);
std::string checkHdrHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodeHdr(const std::vector<uint8_t>& bytes, DecodedHdr& image);

}  // namespace restlab
