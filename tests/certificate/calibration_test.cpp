// Many certificates of a correct estimator: how often the verdict is false, and whether p-values
// are uniform.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cstdio>

#include "core/scene/compiled/compiled_scene.h"
#include "experiments/statistics/image_sum.h"
#include "tests/bias/independent_runs.h"
#include "tests/certificate/made_up_runs.h"
#include "tests/stats/ks.h"

namespace restlab::certificate {
namespace {

constexpr int kEveryDay = 20, kNightly = 200;

struct Tally {
  int equivalent = 0, biased = 0, notDecided = 0;
  std::vector<double> pValues;  // luminance of the whole image

  void add(const Certificate& c) {
    equivalent += c.verdict == Verdict::equivalent;
    biased += c.verdict == Verdict::biased;
    notDecided += c.verdict == Verdict::notDecided;
    for (const stats::CellVerdict& v : c.cells.cells) {
      if (v.wholeImage && v.quantity == stats::Quantity::luminance && v.testable)
        pValues.push_back(v.welch.pValue);
    }
  }
  int count() const { return equivalent + biased + notDecided; }
  // Prints a share of the certificates with its 95 % interval (Clopper and Pearson).
  void print(const char* name, const char* what, int of) const {
    using boost::math::binomial;
    std::printf(
        "%s: %d certificates: %d equivalent, %d not decided, %d biased; %s: %.2f %% [%.2f, "
        "%.2f]\n",
        name, count(), equivalent, notDecided, biased, what, 100.0 * of / count(),
        100.0 * binomial::find_lower_bound_on_p(count(), of, 0.025),
        100.0 * binomial::find_upper_bound_on_p(count(), of, 0.025));
  }
  // Checks certificates of a method without a bias.
  void expectCalibrated(const char* name) const {
    const double uniform = stats::ksUniformTest(pValues).pValue;
    print(name, "false verdicts", biased);
    std::printf("%s: p-values uniform: p %.3f\n", name, uniform);
    // The family error is 1e-3 before the fresh batch, and less than 1e-6 after it.
    EXPECT_EQ(biased, 0);
    EXPECT_GT(uniform, 1e-3);
  }
};

// Uses as many runs as planned for a method without a bias.
Tally certifyMadeUp(int certificates, double bias) {
  const Image truth = gradient(8);
  const Noise noise{0.15, bias, 1.0};
  Tally tally;
  for (int i = 0; i < certificates; ++i) {
    const Reference reference = makeReference(truth, 0.005, 50'000 + uint64_t(i));
    const Evidence pilot = makeEvidence(truth, noise, 1'000'000 + uint64_t(i), 64);
    const double planned =
        runsForEquivalence(pilot, truthOf(reference, pilot.runs().grid()), Rules());
    EXPECT_GE(planned, 128.0);
    EXPECT_LT(planned, 2000.0);
    tally.add(judgeMadeUp(
        makeEvidence(truth, noise, 1'000'000 + uint64_t(i), uint64_t(std::ceil(planned))), noise,
        truth, reference));
  }
  return tally;
}

void certifyWithoutABias(int certificates) {
  const Tally tally = certifyMadeUp(certificates, 1.0);
  tally.expectCalibrated("made-up runs");
  EXPECT_GE(tally.equivalent, certificates * 7 / 10);
}

TEST(Calibration, OfMadeUpRuns) { certifyWithoutABias(kEveryDay); }
TEST(Calibration, NightlyOfMadeUpRuns) { certifyWithoutABias(kNightly); }

// At most 2.5 % of certificates call a bias at the margin equivalent.
void certifyAtTheMargin(int certificates, double bias) {
  const Tally tally = certifyMadeUp(certificates, bias);
  tally.print("made-up runs with the bias of the margin", "falsely equivalent", tally.equivalent);
  const boost::math::binomial chance(certificates, 0.025);
  EXPECT_LE(tally.equivalent, int(quantile(complement(chance, 1e-4))));
}

TEST(Calibration, OfABiasAtTheMargin) { certifyAtTheMargin(kEveryDay, 1.005); }
TEST(Calibration, NightlyOfABiasAtTheMargin) {
  certifyAtTheMargin(kNightly, 1.005);
  certifyAtTheMargin(kNightly, 0.995);
}

// `path` on a small scene, against a reference of its own in two halves.
TEST(Calibration, NightlyOfPath) {
  const auto scene = bias::builtinScene("cornell-box");
  SessionConfig config;
  config.width = config.height = 16;
  config.threads = 1;
  Session session(scene, config);
  const auto mean = [&](uint32_t seed, uint32_t frames) {
    session.reset(seed);
    ImageSum sum;
    for (uint32_t i = 0; i < frames; ++i) {
      session.frame();
      sum.add(session.radiance());
    }
    return sum.mean();
  };
  Tally tally;
  for (uint32_t i = 0; i < uint32_t(kNightly); ++i) {
    Reference reference;
    reference.half0 = mean(1'000'000 + i, 4096);
    reference.half1 = mean(2'000'000 + i, 4096);
    reference.mean = *reference.half0;
    for (size_t p = 0; p < reference.mean.pixels.size(); ++p)
      reference.mean.pixels[p] = 0.5f * (reference.half0->pixels[p] + reference.half1->pixels[p]);
    const auto batch = [&](uint32_t first) {
      Evidence evidence(config.width, config.height);
      for (uint32_t run = 0; run < 128; ++run) evidence.add(mean(first + i * 128 + run, 8));
      return evidence;
    };
    const Evidence first = batch(10'000'000);
    tally.add(judge(
        first, first.runs(), [&] { return batch(20'000'000).runs(); }, reference, Rules()));
  }
  tally.expectCalibrated("path");
}

}  // namespace
}  // namespace restlab::certificate
