// A certificate: what independent runs of a method say of its bias, with a verdict.
//
// The mean of the image is judged by an interval, not by a test that failed to reject: a method is
// *equivalent* where the 95 % interval of the relative bias lies within the margin in luminance and
// in every channel (two one-sided tests, Schuirmann 1987). It is *biased* where a cell of the image
// or all of it differs from the reference by Welch's test under Holm's correction, in a first batch
// of runs and on the same side in a fresh one (experiments/statistics/bias_test.h). Anything else
// is *not decided*.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image/bias_runs.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/summary/accumulate.h"
#include "experiments/statistics/bias_test.h"

namespace restlab::certificate {

// Fewer runs than that are no evidence: the skewness that decides which cells can be tested is
// itself estimated.
constexpr uint64_t kFewestRuns = 32;

// Of so many runs without any skew 1 % of the cells miss by chance what makes them testable; of
// fewer, more.
constexpr uint64_t kRunsForCells = 128;

struct Rules {
  double margin = 0.005;      // of the relative bias of the whole image, both ways
  double confidence = 0.95;   // of its interval
  double familyError = 1e-3;  // of all tests of a certificate together
  double power = 0.9;         // at which the smallest detectable bias and further runs are stated
};

// Independent runs as they come.
class Evidence {
 public:
  Evidence(uint32_t width, uint32_t height) : runs_(stats::BlockGrid(width, height)) {}
  // Throws Error (badInput) where it has another size than those before.
  void add(const Image& run);
  size_t count() const { return runs_.runs(); }
  const stats::RunSet& runs() const { return runs_; }
  const BiasRuns& pixels() const { return pixels_; }
  Image mean() const { return sum_.mean(); }

 private:
  stats::RunSet runs_;
  BiasRuns pixels_;
  ImageSum sum_;
};

// Of one quantity, the mean over the image. Biases are relative to the reference; NaN where that is
// black and the runs are not.
struct ImageBias {
  stats::Quantity quantity = stats::Quantity::luminance;
  double mean = 0.0, reference = 0.0;
  Interval bias;
  double detectable = 0.0;  // the smallest |bias| that its test finds with the power asked for
  // Its noise has the skewness of so many rare events in all runs (see rareEvents).
  double events = 0.0;
  bool isNormal = false;      // nearly: skewed means have no t interval
  bool isEquivalent = false;  // the interval lies within the margin
};

// The rare events (see rareEvents) of a mean that is nearly normal and has an interval, at least.
constexpr double kRareEventsOfInterval =
    1.0 / (stats::BiasOptions().maxSkewness * stats::BiasOptions().maxSkewness);

enum class Verdict { equivalent, biased, notDecided };
const char* verdictName(Verdict verdict);  // "equivalent", "biased", "not decided"

struct Certificate {
  Verdict verdict = Verdict::notDecided;
  std::string reason;            // a sentence
  std::vector<ImageBias> image;  // luminance first
  stats::BiasReport cells;
  // Of the rejections that count, the one that is largest, relative to its reference.
  std::optional<stats::CellVerdict> worst;
  uint64_t runs = 0;               // by which the image is judged
  Interval squaredBias, variance;  // their sum is the MSE of a run against the truth
  // More runs that would decide, if the spread is what it seems, and the bias, or 0 where the
  // interval holds that; nothing where it is decided or where no number of runs decides.
  std::optional<uint64_t> moreRuns;
  double fewestEvents = 0.0;      // rareEvents of the cell in which it is least
  uint64_t nonfiniteSamples = 0;  // sample values that a kernel has set to zero, in all runs
};

// A method that makes values which are not finite is wrong, whatever its mean: they are set to zero
// before an image is there, so that the image cannot tell. 0 changes nothing.
void countNonfiniteSamples(Certificate& certificate, uint64_t samples);

// A rare event of probability q gives a run the skewness 1 / sqrt(q), so that noise of this
// skewness is like that of this many events in all runs. Where it is below some hundreds, a run
// more may change everything.
double rareEvents(double skewness, size_t runs);

// What the reference says of a cell, with its own error where it has halves or a variance.
stats::Truth truthOf(const Reference& reference, const stats::BlockGrid& grid);

// The image is judged by all of the evidence, its cells by `firstBatch`, which may be a part of it.
// `freshBatch` is called at most once, and only where the first batch rejects something. Throws
// std::invalid_argument for other sizes or fewer than kFewestRuns runs.
Certificate judge(const Evidence& evidence, const stats::RunSet& firstBatch,
                  const std::function<stats::RunSet()>& freshBatch, const Reference& reference,
                  const Rules& rules);

// Whether these runs alone reject a cell or the image, and its interval lies beyond the margin.
// That is no verdict, which takes a fresh batch, but more runs will hardly make it equivalent.
bool rejects(const stats::RunSet& runs, const stats::Truth& truth, const Rules& rules);

// Runs after which the whole image would be equivalent with the power asked for, if the bias is 0
// and the spread is that of `pilot`; at least kRunsForCells. NaN where the reference's own
// error alone is too large.
double runsForEquivalence(const Evidence& pilot, const stats::Truth& truth, const Rules& rules);

// The quantity of which most of the image lies in cells that cannot be tested; luminance where all
// of it can.
stats::Quantity leastTestable(const stats::BiasReport& report, const stats::BlockGrid& grid);

// Quantities of which the image as a whole is tested, "red, green"; "" of none.
std::string testedAsAWhole(const Certificate& certificate, const stats::BlockGrid& grid);

// "the cell of blocks x 6 y 5 size 1", "the whole image".
std::string placeOf(const stats::CellVerdict& cell, const stats::BlockGrid& grid);

// A bias relative to a cell's reference, in percent: "+1.2 %"; as it is where that is black.
std::string relativeText(const stats::CellVerdict& cell, int digits);

// Of the quantities that are judged, the largest relative standard error of the reference's mean.
double relativeError(const stats::Truth& truth);

// The quantities of a certificate.
const std::vector<stats::Quantity>& quantities();

}  // namespace restlab::certificate
