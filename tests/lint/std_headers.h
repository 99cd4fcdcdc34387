// Headers of the standard library: the compilers of Debian 13 and 12 bring along other ones.
#pragma once

#include <string>
#include <vector>

#include "tests/lint/rules.h"

namespace restlab::lint {

// Returns the first call of an algorithm of the standard library (std::max, std::sort, std::iota)
// in a file of C++ that includes neither <algorithm> nor, for sums, <numeric>.
std::vector<Finding> findMissingStdHeaders(const std::string& path, const std::string& text);

}  // namespace restlab::lint
