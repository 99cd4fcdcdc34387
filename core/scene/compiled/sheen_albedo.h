// Directional albedo of a white sheen, tabulated for what it leaves to the lobes below
// (core/shading/bsdf/sheen.glsl).
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace restlab {

// RL_SHEEN_CELLS^2 records, a row for each cell of sqrt(alpha): bits of the albedo at a cell's four
// corners, along sqrt(cos) first. Alpha below RL_SHEEN_ALPHA_FLOOR counts as that. Computed once
// per process, by quadrature.
const std::vector<glm::uvec4>& sheenAlbedoTable();

}  // namespace restlab
