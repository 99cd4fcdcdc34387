// Notes on materials that are drawn as they are: laws of a BSDF that they break, and
// approximations.
#pragma once

#include <string>
#include <vector>

#include "core/scene/closure_info.h"
#include "core/scene/scene.h"

namespace restlab {

// The laws that the file of a closure says it breaks, with these parameters.
std::vector<std::string> brokenLaws(const ClosureInfo& info,
                                    const std::vector<ClosureValue>& parameters);

// One line for each material that instances have, or that is part of such a one.
std::vector<std::string> materialNotes(const Scene& scene);

}  // namespace restlab
