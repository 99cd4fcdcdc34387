// A certificate: a verdict on the bias of a method, from independent runs.
//
// The mean of the image is judged by an interval, not by a test that failed to reject. A method is
// *equivalent* if the 95 % interval of the relative bias lies within the margin in luminance and in
// every channel (two one-sided tests, Schuirmann 1987). A method is *biased* if a cell of the image
// or the whole image differs from the reference by Welch's test under Holm's correction, in a first
// batch of runs and on the same side in a fresh one (experiments/statistics/bias_test.h). Otherwise
// it is *not decided*.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/reference/reference.h"
#include "experiments/statistics/bias_runs.h"
#include "experiments/statistics/bias_test.h"
#include "experiments/statistics/image_sum.h"

namespace restlab::certificate {

// Fewer runs are no evidence: the skewness that decides which cells can be tested is itself
// estimated.
constexpr uint64_t kFewestRuns = 32;

// With this many runs, 1 % of the cells without any skew fail the criterion of testability by
// chance; with fewer runs more do.
constexpr uint64_t kRunsForCells = 128;

struct Rules {
  double margin = 0.005;      // for the relative bias of the whole image, on both sides
  double confidence = 0.95;   // of the interval of that bias
  double familyError = 1e-3;  // over all tests of a certificate
  double power = 0.9;         // for which the smallest detectable bias and further runs are stated
};

// Accumulates independent runs.
class Evidence {
 public:
  Evidence(uint32_t width, uint32_t height) : runs_(stats::BlockGrid(width, height)) {}
  // Throws Error (badInput) if the size differs from that of earlier runs.
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

// Bias of one quantity, averaged over the image, relative to the reference; NaN if the reference is
// black and the runs are not.
struct ImageBias {
  stats::Quantity quantity = stats::Quantity::luminance;
  double mean = 0.0, reference = 0.0;
  Interval bias;
  double detectable = 0.0;  // smallest |bias| that the test finds with the requested power
  // Number of rare events in all runs whose noise has the same skewness (see rareEvents).
  double events = 0.0;
  bool isNormal = false;      // nearly; skewed means have no t interval
  bool isEquivalent = false;  // the interval lies within the margin
};

// Fewest rare events (see rareEvents) of a mean that is nearly normal and has an interval.
constexpr double kRareEventsOfInterval =
    1.0 / (stats::BiasOptions().maxSkewness * stats::BiasOptions().maxSkewness);

enum class Verdict { equivalent, biased, notDecided };
const char* verdictName(Verdict verdict);  // "equivalent", "biased", "not decided"

struct Certificate {
  Verdict verdict = Verdict::notDecided;
  std::string reason;            // a sentence
  std::vector<ImageBias> image;  // luminance first
  stats::BiasReport cells;
  // Confirmed rejection that counts, with the largest bias relative to its reference.
  std::optional<stats::CellVerdict> worst;
  uint64_t runs = 0;               // that the image is judged by
  Interval squaredBias, variance;  // their sum is the MSE of a run against the truth
  // Further runs that would decide, given the estimated spread and bias (0 if the interval holds
  // 0); absent if decided already, or if no number of runs decides.
  std::optional<uint64_t> moreRuns;
  double fewestEvents = 0.0;      // smallest rareEvents() of all cells
  uint64_t nonfiniteSamples = 0;  // set to zero by kernels, in all runs
};

// Sets the verdict to biased if samples were not finite. Kernels set them to zero, so the image
// cannot show them. 0 changes nothing.
void countNonfiniteSamples(Certificate& certificate, uint64_t samples);

// Returns how many rare events in all runs would cause noise of this skewness: an event of
// probability q gives a run the skewness 1 / sqrt(q). Below some hundreds, one more run may change
// everything.
double rareEvents(double skewness, size_t runs);

// Returns the reference's mean of each cell, with its error if it has halves or a variance.
stats::Truth truthOf(const Reference& reference, const stats::BlockGrid& grid);

// Judges the image by all of the evidence, and its cells by `firstBatch`, which may be a part of
// it. `freshBatch` is called at most once, and only if the first batch rejects something. Throws
// std::invalid_argument for different sizes or fewer than kFewestRuns runs.
Certificate judge(const Evidence& evidence, const stats::RunSet& firstBatch,
                  const std::function<stats::RunSet()>& freshBatch, const Reference& reference,
                  const Rules& rules);

// Returns whether these runs alone reject a cell or the image with an interval beyond the margin.
// Not yet a verdict, which needs a fresh batch, but more runs will hardly make the method
// equivalent.
bool rejects(const stats::RunSet& runs, const stats::Truth& truth, const Rules& rules);

// Returns the runs after which the whole image would be equivalent with the requested power, if the
// bias is 0 and the spread is that of `pilot`; at least kRunsForCells. NaN if the reference's own
// error alone is too large.
double runsForEquivalence(const Evidence& pilot, const stats::Truth& truth, const Rules& rules);

// Returns the quantity with the largest area in cells that cannot be tested; luminance if all cells
// can be tested.
stats::Quantity leastTestable(const stats::BiasReport& report, const stats::BlockGrid& grid);

// Returns the quantities for which the image as a whole is tested, "red, green"; "" if there are
// none.
std::string testedAsAWhole(const Certificate& certificate, const stats::BlockGrid& grid);

// Returns "the cell of blocks x 6 y 5 size 1" or "the whole image".
std::string placeOf(const stats::CellVerdict& cell, const stats::BlockGrid& grid);

// Returns a bias relative to a cell's reference, "+1.2 %"; absolute if the reference is black.
std::string relativeText(const stats::CellVerdict& cell, int digits);

// Returns the largest relative standard error of the reference's mean over the judged quantities.
double relativeError(const stats::Truth& truth);

// Returns the judged quantities.
const std::vector<stats::Quantity>& quantities();

}  // namespace restlab::certificate
