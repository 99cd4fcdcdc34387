#include "experiments/runner/base/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/base/error.h"
#include "experiments/runner/base/log.h"

namespace restlab {

namespace {

void warnOnce(const std::string& line) {
  static std::mutex mutex;
  static std::set<std::string> said;
  const std::scoped_lock lock(mutex);
  if (said.insert(line).second) logWarning(line);
}

// Ignores an aspect ratio that moves no pixel by half a pixel: rounding.
bool arePixelsSquare(const LayeredImage& image) {
  size_t side = 1;
  for (const auto& [name, layer] : image.layers)
    side = std::max({side, size_t(layer.width), size_t(layer.height)});
  return std::abs(double(image.frame.pixelAspectRatio) - 1.0) * double(side) < 0.5;
}

}  // namespace

LayeredImage readColours(const std::filesystem::path& file, const std::set<std::string>& others) {
  std::set<std::string> names = others;
  names.insert("");
  LayeredImage image = readExr(file, {ExrLayers::colours, std::move(names)});
  if (!image.layers.contains(""))
    failInput(fmt::format("{}: has no R, G, B channels outside named layers", file.string()));
  sayNotes(file, image);
  return image;
}

void sayNotes(const std::filesystem::path& file, const LayeredImage& image) {
  for (const std::string& note : image.notes) warnOnce(note);
  if (arePixelsSquare(image)) return;
  warnOnce(fmt::format("{}: its pixelAspectRatio is {}: pixels are taken one by one, as squares",
                       file.string(), image.frame.pixelAspectRatio));
}

void requireSameWindow(const std::string& what, const PixelWindow& window, const std::string& other,
                       const PixelWindow& otherWindow) {
  if (window == otherWindow) return;
  failInput(fmt::format("{} is {}, {} is {}", what, windowText(window, otherWindow), other,
                        windowText(otherWindow, window)));
}

}  // namespace restlab
