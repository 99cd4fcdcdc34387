// What `render --pixel` prints.
#pragma once

#include <cstdint>
#include <string>

#include "core/session.h"

namespace restlab {

struct PixelPlace {
  uint32_t x = 0, y = 0;
};

// "X,Y"; throws Error (badUsage) where it is none, or outside of the image.
PixelPlace parsePixel(const std::string& text);
void requireInside(const PixelPlace& pixel, const SessionConfig& config);

// After frame number `frame` of a history: lines of name and value, or one JSON object.
std::string pixelText(const Session& session, const PixelPlace& pixel);
std::string pixelJson(const Session& session, const PixelPlace& pixel, uint64_t frame);

}  // namespace restlab
