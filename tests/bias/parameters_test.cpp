// Parameter invariance: no setting of an unbiased mode may move the mean. Each setting reaches code
// that the defaults do not. Red and blue are tested besides luminance: the three ways of shading
// have the same luminance by construction and differ in colour.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"

namespace restlab::bias {
namespace {

struct Setting {
  const char* name;
  ParameterMap parameters;
};

void PrintTo(const Setting& s, std::ostream* out) { *out << s.name; }

const std::vector<Setting> kSettings = {
    {"shading winner", {{"shading", std::string("winner")}}},
    {"shading decoupled", {{"shading", std::string("decoupled")}}},
    {"shading control_variate", {{"shading", std::string("control_variate")}}},
    {"light_candidates 4", {{"light_candidates", int64_t{4}}}},
    {"spatial_neighbours 0", {{"spatial_neighbours", int64_t{0}}}},
    {"spatial_neighbours 4", {{"spatial_neighbours", int64_t{4}}}},
    {"donor_noise 0",
     {{"donor_noise", 0.0}, {"aged_neighbours", int64_t{4}}, {"spatial_neighbours", int64_t{4}}}},
    {"spatial_rounds 3", {{"spatial_rounds", int64_t{3}}}},
    {"mis defensive", {{"mis", std::string("defensive")}}},
    {"donor_noise 10", {{"donor_noise", 10.0}}},
    {"young_frames 0", {{"young_frames", 0.0}}},
    {"spatial_radius 64", {{"spatial_radius", 64.0}}},
    {"confidence_cap 5", {{"confidence_cap", 5.0}}},
    {"confidence_cap 50", {{"confidence_cap", 50.0}}},
    {"temporal off", {{"temporal", false}}},
    {"spatial_feedback off", {{"spatial_feedback", false}}},
    {"max_jacobian 2", {{"max_jacobian", 2.0}}},
    {"max_jacobian 100", {{"max_jacobian", 100.0}}},
    {"similarity open", {{"normal_threshold", -1.0}, {"plane_threshold", 10.0}}},
};
const std::vector<Setting> kGlossy = {
    {"roughness_limit 0", {{"roughness_limit", 0.0}}},
    {"roughness_limit 1", {{"roughness_limit", 1.0}}},
};

struct Effort {
  uint32_t width, height;
  size_t runs;
  uint32_t truthFrames;
  uint32_t frames, skipped;
  int threads;
};
// Longer than a confidence cap of 5.
constexpr Effort kNightly{64, 36, 512, 128, 64, 8, 0};

void expectInvariant(const std::string& sceneName, const std::vector<SceneCamera>& cameras,
                     const std::vector<Setting>& tested, const Effort& effort) {
  const auto scene = builtinScene(sceneName);
  const auto adapted = [&](Method method) {
    method.cameras = cameras;
    method.config.width = effort.width;
    method.config.height = effort.height;
    method.config.threads = effort.threads;
    return method;
  };
  stats::BiasOptions options;
  options.quantities = {stats::Quantity::luminance, stats::Quantity::red, stats::Quantity::blue};
  const stats::Truth reference = stats::truthOf(
      independentRuns(scene, adapted(pathMethod(effort.truthFrames)), 1, effort.runs));
  for (const Setting& setting : tested) {
    Method method = adapted(restirMethod(effort.frames, effort.skipped, setting.parameters));
    method.name = setting.name;
    const stats::BiasReport report = testMethod(scene, method, reference, effort.runs, options);
    EXPECT_FALSE(report.failed()) << sceneName << ", " << setting.name << ": " << report.text();
  }
}

// The box from inside with its lamp out of view, whose outline would be most of the noise.
TEST(ParameterInvariance, NightlyCornellBox) {
  expectInvariant("cornell-box", {cornellBelowTheLamp()}, kSettings, kNightly);
}
TEST(ParameterInvariance, NightlyDoorAjar) {
  expectInvariant("door-ajar", {}, kSettings, kNightly);
}
TEST(ParameterInvariance, NightlyGlossyGallery) {
  std::vector<Setting> tested = kSettings;
  tested.insert(tested.end(), kGlossy.begin(), kGlossy.end());
  expectInvariant("glossy-gallery", {}, tested, kNightly);
}

}  // namespace
}  // namespace restlab::bias
