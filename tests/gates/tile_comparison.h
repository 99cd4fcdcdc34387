// How far an image is from a truth, tile by tile and in the mean, and how much of that may be
// noise.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/compiled_scene.h"
#include "core/session.h"

namespace restlab::gates {

// Means of tilesPerSide x tilesPerSide equal tiles, row by row from the upper left. The side must
// divide width and height (std::invalid_argument).
std::vector<glm::dvec3> tileMeans(const Image& image, uint32_t tilesPerSide);

// Independent parts of a run of `path`, each the mean of `frames` frames with a seed of its own.
struct Parts {
  std::vector<Image> images;
  Image mean;
};
Parts renderParts(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config,
                  uint32_t parts, uint32_t frames);

struct TileComparison {
  glm::dvec3 meanRatio{0.0};                 // image / truth, over all pixels
  glm::dvec3 meanRatioError{0};              // its standard error from the parts
  double p50 = 0.0, p90 = 0.0, worst = 0.0;  // of |image / truth - 1| over tiles and channels
  double noise = 0.0;                        // median relative standard error of a tile
  std::string text() const;                  // one line
};

// `truth` holds as many tile means as the parts are divided into. Tiles that are black in both
// count as equal.
TileComparison compareTiles(const Parts& parts, const std::vector<glm::dvec3>& truth);

}  // namespace restlab::gates
