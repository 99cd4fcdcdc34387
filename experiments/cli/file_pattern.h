// File names with '*', '?' and '[...]', as in a shell.
#pragma once

#include <string>
#include <vector>

namespace restlab {

// Returns the files that match `pattern`, in alphabetical order. A component that exists literally
// is taken literally: "[1]/a-*.exr" looks into a folder "[1]". A backslash quotes a character.
std::vector<std::string> filesLike(const std::string& pattern);

}  // namespace restlab
