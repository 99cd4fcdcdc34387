#include "experiments/cli/layer_previews.h"

#include <fmt/format.h>

#include "core/image/io/layer_colors.h"
#include "experiments/runner/base/log.h"

namespace restlab {

std::filesystem::path layerPreviewPath(const std::filesystem::path& preview,
                                       const std::string& layer) {
  std::filesystem::path file = preview;
  return file.replace_extension(layer + preview.extension().string());
}

void writeLayerPreview(const std::filesystem::path& file, const std::string& layer,
                       const LayeredImage& whole, const Method& method) {
  const Image& image = whole.layers.at(layer);
  std::map<std::string, std::string> words = whole.metadata;
  words["layer"] = layer;
  if (layer == "radiance" || layer == "albedo") return writePng(file, image, 1.0f, words);
  bool isName = layer == "object";
  std::string unit = layer == "depth" || layer == "positionW" ? "m" : "";
  for (const LayerInfo* info : method.layers()) {
    if (info->name != layer) continue;
    isName = info->isName;
    unit = info->unit;
  }
  if (isName) return writePng(file, falseColors(image), 1.0f, words);
  const ValueRange range = valueRange(image);
  words["black"] = fmt::format("{:.6g}", range.least);
  words["white"] = fmt::format("{:.6g}", range.greatest);
  writePng(file, scaledTo(image, range), 1.0f, words);
  logInfo(fmt::format("{}: black is {:.6g}, white is {:.6g}{}{}", file.string(), range.least,
                      range.greatest, unit.empty() ? "" : " ", unit));
}

}  // namespace restlab
