// Names of files with '*', '?' and '[...]', as a shell has them.
#pragma once

#include <string>
#include <vector>

namespace restlab {

// The files that `pattern` names, in alphabetical order. A folder or a file that is called exactly
// as a part of it is that part: "[1]/a-*.exr" looks into a folder "[1]". A backslash takes a
// character as it is.
std::vector<std::string> filesLike(const std::string& pattern);

}  // namespace restlab
