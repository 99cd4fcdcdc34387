// The window of an image: the place of its pixels.
#pragma once

#include <fmt/format.h>

#include <string>

#include "core/image/image.h"

namespace restlab {

// A rectangle in the pixel space that all EXR files share, whatever their display windows.
struct PixelWindow {
  glm::ivec2 origin{0, 0};
  uint32_t width = 0, height = 0;

  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

inline PixelWindow windowOf(const Image& image) {
  return {image.origin, image.width, image.height};
}

// Formats "8x4", with " from pixel (1, 0) on" if one of the two windows does not begin at (0, 0).
inline std::string windowText(const PixelWindow& window, const PixelWindow& other) {
  const std::string size = fmt::format("{}x{}", window.width, window.height);
  if (window.origin == glm::ivec2(0) && other.origin == glm::ivec2(0)) return size;
  return fmt::format("{} from pixel ({}, {}) on", size, window.origin.x, window.origin.y);
}

}  // namespace restlab
