// Output of `render --pixel`.
#pragma once

#include <cstdint>
#include <string>

#include "core/frame/session.h"

namespace restlab {

struct PixelPlace {
  uint32_t x = 0, y = 0;
};

// Parses "X,Y". Both throw Error (badUsage): for bad syntax, or a pixel outside the image.
PixelPlace parsePixel(const std::string& text);
void requireInside(const PixelPlace& pixel, const SessionConfig& config);

// Print values after frame number `frame` of a history: lines of name and value, or one JSON
// object.
std::string pixelText(const Session& session, const PixelPlace& pixel);
std::string pixelJson(const Session& session, const PixelPlace& pixel, uint64_t frame);

}  // namespace restlab
