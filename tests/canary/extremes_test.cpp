// Constants that only suit scenes of usual size and brightness must be found by the shipped
// experiments/suites/stress-quick.toml, each by its sweep. Truths are exact, so no wrong kernel
// renders them.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "core/base/error.h"
#include "experiments/runner/results/suite_runner.h"
#include "tests/canary/wrong_kernels.h"
#include "tests/runner/temporary_folder.h"

namespace restlab::canary {
namespace {

// Sweeps of the suite that end early with these mistakes. Tested with `path` alone, because the
// mistakes are in code that all methods share.
const std::set<std::string> kSweeps = {"more light", "less light", "larger", "smaller"};

std::vector<Suite> quickSuite() {
  std::vector<Suite> points =
      loadSuites(RESTLAB_SOURCE_DIR "/experiments/suites/stress-quick.toml", {}, {});
  for (Suite& suite : points) {
    std::erase_if(suite.scenes,
                  [](const SuiteScene& scene) { return !kSweeps.contains(scene.sweepName); });
    std::erase_if(suite.methods, [](const SuiteMethod& method) { return method.name != "path"; });
  }
  return points;
}

class Extremes : public TemporaryFolder {
 protected:
  // Returns the last value that holds, by the name of the sweep. The suite fails at the first
  // energy that is far off.
  std::map<std::string, std::string> lasts(bool fails) const {
    SuiteRequest request;
    request.out = folder() / "out";
    request.argv = {"extremes"};
    request.force = true;
    if (fails) {
      EXPECT_THROW(runSuite(quickSuite(), request), Error);
    } else {
      EXPECT_TRUE(runSuite(quickSuite(), request));
    }
    std::ifstream in(request.out / "table.md");
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const std::regex table("## ([a-z ]+), [a-z]+ of [^#]*\\| path \\| ([^ ]+) \\|");
    std::map<std::string, std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), table), end; it != end; ++it)
      found[(*it)[1]] = (*it)[2];
    return found;
  }
  // Expects these sweeps to end early, at these values.
  void expectFound(const std::string& canary, std::map<std::string, std::string> expected) const {
    const WrongKernels wrong(canary);
    const auto found = lasts(true);
    for (const auto& [sweep, last] : found)
      std::printf("canary %s: %s holds up to %s\n", canary.c_str(), sweep.c_str(), last.c_str());
    expected.merge(std::map(kAll));
    EXPECT_EQ(found, expected) << canary;
  }
  const std::map<std::string, std::string> kAll = {
      {"more light", "2^60"}, {"less light", "2^-60"}, {"larger", "2^17"}, {"smaller", "2^-13"}};
};

TEST_F(Extremes, WithoutAMistakeAllHold) { EXPECT_EQ(lasts(false), kAll); }
TEST_F(Extremes, NightlyAnAbsoluteEpsilonIsFound) {
  expectFound("absolute_epsilon", {{"less light", "1"}});
}
TEST_F(Extremes, NightlyAClampAt1e3IsFound) { expectFound("clamp_at_1e3", {{"more light", "1"}}); }
// The offset exceeds the walls of a small room, and is below the spacing of floats in a large one.
TEST_F(Extremes, AFixedRayOffsetIsFound) {
  expectFound("fixed_ray_offset", {{"smaller", "1"}, {"larger", "1"}});
}

}  // namespace
}  // namespace restlab::canary
