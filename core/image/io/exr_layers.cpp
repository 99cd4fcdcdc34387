#include "core/image/io/exr_layers.h"

#include <ImfChannelList.h>

#include "core/image/io/exr_header.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Finds the channels of a layer by the last part of their names.
LayerChannels channelsOf(const std::map<std::string, std::string>& named, ExrLayers wanted) {
  const auto has = [&](const char* last) { return named.contains(last); };
  const auto three = [&](const char* a, const char* b, const char* c) -> LayerChannels {
    return {{named.at(a), named.at(b), named.at(c)}, "", false};
  };
  if (has("R") && has("G") && has("B")) {
    LayerChannels colour = three("R", "G", "B");
    colour.isColour = true;
    return colour;
  }
  const bool anyRgb = has("R") || has("G") || has("B");
  const bool isVector = has("X") || has("Z");
  // Y alone is a luminance; beside X or Z it is an axis, and RY and BY mark chroma.
  if (has("Y") && !anyRgb && !isVector && !has("RY") && !has("BY"))
    return {{}, named.at("Y"), false};
  if (wanted == ExrLayers::colours) return {};
  if (has("X") && has("Y") && has("Z")) return three("X", "Y", "Z");
  // Vector on the film, such as motion.
  if (has("X") && has("Y") && named.size() == 2)
    return {{named.at("X"), named.at("Y"), ""}, "", false};
  if (named.size() == 1) return {{}, named.begin()->second, false};
  return {};
}

}  // namespace

std::map<std::string, LayerChannels> findExrLayers(const fs::path& file, const Imf::Header& header,
                                                   ExrLayers wanted) {
  std::map<std::string, std::map<std::string, std::string>> named;
  std::string all;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    const std::string channel = it.name();
    all += (all.empty() ? "" : ", ") + channel;
    const size_t dot = channel.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : channel.substr(0, dot);
    const std::string last = dot == std::string::npos ? channel : channel.substr(dot + 1);
    named[layer][last] = channel;
  }
  std::map<std::string, LayerChannels> found;
  for (const auto& [layer, channels] : named) {
    const LayerChannels of = channelsOf(channels, wanted);
    if (!of.alone.empty() || !of.three[0].empty()) found[layer] = of;
  }
  // Z beside unnamed colours is the depth.
  const auto depth = named[""].find("Z");
  if (wanted == ExrLayers::all && found.contains("") && depth != named[""].end() &&
      !found.contains("Z"))
    found["Z"] = {{}, depth->second, false};
  if (found.empty()) {
    failExr(file,
            "has no layer with channels R, G, B or Y alone (channels: " + all.substr(0, 200) + ")");
  }
  return found;
}

}  // namespace restlab
