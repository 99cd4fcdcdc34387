// A filter moves light between pixels; it must not change the total.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/scene.h"
#include "tests/conformance/variants.h"
#include "tests/denoise/layered_images.h"
#include "tests/varied_scenes.h"
#include "experiments/statistics/welch.h"

namespace restlab::denoise {
namespace {

using Case = std::tuple<std::string, std::string>;  // scene, denoiser
class FilterEnergy : public testing::TestWithParam<Case> {};

double meanOf(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += double(p.x) + double(p.y) + double(p.z);
  return sum / double(image.pixels.size());
}

// Compares the mean of a history with equally weighted frames, or of single frames. Both sessions
// have the same frames and therefore the same noise.
TEST_P(FilterEnergy, IsWithinOnePercent) {
  const auto& [name, denoiser] = GetParam();
  constexpr uint32_t kFrames = 12, kRuns = 4;
  const auto scene = bias::builtinScene(name);
  SessionConfig config = filterConfig("none", {64, 36});
  Session plain(scene, config);
  config.denoiser = denoiser;
  Session filtered(scene, config);
  const bool hasHistory = findDenoiser(denoiser).hasHistory;
  std::vector<double> ratios;
  for (uint32_t run = 0; run < kRuns; ++run) {
    plain.reset(run + 1);
    filtered.reset(run + 1);
    double before = 0.0, after = 0.0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
      plain.frame();
      filtered.frame();
      before += meanOf(plain.radiance());
      const double shown = meanOf(filtered.radiance());
      after = hasHistory ? kFrames * shown : after + shown;
    }
    ratios.push_back(after / before);
  }
  const stats::Sample s = stats::summarise(ratios);
  const double halfWidth = std::sqrt(s.variance / s.n) * stats::studentQuantile(0.975, s.n - 1.0);
  RecordProperty("energy", std::to_string(s.mean));
  std::printf("%s, %s: energy %.4f +- %.4f\n", name.c_str(), denoiser.c_str(), s.mean, halfWidth);
  EXPECT_LE(std::abs(s.mean - 1.0) + halfWidth, 0.01) << "the whole interval lies within 1 %";
}

const std::vector<std::string> kDaily = {"cornell-box", "door-ajar", "glossy-gallery", "courtyard"};

std::vector<std::string> nightly() {
  std::vector<std::string> scenes = test::variedScenes();
  std::erase_if(scenes, [](const std::string& name) {
    return std::find(kDaily.begin(), kDaily.end(), name) != kDaily.end();
  });
  return scenes;
}

const auto kDenoisers = testing::Values("atrous", "svgf", "asvgf", "svgf_restir");

std::string nameOfCase(const testing::TestParamInfo<Case>& test) {
  std::string name = std::get<0>(test.param) + "_" + std::get<1>(test.param);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Builtin, FilterEnergy,
                         testing::Combine(testing::ValuesIn(kDaily), kDenoisers), nameOfCase);
INSTANTIATE_TEST_SUITE_P(Nightly, FilterEnergy,
                         testing::Combine(testing::ValuesIn(nightly()), kDenoisers), nameOfCase);

}  // namespace
}  // namespace restlab::denoise
