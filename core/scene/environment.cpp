// loadEnvironment(): latitude-longitude maps from .hdr and .exr files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/file_reason.h"
#include "core/image/image.h"
#include "core/memory.h"
#include "core/scene/image_decode.h"
#include "core/scene/scene.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& text) {
  failInput(fmt::format("{}: {}", file.string(), text));
}

void readHdrMap(const fs::path& file, EnvironmentMap& map) {
  std::error_code error;
  const uint64_t size = fs::file_size(file, error);
  // Uncompressed 16384 x 16384 RGBE and a header; nothing larger can be read.
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
    // As the decoder's floats, and as the map's.
    constexpr uint64_t kBytesPerPixel = 2 * sizeof(glm::vec3);
    MemoryGuard().take(fmt::format("{}: {}x{} pixels", file.string(), pixels.width, pixels.height),
                       kBytesPerPixel * pixels.width * pixels.height);
  }
  DecodedHdr decoded;
  if (const std::string problem = decodeHdr(bytes, decoded); !problem.empty()) {
    fail(file, problem + "; a complete Radiance HDR image expected");
  }
  map.width = decoded.width;
  map.height = decoded.height;
  map.radiance = std::move(decoded.pixels);
}

void readExrMap(const fs::path& file, EnvironmentMap& map) {
  LayeredImage image = readExr(file);
  const auto layer = image.layers.find("");
  if (layer == image.layers.end()) fail(file, "has no channels R, G, B (or Y)");
  map.width = layer->second.width;
  map.height = layer->second.height;
  if (map.width > kMaxImageSize || map.height > kMaxImageSize) {
    fail(file, fmt::format("{}x{} pixels; at most {} a side are read", map.width, map.height,
                           kMaxImageSize));
  }
  map.radiance = std::move(layer->second.pixels);
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
  if (extension == ".hdr") {
    readHdrMap(file, map);
  } else if (extension == ".exr") {
    readExrMap(file, map);
  } else {
    fail(file, "not an environment map; .hdr or .exr expected");
  }
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
