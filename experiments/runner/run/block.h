// A block before its first frame: what its images show, and the references that it needs.
#pragma once

#include <functional>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Returns the block with names, size, motion and lights, without references. `suite`: from
// ofScene(). Throws Error (badUsage) at the place of a mistake.
BlockResult blockOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                    uint32_t component);

// A reference that is rendered, and its name in a folder of results.
struct NeededReference {
  PreparedScene scene;
  ReferenceConfig config;
  std::string label;
};

// Returns the references of a block that are rendered: that of the measured frame, then that of the
// frame before, if it is asked for. Empty where the suite names a file or an exact image is known.
std::vector<NeededReference> renderedReferences(const Suite& suite, const SuiteScene& scene,
                                                const PreparedScene& prepared,
                                                const BlockResult& block);

// Returns the file of the reference that the suite names for the scene: beside its assets, or as it
// is named.
std::filesystem::path referenceFileNamed(const SuiteScene& scene);

// Sets the block's references and their file, relative to the folder of results. `obtain`: called
// for each of renderedReferences().
void takeReferences(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                    const std::function<Reference(const NeededReference&)>& obtain,
                    BlockResult& block);

}  // namespace restlab
