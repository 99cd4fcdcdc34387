// Shared declarations of the parts of `restlab compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/statistics/bias_runs.h"

namespace restlab {

struct CompareOptions {
  std::string reference, metrics, conventions, flipExposures, maskFile;
  std::vector<std::string> images, expectations, maxima, rectangles, objects;
  double pixelsPerDegree = kFlipPixelsPerDegree;
  bool json = false, anyReference = false, withoutLights = false, failIfWorse = false;
};

// Bound that fails the comparison (exit code 1). NaN never holds.
struct Expectation {
  std::string text, metric, relation;
  double bound = 0.0;
  bool holds(double value) const;
};

// Parse --expect "mse<0.01" and --max "mse=0.01". Throw Error (badUsage).
Expectation parseExpectation(const std::string& text);
Expectation parseMaximum(const std::string& text);

struct MaskChoice {
  PixelMask mask;    // empty: all pixels
  std::string text;  // description; "" for all pixels
};

// Returns the intersection of --mask, --rect, --object and --without-lights. The latter two trace
// rays in the scene that the reference's metadata name. Throws Error: badUsage, badInput.
MaskChoice chooseMask(const CompareOptions& options, const Reference& reference);

struct ComparedImage {
  std::string file;
  size_t nonfinite = 0;  // over all pixels
  std::vector<MetricValue> values;
};

// bias_rms of all images together.
struct ComparedRuns {
  size_t count = 0;
  Interval squaredBias;  // may be negative
  MetricValue biasRms;
};

// Accumulates images that are independent runs of one method.
class ComparedMethod {
 public:
  // Throws Error (badInput) if pixels or metadata show that `image` is no independent run of the
  // method of the other images; names what differs.
  void add(const std::string& file, const LayeredImage& image);
  ComparedRuns bias(const Reference& reference, const PixelMask& mask) const;

 private:
  struct Run {
    std::string file;
    std::map<std::string, std::string> metadata;
    uint64_t pixelHash = 0;
  };
  std::vector<Run> runs_;
  BiasRuns pixels_;
};

struct Comparison {
  std::string referenceFile;
  Reference reference;
  size_t referenceNonfinite = 0;     // over all pixels of its mean and its halves
  std::vector<std::string> metrics;  // computed per image
  MaskChoice mask;
  std::vector<ComparedImage> images;
  std::optional<ComparedRuns> runs;
};

void printTable(const Comparison& comparison);
void printJson(const Comparison& comparison, const CompareOptions& options);

// Logs an error for a reference and each image with values that are not finite, and for each bound
// that does not hold.
ExitCode judge(const Comparison& comparison, const std::vector<Expectation>& expectations);

}  // namespace restlab
