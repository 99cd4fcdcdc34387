// Strands from a table of a scene file, and from text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/scene/curves/strands.h"

namespace restlab {

// Reads 'points' and 'strands'. Throws Error (badUsage) at the key that is wrong.
Strands readStrands(const ConfigTable& table, StrandBasis basis);

// Reads lines "x y z radius"; an empty line ends a strand. `file` begins every error line. Throws
// Error (badInput).
Strands readStrandText(const std::vector<uint8_t>& bytes, const std::string& file,
                       StrandBasis basis);

}  // namespace restlab
