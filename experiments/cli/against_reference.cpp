#include "experiments/cli/against_reference.h"

#include <fmt/format.h>

#include "core/error.h"
#include "experiments/runner/run/image_file.h"
#include "experiments/runner/run/log.h"

namespace restlab {

LayeredImage readBeside(const std::string& file, const std::string& referenceFile,
                        const Reference& reference, bool anyReference) {
  LayeredImage read = readColours(file);
  requireSameWindow(file + ":", windowOf(read.layers.at("")), "the reference " + referenceFile,
                    windowOf(reference.mean));
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

void warnOfNoReference(const std::string& file, const Reference& reference) {
  const auto kind = reference.metadata.find("kind");
  const bool isRendered = reference.metadata.count("integrator") != 0;
  if (isRendered && (kind == reference.metadata.end() || kind->second != "reference")) {
    logWarning(
        fmt::format("{}: is an image, not a reference: its own noise is in every number", file));
  }
}

}  // namespace restlab
