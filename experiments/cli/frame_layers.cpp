#include "experiments/cli/frame_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "experiments/cli/options.h"

namespace restlab {

namespace {

// Purpose of a layer, and its usual names: those of restlab first.
struct LayerKind {
  const char* name;
  std::vector<std::string> usual;
  Image LayeredFrame::*into;
  const char* without;  // assumption if the layer is missing; null: required
};

const std::vector<LayerKind>& layerKinds() {
  static const std::vector<LayerKind> kinds = {
      {"radiance",
       {"", "radiance", "Combined", "beauty", "color"},
       &LayeredFrame::radiance,
       nullptr},
      {"normal", {"normalW", "normal", "Normal", "N"}, &LayeredFrame::normalW, nullptr},
      {"depth", {"depth", "Depth", "Z"}, &LayeredFrame::depthMetres, nullptr},
      {"albedo",
       {"albedo", "Albedo", "Denoising Albedo"},
       &LayeredFrame::albedo,
       "it is not divided by"},
      {"emission", {"emission", "Emit", "emit"}, &LayeredFrame::lights, "no light is in view"},
      {"motion", {"motion", "velocity"}, &LayeredFrame::motion, "nothing has moved"}};
  return kinds;
}

using Names = std::vector<std::string>;

Names shown(const Names& layers) {
  Names names;
  for (const std::string& name : layers) names.push_back(name.empty() ? "(none)" : name);
  return names;
}

// Returns the layers named `usual` after a prefix.
Names withPrefix(const Names& layers, const std::string& usual) {
  Names found;
  for (const std::string& layer : layers) {
    if (!usual.empty() && layer.ends_with("." + usual)) found.push_back(layer);
  }
  return found;
}

std::optional<std::string> usualLayer(const std::filesystem::path& file, const Names& layers,
                                      const LayerKind& kind) {
  for (const std::string& name : kind.usual) {
    if (std::find(layers.begin(), layers.end(), name) != layers.end()) return name;
  }
  for (const std::string& name : kind.usual) {
    const Names found = withPrefix(layers, name);
    if (found.size() == 1) return found.front();
    if (found.size() > 1) {
      failInput(
          fmt::format("{}: has more than one layer for {} ({}); name one with --layers "
                      "{}=NAME",
                      file.string(), kind.name, fmt::join(found, ", "), kind.name));
    }
  }
  return std::nullopt;
}

}  // namespace

FrameLayers::FrameLayers(const std::string& named) {
  if (named.empty()) return;
  Names kinds;
  for (const LayerKind& kind : layerKinds()) kinds.emplace_back(kind.name);
  for (const std::string& item : splitList(named, "--layers")) {
    const size_t equals = item.find('=');
    const std::string kind = item.substr(0, equals);
    const bool isKnown = std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    if (isKnown && equals == std::string::npos)
      failUsage(fmt::format("--layers {}: names no layer; {}=NAME does", item, item));
    if (!isKnown) {
      failUsage(fmt::format("--layers {}: must be KIND=NAME, KIND one of {}{}", item,
                            fmt::join(kinds, ", "), didYouMean(kind, kinds)));
    }
    named_[kind] = item.substr(equals + 1);
  }
  for (const LayerKind& kind : layerKinds()) {
    const auto given = named_.find(kind.name);
    if (given == named_.end() || !given->second.empty() || kind.without != nullptr) continue;
    if (kind.into != &LayeredFrame::radiance)
      failUsage(fmt::format("--layers {}=: it cannot be left out, name a layer", kind.name));
  }
}

LayerNames FrameLayers::find(const std::filesystem::path& file, const Names& layers) const {
  LayerNames names;
  for (const LayerKind& kind : layerKinds()) {
    if (const auto given = named_.find(kind.name); given != named_.end()) {
      if (given->second.empty() && kind.without != nullptr) continue;
      if (std::find(layers.begin(), layers.end(), given->second) == layers.end()) {
        failInput(fmt::format("{}: has no layer '{}' for {} (layers: {}){}", file.string(),
                              given->second, kind.name, fmt::join(shown(layers), ", "),
                              didYouMean(given->second, shown(layers))));
      }
      names[kind.name] = given->second;
      continue;
    }
    if (const auto name = usualLayer(file, layers, kind)) {
      names[kind.name] = *name;
    } else if (kind.without == nullptr) {
      failInput(fmt::format("{}: has no layer for {} (layers: {}); name it with --layers {}=NAME",
                            file.string(), kind.name, fmt::join(shown(layers), ", "), kind.name));
    }
  }
  return names;
}

ExrSelection FrameLayers::selection(const LayerNames& names) {
  ExrSelection wanted(ExrLayers::all, std::set<std::string>{});
  for (const auto& [kind, name] : names) {
    wanted.names->insert(name);
    if (kind == "normal" || kind == "depth" || kind == "motion") wanted.data.insert(name);
  }
  return wanted;
}

LayeredFrame FrameLayers::frame(const LayeredImage& image, const LayerNames& names) {
  LayeredFrame frame;
  for (const LayerKind& kind : layerKinds()) {
    const auto name = names.find(kind.name);
    if (name != names.end()) frame.*kind.into = image.layers.at(name->second);
  }
  return frame;
}

std::map<std::string, std::string> FrameLayers::missing(const LayerNames& names) {
  std::map<std::string, std::string> without;
  for (const LayerKind& kind : layerKinds()) {
    if (!names.contains(kind.name) && kind.without != nullptr) without[kind.name] = kind.without;
  }
  return without;
}

}  // namespace restlab
