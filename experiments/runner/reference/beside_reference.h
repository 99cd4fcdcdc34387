// Reads images that are compared with a reference, and checks that both show the same thing.
#pragma once

#include <map>
#include <string>

#include "experiments/runner/reference/reference.h"

namespace restlab {

// Ends the error message about another scene or setting: tells users how to compare anyway.
constexpr const char* kAnyReference = "--any-reference compares all the same";

// Throws Error (badInput) if both name their scene and settings, and those of the image `file`
// differ from the reference's. `otherwise`: how to compare anyway.
void requireOfReference(const std::string& file, const std::map<std::string, std::string>& image,
                        const std::string& referenceFile,
                        const std::map<std::string, std::string>& reference,
                        const std::string& otherwise = kAnyReference);

// Reads an EXR with R, G, B outside named layers. Throws Error (badInput) if it cannot be read, has
// no such channels, has another window than the reference, or, unless `anyReference`, names another
// scene or setting.
LayeredImage readBeside(const std::string& file, const std::string& referenceFile,
                        const Reference& reference, bool anyReference);

// Warns if the reference is a rendered image, whose own noise is in every number.
void warnOfNoReference(const std::string& file, const Reference& reference);

}  // namespace restlab
