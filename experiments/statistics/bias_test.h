// Bias test: independent runs against a reference, or against other runs, cell by cell.
//
// The image is divided into at most 64 cells. A t-test needs means that are nearly normal, so cells
// are merged with their neighbours, four to one from below as in a quad-tree, until |skewness| /
// sqrt(runs) <= 0.05. Cells that never reach this are untestable, and their share of the area is
// reported. (The skewness is itself estimated, with a standard error of sqrt(6 / runs): of cells
// without any skew, 17 % miss the criterion by chance at 64 runs, 4 % at 100, 1 % at 128. Use 100
// runs or more; fewer cost resolution, not validity.) Each cell and the whole image are compared by
// Welch's test with the reference's own variance, and Holm's correction holds the error of the
// whole family. A rejection counts only if a fresh batch of seeds rejects the same cell on the same
// side.
//
// In a cell without noise (a lamp seen directly, a furnace, darkness) a t-test would judge nothing
// but rounding. Such a cell is compared for equality: within float rounding it is `equal`, and
// beyond that it is rejected. Equal cells are tested cells, but no members of the family.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/statistics/run_set.h"

namespace restlab::stats {

struct BiasOptions {
  double familyError = 1e-3;
  double maxSkewness = 0.05;  // of |skewness| / sqrt(runs)
  double power = 0.9;         // for which the smallest detectable bias is stated
  bool wholeImage = true;     // test the whole image beside the cells
  std::vector<Quantity> quantities = {Quantity::luminance};
};

struct CellVerdict {
  CellArea area;
  Quantity quantity = Quantity::luminance;
  bool wholeImage = false;
  bool testable = false;  // by a t-test
  bool equal = false;     // without noise, and equal but for rounding: a passed test of its own
  std::string whyNot;     // if neither testable nor equal
  double skewness = 0.0;
  double mean = 0.0, reference = 0.0;  // over runs and pixels
  WelchResult welch;
  double adjustedP = 1.0;  // after Holm's correction
  int side = 0;            // of a rejection: +1 brighter than the reference, -1 darker
  bool confirmed = false;  // the second batch rejects on the same side
  // Smallest |bias| / reference found with the requested power, at the family's strictest level.
  double detectableBias = 0.0;
};

struct BiasReport {
  std::vector<CellVerdict> cells;
  size_t runs = 0;
  double untestableShare = 0.0;  // of the image's area, largest over the quantities
  double equalShare = 0.0;       // of the image's area: without noise; largest over the quantities
  uint64_t nonfinite = 0;        // in runs and reference
  size_t rejected = 0;           // by the first batch
  size_t confirmed = 0;
  double detectableBias = 0.0;       // median over testable cells
  double detectableBiasWhole = 0.0;  // of the whole image; NaN if not testable

  // Returns true if a rejection was confirmed, a value was not finite, or nothing could be tested:
  // every cell too skewed, or a black image.
  bool failed() const;
  // Returns a few lines: rejections with place and side, untestable area, and power.
  std::string text() const;
};

// A reference, or runs of a method known to be right.
struct Truth {
  std::function<Sample(const CellArea&, Quantity)> cell;
  std::function<double(const CellArea&, Quantity)> skewness;  // over sqrt(runs), 0 for a reference
  uint64_t nonfinite = 0;
  BlockGrid grid;
};
Truth truthOf(ReferenceCells reference);
Truth truthOf(RunSet runs);

// `secondBatch`: renders as many runs again, with fresh seeds. Called at most once, and only if the
// first batch rejects something. Throws std::invalid_argument for different grids or fewer than
// eight runs.
BiasReport testBias(const RunSet& runs, const Truth& truth, const BiasOptions& options,
                    const std::function<RunSet()>& secondBatch);

}  // namespace restlab::stats
