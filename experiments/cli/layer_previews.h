// Previews of layers as PNG, beside that of the image.
#pragma once

#include <filesystem>
#include <string>

#include "core/image/image.h"
#include "core/method.h"

namespace restlab {

// "a.png" and "depth" to "a.depth.png".
std::filesystem::path layerPreviewPath(const std::filesystem::path& preview,
                                       const std::string& layer);

// Radiance and albedo as they are; what numbers name in false colours; other numbers from black to
// white, with a line that says from which value to which. `layer` is one of method.aovNames() and
// of `image`, whose metadata the preview has, too.
void writeLayerPreview(const std::filesystem::path& file, const std::string& layer,
                       const LayeredImage& image, const Method& method);

}  // namespace restlab
