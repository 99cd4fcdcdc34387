// The layers of an EXR, by the names of its channels.
#pragma once

#include <ImfHeader.h>

#include <array>
#include <filesystem>
#include <map>
#include <string>

#include "core/image/image.h"

namespace restlab {

// Channels of one layer: three, or two (the third is "" and reads as 0), or one alone.
struct LayerChannels {
  std::array<std::string, 3> three;
  std::string alone;
  bool isColour = false;  // `three` are R, G, B
};

// Finds the wanted layers, by name. Throws Error (badInput) if there are none.
std::map<std::string, LayerChannels> findExrLayers(const std::filesystem::path& file,
                                                   const Imf::Header& header, ExrLayers wanted);

}  // namespace restlab
