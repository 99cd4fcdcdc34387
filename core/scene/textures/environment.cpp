// loadEnvironment(): latitude-longitude maps and cubes from .hdr and .exr files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/base/memory.h"
#include "core/image/image.h"
#include "core/scene/scene.h"
#include "core/scene/textures/cube_map.h"
#include "core/scene/textures/image_decode.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& text) {
  failInput(fmt::format("{}: {}", file.string(), text));
}

// Returns whether colours were converted to Rec. 709.
bool readHdrMap(const fs::path& file, EnvironmentMap& map) {
  std::error_code error;
  const uint64_t size = fs::file_size(file, error);
  // Uncompressed 16384 x 16384 RGBE plus a header: the largest file that can be read.
  constexpr uint64_t kMaxBytes = uint64_t(kMaxImageSize) * kMaxImageSize * 4 + 65536;
  if (const std::string reason = unreadableReason(file); !reason.empty()) fail(file, reason);
  if (error || size > kMaxBytes)
    fail(file, fmt::format("{} bytes are too many for an environment map", size));
  std::vector<uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream || static_cast<uint64_t>(stream.gcount()) != size) fail(file, "cannot be read");
  ImageSize pixels;
  if (checkHdrHeader(bytes, pixels).empty()) {
    MemoryGuard().take(fmt::format("{}: {}x{} pixels", file.string(), pixels.width, pixels.height),
                       sizeof(glm::vec3) * pixels.width * pixels.height);
  }
  DecodedHdr decoded;
  if (const std::string problem = decodeHdr(bytes, decoded); !problem.empty()) {
    fail(file, problem + "; a complete Radiance HDR image expected");
  }
  map.width = decoded.width;
  map.height = decoded.height;
  map.radiance = std::move(decoded.pixels);
  for (const std::string& note : decoded.notes)
    map.warnings.push_back(fmt::format("{}: {}", file.string(), note));
  return decoded.isConverted;
}

// Rejects crops and maps with a border: they would be stretched over the whole sphere.
void requireWhole(const fs::path& file, const ExrFrame& frame, const Image& image) {
  const glm::ivec4 data(frame.origin, frame.origin.x + int(image.width) - 1,
                        frame.origin.y + int(image.height) - 1);
  if (!frame.display || *frame.display == data) return;
  const glm::ivec4& display = *frame.display;
  fail(file,
       fmt::format("its data window ({}, {}) - ({}, {}) is not its display window ({}, {}) - "
                   "({}, {}); a whole environment expected",
                   data.x, data.y, data.z, data.w, display.x, display.y, display.z, display.w));
}

// Returns whether colours were converted to Rec. 709.
bool readExrMap(const fs::path& file, EnvironmentMap& map) {
  LayeredImage read = readExr(file, {ExrLayers::colours, {""}});
  const auto layer = read.layers.find("");
  if (layer == read.layers.end()) fail(file, "has no channels R, G, B (or Y)");
  Image& image = layer->second;
  if (image.width > kMaxImageSize || image.height > kMaxImageSize) {
    fail(file, fmt::format("{}x{} pixels; at most {} a side are read", image.width, image.height,
                           kMaxImageSize));
  }
  requireWhole(file, read.frame, image);
  if (read.frame.environment == EnvironmentKind::unknown)
    fail(file, "attribute 'envmap' is neither latitude-longitude (0) nor cube (1)");
  if (read.frame.environment == EnvironmentKind::cube) {
    if (image.height != 6 * image.width) {
      fail(file,
           fmt::format("attribute 'envmap' says cube, of {}x{} pixels; six square faces below "
                       "each other expected",
                       image.width, image.height));
    }
    MemoryGuard().take(fmt::format("{}: the cube as latitude-longitude", file.string()),
                       8 * sizeof(glm::vec3) * image.width * image.width);
    image = latLongOfCube(image);
    map.warnings.push_back(
        fmt::format("{}: the cube's faces of {}x{} pixels are drawn as latitude-longitude of {}x{}",
                    file.string(), image.width / 4, image.width / 4, image.width, image.height));
  }
  map.width = image.width;
  map.height = image.height;
  map.radiance = std::move(image.pixels);
  map.warnings.insert(map.warnings.end(), read.notes.begin(), read.notes.end());
  return !read.notes.empty();
}

// Sets channels below 0 to 0. Converting colours outside Rec. 709 makes such channels, but light
// cannot have them. Tiny ones come from rounding and are not counted in the warning.
void cutAtZero(const fs::path& file, EnvironmentMap& map) {
  size_t count = 0;
  for (glm::vec3& texel : map.radiance) {
    const float largest = std::max({texel.x, texel.y, texel.z});
    if (!std::isfinite(largest) || largest <= 0.0f) continue;
    bool isOutside = false;
    for (int c = 0; c < 3; ++c) {
      if (!(texel[c] < 0.0f)) continue;
      isOutside = isOutside || texel[c] < -1e-5f * largest;
      texel[c] = 0.0f;
    }
    count += isOutside ? 1 : 0;
  }
  if (count == 0) return;
  map.warnings.push_back(fmt::format(
      "{}: {} of {} pixels have colours outside of Rec. 709; their channels below 0 are set to 0",
      file.string(), count, map.radiance.size()));
}

}  // namespace

EnvironmentMap loadEnvironment(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) fail(file, unreadableReason(file));
  if (!fs::is_regular_file(file, error)) fail(file, "is not a regular file");
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  EnvironmentMap map;
  map.source = file.string();
  bool isConverted = false;
  if (extension == ".hdr") {
    isConverted = readHdrMap(file, map);
  } else if (extension == ".exr") {
    isConverted = readExrMap(file, map);
  } else {
    fail(file, "not an environment map; .hdr or .exr expected");
  }
  if (isConverted) cutAtZero(file, map);
  for (size_t i = 0; i < map.radiance.size(); ++i) {
    const glm::vec3& texel = map.radiance[i];
    for (int c = 0; c < 3; ++c) {
      if (std::isfinite(texel[c]) && texel[c] >= 0.0f) continue;
      fail(file, fmt::format("pixel ({}, {}) is ({:g}, {:g}, {:g}); finite radiance of at least 0 "
                             "expected",
                             i % map.width, i / map.width, texel.x, texel.y, texel.z));
    }
  }
  return map;
}

}  // namespace restlab
