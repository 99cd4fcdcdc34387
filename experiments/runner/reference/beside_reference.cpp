#include "experiments/runner/reference/beside_reference.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/base/log.h"

namespace restlab {

void requireOfReference(const std::string& file, const std::map<std::string, std::string>& image,
                        const std::string& referenceFile,
                        const std::map<std::string, std::string>& reference,
                        const std::string& otherwise) {
  if (!reference.contains("scene_hash") || !image.contains("scene_hash")) return;
  try {
    requireSameConfiguration(referenceFile, reference, image);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{} as in {} ({})", error.what(), file, otherwise));
  }
}

LayeredImage readBeside(const std::string& file, const std::string& referenceFile,
                        const Reference& reference, bool anyReference) {
  LayeredImage read = readColours(file);
  requireSameWindow(file + ":", windowOf(read.layers.at("")), "the reference " + referenceFile,
                    windowOf(reference.mean));
  if (!anyReference) requireOfReference(file, read.metadata, referenceFile, reference.metadata);
  return read;
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
