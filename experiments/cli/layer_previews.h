// PNG previews of layers, beside that of the image.
#pragma once

#include <filesystem>
#include <string>

#include "core/frame/method.h"
#include "core/image/image.h"

namespace restlab {

// Returns "a.depth.png" for "a.png" and "depth".
std::filesystem::path layerPreviewPath(const std::filesystem::path& preview,
                                       const std::string& layer);

// Writes radiance and albedo unchanged, ids in false colours, and other numbers from black to white
// with a log line on their range. `layer`: one of method.aovNames(), in `image`, whose metadata are
// added to the preview.
void writeLayerPreview(const std::filesystem::path& file, const std::string& layer,
                       const LayeredImage& image, const Method& method);

}  // namespace restlab
