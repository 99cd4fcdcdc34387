// Finds the scene that an image was rendered from, to trace rays in it again.
#pragma once

#include <map>
#include <string>

#include "experiments/runner/suite/prepare.h"

namespace restlab {

struct ImageScene {
  PreparedScene prepared;
  SessionConfig config;  // camera, size and filter of the image, without its method
};

// Loads the scene named in the metadata of `file`. Throws Error (badInput) if the metadata lack it,
// the scene or its environment is not found, or its hash differs from that of the rendered one.
ImageScene sceneOfImage(const std::string& file,
                        const std::map<std::string, std::string>& metadata);

}  // namespace restlab
