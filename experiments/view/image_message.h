// An image on its way to a page.
//
// Little-endian: "RLI1", then as 32-bit unsigned numbers slot, format (0: floats, 1: halves),
// width, height and frame, as a 64-bit one epoch; from byte 32 on R, G, B of each pixel, row 0 on
// top.
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

// `header` says the format; the size is the image's. Halves are rounded to the nearest; what
// is finite and too large for them becomes the largest of them.
Bytes imageMessage(ImageHeader header, const Image& image);

}  // namespace restlab
