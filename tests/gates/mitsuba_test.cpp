// Two images by Mitsuba of direct light from a directional light: units of KHR_lights_punctual,
// shadows, and linear vertex colours that multiply the base colour.
#include "core/image/metrics/metrics.h"
#include "tests/bias/independent_runs.h"
#include "tests/gates/gate_files.h"
#include "experiments/statistics/tost.h"

namespace restlab::gates {
namespace {

// Samples per pixel of Mitsuba's images, which have noise; their file of variances has negative
// entries. Single pixels look like some 20,000 samples. The means of their three channels, equal by
// construction, differ by 0.12 %: with 20,000 independent samples per pixel a chance of one in a
// million, with some 2,000 the expected spread.
constexpr double kTheirSamples = 2'000.0;
constexpr double kMargin = 0.002;  // relative to the mean, for equivalence

void expectAgreement(const std::string& gate, size_t runs, uint32_t frames) {
  const auto scene = CompiledScene::build(loadGltf(gateFolder(gate) / (gate + ".gltf")));
  const Image truth = readExr(gateFolder(gate) / "ref.exr").layers.at("");
  bias::Method method = bias::pathMethod(frames);
  method.config.width = truth.width;
  method.config.height = truth.height;
  method.config.maxBounces = 1;

  // Uses our variance of a sample, per pixel, for Mitsuba's image.
  Image mean(truth.width, truth.height), variance(truth.width, truth.height);
  Session session(scene, method.config);
  constexpr int kFrames = 64;
  for (int i = 0; i < kFrames; ++i) {
    session.frame();
    for (size_t p = 0; p < mean.pixels.size(); ++p) {
      const glm::vec3 v = session.radiance().pixels[p];
      mean.pixels[p] += v * (1.0f / kFrames);
      variance.pixels[p] += v * v * (1.0f / kFrames);
    }
  }
  for (size_t p = 0; p < mean.pixels.size(); ++p) {
    const glm::vec3 m = mean.pixels[p];
    variance.pixels[p] =
        glm::max(variance.pixels[p] - m * m, glm::vec3(0.0f)) / float(kTheirSamples);
  }
  const stats::BlockGrid grid(truth.width, truth.height);
  const stats::Truth reference =
      stats::truthOf(stats::ReferenceCells::fromVariance(grid, truth, variance));
  stats::BiasOptions options;
  options.quantities = {stats::Quantity::red, stats::Quantity::green, stats::Quantity::blue};
  method.name = "path";
  const stats::BiasReport report = bias::testMethod(scene, method, reference, runs, options);
  EXPECT_FALSE(report.failed()) << report.text();

  // Compares the mean over channels, because a single channel of Mitsuba's image is too noisy.
  const stats::CellArea whole{0, 0, grid.side};
  const stats::RunSet set = bias::independentRuns(scene, method, 50'000'000, runs);
  std::vector<double> grey(runs, 0.0);
  stats::Sample theirs;
  const double channels = double(options.quantities.size());
  for (const stats::Quantity q : options.quantities) {
    const std::vector<double> means = set.cellMeans(whole, q);
    for (size_t r = 0; r < runs; ++r) grey[r] += means[r] / channels;
    const stats::Sample channel = reference.cell(whole, q);
    theirs.n = channel.n;
    theirs.mean += channel.mean / channels;
    theirs.variance += channel.variance / (channels * channels);  // independent channels
    std::printf("gate %s, %s: %.6f beside %.6f\n", gate.c_str(), stats::quantityName(q),
                stats::summarise(means).mean, channel.mean);
  }
  const stats::Sample ours = stats::summarise(grey);
  const stats::TostResult r = stats::tostTest(ours, theirs, kMargin * theirs.mean, 1e-3);
  std::printf("gate %s, mean: %.6f beside %.6f (%+.3f %%), equivalent within %.1f %%: p %.2g\n",
              gate.c_str(), ours.mean, theirs.mean, 100.0 * (ours.mean / theirs.mean - 1.0),
              100.0 * kMargin, r.pValue);
  EXPECT_LT(r.pValue, 1e-3);
}

TEST(Gates, MitsubaDirectionalLight) {
  RESTLAB_NEED_GATE("mi-directional");
  expectAgreement("mi-directional", 512, 16);
}

TEST(Gates, MitsubaVertexColors) {
  RESTLAB_NEED_GATE("mi-vertex-color");
  expectAgreement("mi-vertex-color", 512, 16);
}

}  // namespace
}  // namespace restlab::gates
