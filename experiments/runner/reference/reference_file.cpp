// References as EXR files.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/base/error.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

void writeReference(const std::filesystem::path& file, const Reference& reference) {
  LayeredImage image;
  image.layers[""] = reference.mean;
  if (reference.half0) image.layers["half0"] = *reference.half0;
  if (reference.half1) image.layers["half1"] = *reference.half1;
  if (reference.variance) image.layers["variance"] = *reference.variance;
  image.metadata = reference.metadata;
  writeExr(file, image);
}

namespace {

double metadataNumber(const std::map<std::string, std::string>& metadata, const std::string& key) {
  const auto found = metadata.find(key);
  if (found == metadata.end()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(found->second.c_str(), &end);
  return *end == '\0' && end != found->second.c_str() ? value
                                                      : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Reference readReference(const std::filesystem::path& file) {
  LayeredImage image = readColours(file, {"half0", "half1", "variance"});
  Reference reference;
  reference.mean = std::move(image.layers.at(""));
  // Drop a layer "variance" of other programs: of samples or of the mean, nobody knows.
  if (image.metadata["kind"] != "reference") image.layers.erase("variance");
  for (const char* name : {"half0", "half1", "variance"}) {
    const auto layer = image.layers.find(name);
    if (layer == image.layers.end()) continue;
    std::optional<Image>& slot = std::string(name) == "half0"   ? reference.half0
                                 : std::string(name) == "half1" ? reference.half1
                                                                : reference.variance;
    slot = std::move(layer->second);
  }
  if (reference.half0.has_value() != reference.half1.has_value()) {
    failInput(
        fmt::format("{}: has one of the layers half0 and half1 but not the other", file.string()));
  }
  reference.metadata = std::move(image.metadata);
  const double spp = metadataNumber(reference.metadata, "spp");
  reference.spp = spp > 0.0 ? uint64_t(spp) : 0;
  reference.relmse = metadataNumber(reference.metadata, "relmse_estimate");
  reference.relmseSinceHalf = metadataNumber(reference.metadata, "relmse_since_half");
  reference.timeS = metadataNumber(reference.metadata, "render_time_s");
  return reference;
}

}  // namespace restlab
