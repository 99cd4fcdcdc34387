// The scene behind an image, for what must be traced again to look at the image.
#pragma once

#include <map>
#include <string>

#include "experiments/runner/run/prepare.h"

namespace restlab {

struct ImageScene {
  PreparedScene prepared;
  SessionConfig config;  // camera, size and filter of the image; nothing of its method
};

// Loads what the metadata of `file` name. Throws Error (badInput) where they do not, where the
// scene or its environment is not found, and where it is not the one that was rendered.
ImageScene sceneOfImage(const std::string& file,
                        const std::map<std::string, std::string>& metadata);

}  // namespace restlab
