// Images beside a reference: what must agree, and their errors.
#pragma once

#include <map>
#include <string>

#include "experiments/runner/reference/reference.h"

namespace restlab {

// An EXR with R, G, B outside named layers. Throws Error (badInput) where it cannot be read, has
// none, has another window than the reference, or, unless `anyReference`, says that it is of
// another scene or setting.
LayeredImage readBeside(const std::string& file, const std::string& referenceFile,
                        const Reference& reference, bool anyReference);

// Says in a warning where the reference is a rendered image, whose own noise is in every number.
void warnOfNoReference(const std::string& file, const Reference& reference);

}  // namespace restlab
