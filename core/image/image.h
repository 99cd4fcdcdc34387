// Float images in linear Rec. 709 with named channels, and their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace restlab {

// width x height RGB pixels, row 0 on top.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;
  glm::ivec2 origin{0, 0};  // first pixel, in the pixel space of its file

  Image() = default;
  Image(uint32_t w, uint32_t h, glm::vec3 value = glm::vec3(0.0f))
      : width(w), height(h), pixels(size_t(w) * h, value) {}
  glm::vec3& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
  const glm::vec3& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }
};

enum class EnvironmentKind { none, latLong, cube, unknown };

// Window and colours that an EXR declares beside its pixels.
struct ExrFrame {
  glm::ivec2 origin{0, 0};  // first pixel: start of the data window
  // First and last pixel of the display window; absent: those of the data window.
  std::optional<glm::ivec4> display{};
  float pixelAspectRatio = 1.0f;  // width / height of a pixel
  EnvironmentKind environment = EnvironmentKind::none;
};

// Layers of one EXR. The layer "" holds channels R, G, B; a layer "x" holds x.R, x.G, x.B.
// Metadata are string attributes ("restlab:key").
struct LayeredImage {
  std::map<std::string, Image> layers;
  std::map<std::string, std::string> metadata;
  ExrFrame frame{};
  std::vector<std::string> notes{};  // lines about colour conversions on reading
};

// Writes 32-bit float ZIP EXR through a temporary file and a rename: a partly written file never
// carries the final name. Windows and pixel shape are those of `frame`, colours are Rec. 709.
// Throws Error (badInput) naming the file.
void writeExr(const std::filesystem::path& file, const LayeredImage& image);

// Kinds of layers that a reader returns.
enum class ExrLayers {
  colours,  // R, G, B, or Y alone, which becomes grey
  all       // also vectors X, Y, Z, and single channels, which fill all three: "Z" is a depth
};

// Layers to read. No other channel of the file is opened.
struct ExrSelection {
  ExrLayers kind = ExrLayers::colours;
  std::optional<std::set<std::string>> names{};  // absent: all
  std::set<std::string> data{};                  // layers whose R, G, B are no colours (normals)

  ExrSelection(ExrLayers wanted = ExrLayers::colours) : kind(wanted) {}
  ExrSelection(ExrLayers wanted, std::set<std::string> layers)
      : kind(wanted), names(std::move(layers)) {}
};

// Reads layers (half or float); colours of other `chromaticities` are converted to Rec. 709. A
// layer wanted by name but absent is left out. Sizes are checked before allocation. Throws Error
// (badInput) naming the file and the fault.
LayeredImage readExr(const std::filesystem::path& file, const ExrSelection& wanted = {});

// Writes an 8-bit sRGB preview, radiance x exposure, clipped (no figure is computed from it), with
// the metadata of the EXR beside it as texts (core/image/io/png.h).
void writePng(const std::filesystem::path& file, const Image& image, float exposure = 1.0f,
              const std::map<std::string, std::string>& metadata = {});

// Fails (badInput) unless `file` can be created: called before rendering starts.
void checkWritable(const std::filesystem::path& file);

}  // namespace restlab
