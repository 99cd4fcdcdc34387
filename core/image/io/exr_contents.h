// Contents of an EXR, read from its header alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image/metrics/window.h"

namespace restlab {

struct ExrContents {
  PixelWindow window;
  std::vector<std::string> layers;  // names that readExr() would return, sorted
};

// Throws the same errors as readExr().
ExrContents readExrContents(const std::filesystem::path& file,
                            ExrLayers wanted = ExrLayers::colours);

}  // namespace restlab
