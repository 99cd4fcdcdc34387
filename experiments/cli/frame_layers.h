// Layers of rendered images, ours and those of others, by their names.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image_denoiser.h"

namespace restlab {

// Names of the layers of one file, by what they are for: "radiance", "normal", "depth", "albedo",
// "emission", "motion". Those that the file lacks and that are not needed are not in it.
using LayerNames = std::map<std::string, std::string>;

class FrameLayers {
 public:
  // `named`: "normal=N,depth=Z", names of layers by kind; "" in the place of a name: without that
  // layer. Kinds that are not in it have one of their usual names, which may follow a prefix that
  // ends with a dot ("ViewLayer.Combined"). Throws Error (badUsage).
  explicit FrameLayers(const std::string& named);

  // Throws Error (badInput) where a layer that is needed, or that was named, is not there, or two
  // could be meant.
  LayerNames find(const std::filesystem::path& file, const std::vector<std::string>& layers) const;

  // selection() tells readers which layers of a file to read, by the names that find() gave;
  // frame() makes a frame of them.
  static ExrSelection selection(const LayerNames& names);
  static LayeredFrame frame(const LayeredImage& image, const LayerNames& names);

  // What is taken for the layers that are not in `names`: "albedo: it is not divided by", by kind.
  static std::map<std::string, std::string> missing(const LayerNames& names);

 private:
  std::map<std::string, std::string> named_;
};

}  // namespace restlab
