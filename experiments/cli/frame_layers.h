// Finds layers of rendered images, also of other programs, by their names.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/frame/image_denoiser.h"
#include "core/image/image.h"

namespace restlab {

// Names of the layers of one file by kind: "radiance", "normal", "depth", "albedo", "emission",
// "motion". Without optional layers that the file lacks.
using LayerNames = std::map<std::string, std::string>;

class FrameLayers {
 public:
  // `named`: "normal=N,depth=Z", layer names by kind; "" instead of a name: without that layer.
  // Other kinds are found by their usual names, possibly after a prefix with a dot
  // ("ViewLayer.Combined"). Throws Error (badUsage).
  explicit FrameLayers(const std::string& named);

  // Throws Error (badInput) if a required or named layer is missing, or the choice is ambiguous.
  LayerNames find(const std::filesystem::path& file, const std::vector<std::string>& layers) const;

  // selection(): layers to read from a file, by the names from find(). frame(): makes a frame of
  // them.
  static ExrSelection selection(const LayerNames& names);
  static LayeredFrame frame(const LayeredImage& image, const LayerNames& names);

  // Returns assumptions for the layers that `names` lacks, by kind: "albedo: it is not divided by".
  static std::map<std::string, std::string> missing(const LayerNames& names);

 private:
  std::map<std::string, std::string> named_;
};

}  // namespace restlab
