// Decoding of PNG, JPEG and Radiance HDR from memory.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace restlab {

// Width and height above which an image is refused before anything is allocated.
inline constexpr uint32_t kMaxImageSize = 16384;

struct DecodedImage {
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> texels;  // RGBA8, R in the low byte, row 0 on top
  bool roundedFrom16Bit = false;
};

// Radiance: exposures and colour corrections of the header are divided out, and colours are linear
// Rec. 709.
struct DecodedHdr {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;   // row 0 on top
  bool isConverted = false;        // from other colours: values below 0 are colours out of reach
  std::vector<std::string> notes;  // what must be said of the file
};

// "image/png", "image/jpeg", "image/vnd.radiance", or "" for anything else.
std::string sniffImageType(const std::vector<uint8_t>& bytes);

struct ImageSize {
  uint32_t width = 0, height = 0;
};

// Return "" on success, else what is wrong ("truncated", "16385x2 pixels, at most ..."). A file
// that ends early is an error even where the decoder would fill the rest with grey. The size is
// refused before anything is allocated where the bytes are too few for it, however well they are
// compressed.
std::string checkImageHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodeImage(const std::vector<uint8_t>& bytes, DecodedImage& image);
std::string checkHdrHeader(const std::vector<uint8_t>& bytes, ImageSize& size);
std::string decodeHdr(const std::vector<uint8_t>& bytes, DecodedHdr& image);

}  // namespace restlab
