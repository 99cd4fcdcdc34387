// Runs of a made-up renderer: a gradient, times a random factor of mean 1 per pixel.
#pragma once

#include <cmath>
#include <random>

#include "core/image/image.h"
#include "experiments/certificate/certificate.h"

namespace restlab::certificate {

struct Noise {
  double sigma = 0.3;        // of a pixel's factor, which is log-normal
  double bias = 1.0;         // factor of every pixel
  double quarterBias = 1.0;  // further factor of the upper left quarter
};

inline Image gradient(uint32_t side) {
  Image truth(side, side);
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x)
      truth.at(x, y) = glm::vec3(0.2f + float(x) / float(side), 0.5f, 0.1f + 0.01f * float(y));
  return truth;
}

inline Image makeRun(const Image& truth, const Noise& noise, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Image run = truth;
  // The mean of exp(s z) is exp(s^2 / 2).
  const double s = std::sqrt(std::log(1.0 + noise.sigma * noise.sigma));
  for (uint32_t y = 0; y < run.height; ++y) {
    for (uint32_t x = 0; x < run.width; ++x) {
      double factor = noise.bias * std::exp(s * normal(random) - 0.5 * s * s);
      if (x < run.width / 2 && y < run.height / 2) factor *= noise.quarterBias;
      run.at(x, y) *= float(factor);
    }
  }
  return run;
}

inline Evidence makeEvidence(const Image& truth, const Noise& noise, uint64_t seed, uint64_t runs) {
  std::mt19937_64 random(seed);
  Evidence evidence(truth.width, truth.height);
  for (uint64_t run = 0; run < runs; ++run) evidence.add(makeRun(truth, noise, random));
  return evidence;
}

// Makes two halves with this relative noise per pixel.
inline Reference makeReference(const Image& truth, double sigma, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> normal;
  Reference reference;
  reference.mean = truth;
  reference.half0 = reference.half1 = truth;
  for (size_t i = 0; i < truth.pixels.size(); ++i) {
    reference.half0->pixels[i] *= 1.0f + float(sigma) * normal(random);
    reference.half1->pixels[i] *= 1.0f + float(sigma) * normal(random);
    reference.mean.pixels[i] = 0.5f * (reference.half0->pixels[i] + reference.half1->pixels[i]);
  }
  return reference;
}

inline Certificate judgeMadeUp(const Evidence& evidence, const Noise& noise, const Image& truth,
                               const Reference& reference, const Rules& rules = {}) {
  return judge(
      evidence, evidence.runs(),
      [&] { return makeEvidence(truth, noise, 987654321, evidence.count()).runs(); }, reference,
      rules);
}

}  // namespace restlab::certificate
