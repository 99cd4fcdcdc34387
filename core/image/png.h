// PNG files with texts, by libspng.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace restlab {

// 8 bits a channel, R, G, B of sRGB, row 0 on top; width x height x 3 bytes. Metadata are texts
// "restlab:KEY" (tEXt, or iTXt where they are beyond ASCII), as the string attributes of an EXR
// are, and "Software" from its `version`. The same bytes for the same picture and texts. Throws
// Error (badInput) that begins with `what` where the picture has no pixels or more than PNG can
// have.
std::string encodePng(const std::string& what, uint32_t width, uint32_t height,
                      const uint8_t* bytes,
                      const std::map<std::string, std::string>& metadata = {});

}  // namespace restlab
