// Mask of the pixels that `restlab compare` uses.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "experiments/cli/compare.h"
#include "experiments/cli/options.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/run/image_scene.h"
#include "experiments/runner/run/light_mask.h"
#include "experiments/runner/run/object_mask.h"

namespace restlab {

namespace {

PixelRectangle parseRectangle(const std::string& text) {
  const std::vector<std::string> parts = splitList(text, "--rect");
  uint32_t sides[4] = {};
  bool isGood = parts.size() == 4;
  for (size_t i = 0; isGood && i < 4; ++i) {
    const char* end = parts[i].data() + parts[i].size();
    const auto [rest, status] = std::from_chars(parts[i].data(), end, sides[i]);
    isGood = status == std::errc() && rest == end;
  }
  if (!isGood) {
    failUsage(fmt::format("--rect {}: must be X0,Y0,X1,Y1, whole pixels from the upper left corner",
                          text));
  }
  return {sides[0], sides[1], sides[2], sides[3]};
}

PixelMask readMask(const std::string& file, const Image& reference) {
  const LayeredImage read = readColours(file);
  const Image& image = read.layers.at("");
  requireSameWindow(file + ": the mask", windowOf(image), "the reference", windowOf(reference));
  return maskOfImage(image);
}

class MaskBuilder {
 public:
  // Keeps only pixels that `mask` selects; `text` describes it.
  void keep(const PixelMask& mask, const std::string& text) {
    choice_.mask = intersection(choice_.mask, mask);
    choice_.text += (choice_.text.empty() ? "" : ", ") + text;
  }
  // Throws if no pixel is left.
  MaskChoice finish() const {
    const auto isSet = [](uint8_t byte) { return byte != 0; };
    if (!choice_.mask.empty() && std::none_of(choice_.mask.begin(), choice_.mask.end(), isSet)) {
      failInput(fmt::format("no pixel is left to compare: {}", choice_.text));
    }
    return choice_;
  }

 private:
  MaskChoice choice_;
};

}  // namespace

MaskChoice chooseMask(const CompareOptions& options, const Reference& reference) {
  const Image& image = reference.mean;
  MaskBuilder builder;
  if (!options.maskFile.empty()) {
    builder.keep(readMask(options.maskFile, image), "--mask " + options.maskFile);
  }
  if (!options.rectangles.empty()) {
    std::vector<PixelRectangle> rectangles;
    for (const std::string& text : options.rectangles) rectangles.push_back(parseRectangle(text));
    builder.keep(maskOfRectangles(image.width, image.height, rectangles),
                 fmt::format("--rect {}", fmt::join(options.rectangles, " ")));
  }
  if (!options.objects.empty() || options.withoutLights) {
    const ImageScene scene = sceneOfImage(options.reference, reference.metadata);
    if (!options.objects.empty()) {
      builder.keep(pixelsOfObjects(scene.prepared, scene.config, options.objects),
                   fmt::format("--object {}", fmt::join(options.objects, " ")));
    }
    if (options.withoutLights) {
      builder.keep(pixelsWithoutLights(scene.prepared, scene.config), "--without-lights");
    }
  }
  return builder.finish();
}

}  // namespace restlab
