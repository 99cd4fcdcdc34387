// What an EXR holds, by its header alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image/window.h"

namespace restlab {

struct ExrContents {
  PixelWindow window;
  std::vector<std::string> layers;  // those that readExr() would give, sorted
};

// Throws Error as readExr() does.
ExrContents readExrContents(const std::filesystem::path& file,
                            ExrLayers wanted = ExrLayers::colours);

}  // namespace restlab
