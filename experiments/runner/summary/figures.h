// Further figures of a measured frame: what a suite asks for besides the columns that are always
// there.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// A metric over all pixels or over those of a mask.
struct FigureInfo {
  std::string name;    // "flip_hdr", "mse@table"
  std::string metric;  // of metricRegistry()
  int mask = -1;       // index in Suite::masks; -1: all pixels
};

// Digits that tables show of it.
int digitsOf(const FigureInfo& figure);

// The suite's metrics, then of each mask the MSE and the suite's metrics.
std::vector<FigureInfo> figureInfos(const Suite& suite);

// All that the figures depend on besides image and reference, for keys; of a block's masks their
// pixels are not known yet.
nlohmann::ordered_json figuresWords(const Suite& suite);

// In the order of figureInfos(), without those whose mask is of another scene.
std::vector<std::pair<std::string, MetricValue>> measureFigures(const Suite& suite,
                                                                const BlockResult& block,
                                                                const Image& image);

}  // namespace restlab
