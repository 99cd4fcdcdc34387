// Encodes an image for a page.
//
// Format, little-endian: "RLI1"; then slot, format (0: floats, 1: halves), width, height and frame
// as 32-bit unsigned numbers; epoch as a 64-bit one. R, G, B of each pixel begin at byte 32, row 0
// on top.
#pragma once

#include <cstdint>

#include "core/image/image.h"
#include "experiments/view/server.h"

namespace restlab {

enum class PixelFormat : uint32_t { floats = 0, halves = 1 };

struct ImageHeader {
  uint32_t slot = 0;
  PixelFormat format = PixelFormat::floats;
  uint32_t width = 0, height = 0;
  uint32_t frame = 0;
  uint64_t epoch = 0;
};
constexpr size_t kImageHeaderBytes = 32;

// Takes the format from `header` and the size from `image`. Halves are rounded to the nearest; a
// finite value above their range becomes the largest half.
Bytes imageMessage(ImageHeader header, const Image& image);

}  // namespace restlab
