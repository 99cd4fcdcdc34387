// A shader without the code that its constants make dead.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace restlab {

// Takes out of a compute shader what its constants never let run, and puts small functions where
// they are called: a condition may be a constant only there. Drivers inline everything before they
// look for dead code, and take several times as long over the whole
// (docs/decisions/dead-code-before-the-driver.md). Float arithmetic that is decorated NoContraction
// keeps its bits. Returns false, with a reason and the module as it was, if SPIRV-Tools fails.
bool foldSpirv(std::vector<uint32_t>& spirv, std::string& reason);

}  // namespace restlab
