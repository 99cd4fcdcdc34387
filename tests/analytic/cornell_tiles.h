// Converged tile means of the built-in Cornell box: a truth for whole global illumination that
// needs no file. Measured, not exact, by a renderer that shares no code with this one.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/image/image.h"

namespace restlab::analytic {

// Measured image: 512 x 512 pixels, box filter of one pixel, first camera, at most 8 scattering
// events, no Russian roulette.
constexpr uint32_t kCornellTileSize = 64, kCornellTilesPerSide = 8, kCornellScatteringEvents = 8;

// Mean radiance of the 8 x 8 tiles, row by row from the upper left.
using TileMeans = std::array<glm::dvec3, size_t(kCornellTilesPerSide) * kCornellTilesPerSide>;
const TileMeans& cornellTileMeans();

// Largest relative standard error of any channel of any tile in cornellTileMeans().
constexpr double kCornellTileError = 0.0015;

// Mean over all pixels, from another renderer with a thousand samples per pixel.
inline const glm::dvec3 kCornellMean(0.19590, 0.12730, 0.03641);

// Means of the tiles of an image, which must be 512 x 512 (std::invalid_argument).
TileMeans tileMeansOf(const Image& image);

}  // namespace restlab::analytic
