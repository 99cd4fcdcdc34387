// Further figures of a measured frame, which a suite requests besides the fixed columns.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// A metric over all pixels or over a mask.
struct FigureInfo {
  std::string name;    // "flip_hdr", "mse@table"
  std::string metric;  // of metricRegistry()
  int mask = -1;       // index in Suite::masks; -1: all pixels
};

// Returns the suite's metrics, then for each mask the MSE and the suite's metrics.
std::vector<FigureInfo> figureInfos(const Suite& suite);

// Returns all inputs of the figures besides image and reference, for keys. Masks are given by their
// definitions, because their pixels are not known yet.
nlohmann::ordered_json figuresWords(const Suite& suite);

// Returns figures in the order of figureInfos(), without those whose mask is of another scene.
std::vector<std::pair<std::string, MetricValue>> measureFigures(const Suite& suite,
                                                                const BlockResult& block,
                                                                const Image& image);

}  // namespace restlab
