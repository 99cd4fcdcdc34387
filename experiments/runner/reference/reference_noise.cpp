#include "experiments/runner/reference/reference_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/report/text.h"
#include "experiments/statistics/halves_noise.h"

namespace restlab {

namespace {

// relMSE averaged over images, with the mean and with each half as the divisor.
struct ByDivisor {
  double mean = 0.0, half0 = 0.0, half1 = 0.0;
  bool differs() const {
    const double change = std::max(std::abs(half0 - mean), std::abs(half1 - mean));
    return change > kRelmseChangeMax * std::abs(mean);
  }
  std::string text() const {
    return fmt::format("{:+.0f} % and {:+.0f} % if its halves divide instead of their mean",
                       100.0 * (half0 / mean - 1.0), 100.0 * (half1 / mean - 1.0));
  }
};

}  // namespace

ReferenceNoise noiseOf(const Reference& reference, const BiasRuns& runs) {
  if (!reference.half0) return {};
  const Image &half0 = *reference.half0, &half1 = *reference.half1;
  const HalvesNoise halves = halvesNoise(half0, half1);
  return {halves.varianceOfHalf, halves.varianceOfProduct, halves.varianceOfProductAtLeast(),
          runs.sharedVariance(half0, half1)};
}

SharedNoise sharedNoise(const ReferenceNoise& numerator, const ReferenceNoise& denominator,
                        bool areSameImages) {
  return {numerator.shared, denominator.shared,
          areSameImages ? numerator.shared : numerator.commonAtLeast};
}

bool isNearNoise(double mse, const ReferenceNoise& noise) {
  return mse < kVariancesOfHalfMin * noise.varianceOfHalf;
}

std::string relmseFlag(const Reference& reference, const BiasRuns& runs) {
  if (!reference.half0) return "";
  const Image &half0 = *reference.half0, &half1 = *reference.half1;
  const auto add = [](ByDivisor& all, double mean, double by0, double by1) {
    all.mean += mean;
    all.half0 += by0;
    all.half1 += by1;
  };
  ByDivisor relmse, trimmed;
  const std::vector<Image> images = runs.means();
  const double share = 1.0 / double(images.size());
  for (const Image& image : images) {
    const RelativeError mean = relmseAgainstHalves(image, reference.mean, half0, half1);
    const RelativeError by0 = relmseAgainstHalves(image, half0, half0, half1);
    const RelativeError by1 = relmseAgainstHalves(image, half1, half0, half1);
    add(relmse, share * mean.relmse, share * by0.relmse, share * by1.relmse);
    add(trimmed, share * mean.trimmed, share * by0.trimmed, share * by1.trimmed);
  }
  if (!relmse.differs() && !trimmed.differs()) return "";
  // Many runs are kept only as means of groups, which have smaller errors.
  const std::string of = runs.count() > images.size()
                             ? fmt::format(" (of means of {} runs)", runs.count() / images.size())
                             : "";
  const bool isSame = relmse.text() == trimmed.text();
  return fmt::format("relMSE{} depends on the reference's noise: {}{}", of, relmse.text(),
                     isSame              ? ", with the worst pixels and without"
                     : trimmed.differs() ? "; without the worst pixels " + trimmed.text()
                                         : "");
}

}  // namespace restlab
