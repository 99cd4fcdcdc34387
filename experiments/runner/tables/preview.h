// Exposure of pictures.
#pragma once

#include "core/image/image.h"

namespace restlab {

// Returns the factor on radiance at which previews, the report, `figure` and the viewer show a
// scene, from its reference or, where there is none, its first image; 1 for an image without light.
//
// Maps the logarithmic mean of the luminance to mid grey. The mean is over blocks of 8x8 pixels: of
// few samples most pixels are black and the others far too bright. Blocks without light do not
// count. Then at most one pixel of the other blocks in a hundred may be clipped, but the picture is
// darkened by at most two stops for that. These are pixels: a block at a lamp's edge would be as
// bright as the lamp. One that is alone with its brightness is noise, and counts as the fourth
// brightest of the 3x3 around it. Pixels that are not finite do not count.
//
// autoExposure() of the image viewer is the same rule.
float previewExposure(const Image& image);

}  // namespace restlab
