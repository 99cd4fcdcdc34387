#include "experiments/runner/run/temporal.h"

#include <cmath>

#include "core/base/nan.h"

namespace restlab {

namespace {

double channelSum(const glm::dvec3& v) { return v.x + v.y + v.z; }

// Returns mean (a - half0)(b - half1), averaged with the same for exchanged halves.
double errorProduct(const Image& a, const Image& b, const Image& half0, const Image& half1) {
  double sum = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 x(a.pixels[i]), y(b.pixels[i]), r0(half0.pixels[i]), r1(half1.pixels[i]);
    sum += channelSum((x - r0) * (y - r1) + (x - r1) * (y - r0));
  }
  return sum / (6.0 * double(a.pixels.size()));
}

// Returns mean (d - d0)(d - d1) with d the difference of the frames, d0 and d1 those of the halves.
double errorDifference(const Image& before, const Image& measured, const Reference& referenceBefore,
                       const Reference& reference) {
  double sum = 0.0;
  for (size_t i = 0; i < measured.pixels.size(); ++i) {
    const auto apart = [i](const Image& later, const Image& earlier) {
      return glm::dvec3(later.pixels[i]) - glm::dvec3(earlier.pixels[i]);
    };
    const glm::dvec3 d = apart(measured, before);
    sum += channelSum((d - apart(*reference.half0, *referenceBefore.half0)) *
                      (d - apart(*reference.half1, *referenceBefore.half1)));
  }
  return sum / (3.0 * double(measured.pixels.size()));
}

double meanSquaredDifference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    sum += channelSum(d * d);
  }
  return sum / (3.0 * double(a.pixels.size()));
}

double meanAbsoluteDifference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    sum += channelSum(glm::abs(glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i])));
  return sum / (3.0 * double(a.pixels.size()));
}

// Returns an upper bound of what the noise of the references adds to mean |r_t - r_{t-1}|. With
// noise of strength s the excess g(s) is convex and g(0) = 0, so g(sqrt(2) s) >= sqrt(2) g(s). The
// halves have sqrt(2) times the noise of the mean, and all three differences are known.
double noiseOfDifference(const Reference& before, const Reference& reference, double ofMeans) {
  const double ofHalves = 0.5 * (meanAbsoluteDifference(*reference.half0, *before.half0) +
                                 meanAbsoluteDifference(*reference.half1, *before.half1));
  return (ofHalves - ofMeans) / (std::sqrt(2.0) - 1.0);
}

}  // namespace

TemporalFigures figuresOfPair(const Image& before, const Image& measured,
                              const Reference& referenceBefore, const Reference& reference) {
  TemporalFigures figures;
  figures.variance = kNan;
  figures.autocorrelation.fill(kNan);
  figures.difference = meanAbsoluteDifference(measured, before);
  figures.referenceDifference = meanAbsoluteDifference(reference.mean, referenceBefore.mean);
  figures.referenceDifferenceNoise = figures.errorDifferenceSquared = kNan;
  if (!reference.half0 || !reference.half1 || !referenceBefore.half0 || !referenceBefore.half1)
    return figures;
  figures.referenceDifferenceNoise =
      noiseOfDifference(referenceBefore, reference, figures.referenceDifference);
  figures.errorDifferenceSquared = errorDifference(before, measured, referenceBefore, reference);
  return figures;
}

void TemporalSum::add(const Image& frame) {
  sum_.resize(frame.pixels.size());
  sumSquares_.resize(frame.pixels.size());
  for (size_t i = 0; i < frame.pixels.size(); ++i) {
    const glm::dvec3 value(frame.pixels[i]);
    sum_[i] += value;
    sumSquares_[i] += value * value;
  }
  if (!last_.empty()) {
    differences_ += meanAbsoluteDifference(frame, last_.front());
    squaredDifferences_ += meanSquaredDifference(frame, last_.front());
  }
  last_.push_front(frame);
  if (last_.size() > kLags + 1) last_.pop_back();
  ++frames_;
  if (!reference_.half0 || !reference_.half1) return;
  for (size_t lag = 0; lag < last_.size(); ++lag)
    products_[lag] += errorProduct(frame, last_[lag], *reference_.half0, *reference_.half1);
}

TemporalFigures TemporalSum::figures() const {
  TemporalFigures figures;
  const double n = double(frames_);
  figures.variance = figures.difference = figures.errorDifferenceSquared = kNan;
  if (frames_ > 1) {
    double sum = 0.0;
    for (size_t i = 0; i < sum_.size(); ++i)
      sum += channelSum((sumSquares_[i] - sum_[i] * sum_[i] / n) / (n - 1.0));
    figures.variance = sum / (3.0 * double(sum_.size()));
    figures.difference = differences_ / (n - 1.0);
    figures.errorDifferenceSquared = squaredDifferences_ / (n - 1.0);
  }
  const bool hasHalves = reference_.half0 && reference_.half1;
  for (size_t lag = 1; lag <= kLags; ++lag) {
    const bool isKnown = hasHalves && frames_ > lag;
    figures.autocorrelation[lag - 1] =
        isKnown ? (products_[lag] / (n - double(lag))) / (products_[0] / n) : kNan;
  }
  return figures;
}

}  // namespace restlab
