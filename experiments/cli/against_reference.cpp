#include "experiments/cli/against_reference.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/image/pixel_metrics.h"
#include "experiments/runner/log.h"

namespace restlab {

namespace {

bool identical(const Image& a, const Image& b) {
  return std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

}  // namespace

LayeredImage readBeside(const std::string& file, const std::string& referenceFile,
                        const Reference& reference, bool anyReference) {
  LayeredImage read = readExr(file);
  const auto layer = read.layers.find("");
  if (layer == read.layers.end()) {
    failInput(fmt::format("{}: has no R, G, B channels outside named layers", file));
  }
  const Image& image = layer->second;
  if (image.width != reference.mean.width || image.height != reference.mean.height) {
    failInput(fmt::format("{}: is {}x{}, the reference {} is {}x{}", file, image.width,
                          image.height, referenceFile, reference.mean.width,
                          reference.mean.height));
  }
  const bool bothDescribed =
      reference.metadata.count("scene_hash") && read.metadata.count("scene_hash");
  if (bothDescribed && !anyReference) {
    try {
      requireSameConfiguration(referenceFile, reference.metadata, read.metadata);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{} as in {} (--any-reference compares all the same)",
                                            error.what(), file));
    }
  }
  return read;
}

MetricValue errorAgainst(const std::string& metric, const Image& image, const Reference& reference,
                         const MetricOptions& options) {
  // The halves are for images that are independent of the reference, which it itself is not.
  if (metric != "mse" || !reference.half0 || identical(image, reference.mean)) {
    return evaluateMetric(metric, image, reference.mean, options);
  }
  const double value = mseAgainstHalves(image, *reference.half0, *reference.half1, options.mask);
  if (!std::isnan(value)) return {value, "against the reference's two halves"};
  return {value, fmt::format("{} non-finite values in the image, {} in the reference's halves",
                             countNonfinite(image, options.mask),
                             countNonfinite(*reference.half0, options.mask) +
                                 countNonfinite(*reference.half1, options.mask))};
}

void warnOfNoReference(const std::string& file, const Reference& reference) {
  const auto kind = reference.metadata.find("kind");
  const bool isRendered = reference.metadata.count("integrator") != 0;
  if (isRendered && (kind == reference.metadata.end() || kind->second != "reference")) {
    logWarning(
        fmt::format("{}: is an image, not a reference: its own noise is in every number", file));
  }
}

}  // namespace restlab
