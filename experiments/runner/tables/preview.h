// Exposure of previews.
#pragma once

#include <vector>

#include "core/image/image.h"

namespace restlab {

// Returns the exposure of the block's previews and images in the report: maps the logarithmic mean
// of the luminance of the reference's non-black pixels to mid grey.
float previewExposure(const Image& reference);
// The same from luminances, and from the largest channel of each pixel that may be clipped.
float previewExposure(std::vector<double> luminances, std::vector<float> brightest);
// Returns 0 for pixels that do not count: black or not finite.
double previewLuminance(const glm::vec3& pixel);

}  // namespace restlab
