// Grids of samples as files: the .vol of Mitsuba 3, version 3, one channel of 32-bit floats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/field/grid.h"

namespace restlab {

inline constexpr size_t kGridHeaderBytes = 48;
inline constexpr uint64_t kMostGridBytes = kGridHeaderBytes + 4 * kMostSamples;

// Says why the box and the cells of a grid are not those of a solid: cells must be wide enough for
// places to be told apart. "": they are.
std::string faultOfGridBox(const SampledGrid& grid);

// `file` begins every error. Throws Error (badInput).
SampledGrid readGrid(const std::vector<uint8_t>& bytes, const std::string& file);
std::vector<uint8_t> gridBytes(const SampledGrid& grid);

}  // namespace restlab
