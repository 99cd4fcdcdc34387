// Difference of an image from a truth, per tile and in the mean, and the part that may be noise.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::gates {

// Returns the means of tilesPerSide x tilesPerSide equal tiles, row by row from the upper left.
// Throws std::invalid_argument unless tilesPerSide divides width and height.
std::vector<glm::dvec3> tileMeans(const Image& image, uint32_t tilesPerSide);

// Independent parts of a run of `path`, each the mean of `frames` frames with its own seed.
struct Parts {
  std::vector<Image> images;
  Image mean;
};
Parts renderParts(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config,
                  uint32_t parts, uint32_t frames);

struct TileComparison {
  glm::dvec3 meanRatio{0.0};                 // image / truth, over all pixels
  glm::dvec3 meanRatioError{0};              // standard error of meanRatio, from the parts
  double p50 = 0.0, p90 = 0.0, worst = 0.0;  // of |image / truth - 1| over tiles and channels
  double noise = 0.0;                        // median relative standard error of a tile
  std::string text() const;                  // one line
};

// `truth`: tile means; determines the tiles of the parts. Tiles that are black in both count as
// equal.
TileComparison compareTiles(const Parts& parts, const std::vector<glm::dvec3>& truth);

}  // namespace restlab::gates
