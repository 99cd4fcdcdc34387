// Float images in linear Rec. 709 with named channels, and their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace restlab {

// width x height RGB pixels, row 0 on top.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;

  Image() = default;
  Image(uint32_t w, uint32_t h, glm::vec3 value = glm::vec3(0.0f))
      : width(w), height(h), pixels(size_t(w) * h, value) {}
  glm::vec3& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
  const glm::vec3& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }
};

// Layers of one EXR. The layer "" holds channels R, G, B; a layer "x" holds x.R, x.G, x.B.
// Metadata are string attributes ("restlab:key").
struct LayeredImage {
  std::map<std::string, Image> layers;
  std::map<std::string, std::string> metadata;
};

// Writes 32-bit float ZIP EXR through a temporary file and a rename: a partly written file never
// carries the final name. Throws Error (badInput) naming the file.
void writeExr(const std::filesystem::path& file, const LayeredImage& image);

// Which layers are read.
enum class ExrLayers {
  colours,  // R, G, B, or Y alone, which becomes grey
  all       // and vectors X, Y, Z, and single channels, which fill all three: "Z" is a depth
};
// Reads layers (half or float). Sizes are checked before allocation. Throws Error (badInput) naming
// the file and what is wrong.
LayeredImage readExr(const std::filesystem::path& file, ExrLayers wanted = ExrLayers::colours);

// 8-bit sRGB preview, radiance x exposure, clipped (a preview only; no figure is computed from it).
void writePng(const std::filesystem::path& file, const Image& image, float exposure = 1.0f);

// Fails (badInput) unless `file` can be created: called before rendering starts.
void checkWritable(const std::filesystem::path& file);

}  // namespace restlab
