// Directional albedo of the GGX reflection lobe, tabulated for the compensation of multiple
// scattering (core/shading/bsdf/multiscatter.glsl).
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace restlab {

// The table that SceneData::ggxAlbedo points to: a row for every node of sqrt(alpha), with its
// nodes of sqrt(cos) and then the row's cosine-weighted mean. x is the loss 1 - E of a lobe whose
// microfacets reflect everything, y the part of E that Schlick's weight selects: with f0 and f90
// the lobe's albedo is f0 (1 - x - y) + f90 y. Means are those of the interpolant, so that
// interpolation in the kernels conserves energy exactly. Computed once per process, by quadrature;
// the bits are always the same.
const std::vector<glm::vec2>& ggxAlbedoTable();

}  // namespace restlab
