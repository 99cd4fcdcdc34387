// Images beside a reference: what must agree.
#pragma once

#include <map>
#include <string>

#include "experiments/runner/reference/reference.h"

namespace restlab {

// Ends the error of another scene or setting, for users who mean it.
constexpr const char* kAnyReference = "--any-reference compares all the same";

// Throws Error (badInput) where both say of which scene and settings they are, and the image of
// `file` is of another one than the reference. `otherwise`: how to compare them all the same.
void requireOfReference(const std::string& file, const std::map<std::string, std::string>& image,
                        const std::string& referenceFile,
                        const std::map<std::string, std::string>& reference,
                        const std::string& otherwise = kAnyReference);

// An EXR with R, G, B outside named layers. Throws Error (badInput) where it cannot be read, has
// none, has another window than the reference, or, unless `anyReference`, says that it is of
// another scene or setting.
LayeredImage readBeside(const std::string& file, const std::string& referenceFile,
                        const Reference& reference, bool anyReference);

// Says in a warning where the reference is a rendered image, whose own noise is in every number.
void warnOfNoReference(const std::string& file, const Reference& reference);

}  // namespace restlab
