// PNG files with texts, by libspng.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace restlab {

// Encodes 8-bit sRGB: R, G, B (or, of four channels, alpha as well), row 0 on top; width x height x
// channels bytes. Metadata become texts
// "restlab:KEY" (tEXt, or iTXt if beyond ASCII), like the string attributes of an EXR, and
// "Software" from its `version`. Equal images and texts give equal bytes. Throws Error (badInput)
// that begins with `what` if the image has no pixels or more than PNG can have.
std::string encodePng(const std::string& what, uint32_t width, uint32_t height,
                      const uint8_t* bytes, const std::map<std::string, std::string>& metadata = {},
                      uint32_t channels = 3);

}  // namespace restlab
