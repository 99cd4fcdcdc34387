// Inputs of a job's key, and writing and reading a run.
#include "experiments/runner/run/job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "experiments/runner/run/run_record.h"

namespace restlab {

namespace {

class JobTest : public ::testing::Test {
 protected:
  void SetUp() override {
    SceneRequest request;
    request.scene = "cornell-box";
    prepared_ = prepareScene(request);
    suite_.methods.resize(1);
    suite_.methods[0].name = "gi";
    suite_.methods[0].session.integrator = "restir_gi";
    suite_.methods[0].session.mode = "unbiased";
    block_.scene = "cornell-box";
    block_.width = block_.height = 8;
  }
  std::string key(const std::string& reference = "ref", uint32_t run = 0) const {
    return jobIdentity(suite_, prepared_, block_, run, build_, reference, devices_).key();
  }
  BuildInfo build_ = buildInfo();
  Suite suite_;
  PreparedScene prepared_;
  BlockResult block_;
  std::vector<DeviceUse> devices_ = {{"cpu", "Embree", "embree"}};
};

TEST_F(JobTest, TheKeyHoldsWhatTheNumbersDependOn) {
  std::set<std::string> keys = {key()};
  EXPECT_EQ(key(), *keys.begin()) << "the same twice";
  EXPECT_EQ(key().size(), 32u);
  const auto differs = [&](const std::string& what) {
    EXPECT_TRUE(keys.insert(key()).second) << what;
  };
  EXPECT_TRUE(keys.insert(key("another reference")).second);
  EXPECT_TRUE(keys.insert(key("ref", 1)).second);
  build_.sourceHash = "a changed host source";
  differs("sources");
  build_.measuringHash = "a changed file of those that measure";
  differs("what measures");
  build_.compiler = "another";
  differs("compiler");
  build_.compilerFlags = "-O0";
  differs("flags");
  build_.buildType = "Debug";
  differs("build type");
  build_.gitCommit = "another";
  EXPECT_FALSE(keys.insert(key()).second) << "the sources count, not the commit";
  suite_.maxBounces = 3;
  differs("bounces");
  suite_.seed = 9;
  differs("seed");
  suite_.warmupFrames = 1;
  differs("warm-up");
  suite_.timedFrames = 2;
  differs("frames");
  suite_.accumulate = true;
  differs("accumulation");
  suite_.temporal = true;
  differs("temporal figures");
  suite_.threads = 1;
  differs("threads: times depend on them");
  suite_.methods[0].session.parameters["confidence_cap"] = 3.0;
  differs("parameters");
  suite_.methods[0].session.kernels = KernelChoice::general;
  differs("kernels");
  suite_.methods[0].name = "other";
  differs("name");
  block_.width = 9;
  differs("size");
  devices_[0].device = "another machine";
  differs("device");
  prepared_.contentHash += 1;
  differs("scene");
  suite_.runs = 77;
  EXPECT_FALSE(keys.insert(key()).second) << "more runs leave those that are there";
}

TEST_F(JobTest, ARunSurvivesDiskToTheLastBit) {
  RunResult run;
  run.run = 3;
  run.seed = 4;
  run.measured.frame = 32;
  run.measured.mse = 1.0 / 3.0;
  run.measured.mseWithoutLights = std::nan("");
  run.measured.relmse = INFINITY;
  run.measured.energyRatio = 0.1 + 0.2;
  run.measured.nonfinite = 12345678901234ull;
  run.aged = {{1, 0.5, run.measured}, {8, std::nan(""), run.measured}};
  run.aged[1].error.frame = 7;
  run.accumulated = {{1, 2.5, run.measured}, {2, 5.25, run.measured}};
  run.temporal = TemporalFigures();
  run.temporal->variance = 1e-300;
  run.temporal->referenceDifferenceNoise = 0.1 + 0.2;
  run.temporal->errorDifferenceSquared = 1.0 / 3.0;
  run.temporal->autocorrelation[3] = std::nan("");
  run.timesMs = {1.1, 2.2};
  run.passes = {{"second first", 2.0, 0, 0}, {"a", 1.0, 0, 0}};
  run.health.health.counts[0] = 5;
  run.health.raysPath = 17;
  MethodResult method;
  method.featuresLeftOut = "alpha";
  method.bytesPerPixel = 540;
  method.use = devices_[0];
  method.startupMs = 12.0;
  const auto lines = runLines(suite_, block_, method, run, "key", "started");
  ASSERT_EQ(lines.size(), 5u);
  std::vector<nlohmann::ordered_json> read;
  for (const auto& line : lines) read.push_back(nlohmann::ordered_json::parse(line.dump()));
  MethodResult again;
  const RunResult back = runOfLines(read, again);
  EXPECT_EQ(back.seed, 4u);
  EXPECT_EQ(back.measured.mse, run.measured.mse);
  EXPECT_TRUE(std::isnan(back.measured.mseWithoutLights));
  EXPECT_TRUE(std::isinf(back.measured.relmse));
  EXPECT_EQ(back.measured.energyRatio, run.measured.energyRatio);
  EXPECT_EQ(back.measured.nonfinite, run.measured.nonfinite);
  ASSERT_EQ(back.aged.size(), 2u);
  EXPECT_EQ(back.aged[0].timeMs, 0.5);
  EXPECT_EQ(back.aged[1].age, 8u);
  EXPECT_TRUE(std::isnan(back.aged[1].timeMs));
  EXPECT_EQ(back.aged[1].error.frame, 7u);
  ASSERT_EQ(back.accumulated.size(), 2u);
  EXPECT_EQ(back.accumulated[1].timeMs, 5.25);
  ASSERT_TRUE(back.temporal.has_value());
  EXPECT_EQ(back.temporal->variance, 1e-300);
  EXPECT_EQ(back.temporal->referenceDifferenceNoise, 0.1 + 0.2);
  EXPECT_EQ(back.temporal->errorDifferenceSquared, 1.0 / 3.0);
  EXPECT_TRUE(std::isnan(back.temporal->autocorrelation[3]));
  EXPECT_EQ(back.timesMs, run.timesMs);
  ASSERT_EQ(back.passes.size(), 2u);
  EXPECT_EQ(back.passes[0].name, "second first") << "in their order";
  EXPECT_EQ(back.health.health.counts, run.health.health.counts);
  EXPECT_EQ(again.featuresLeftOut, "alpha");
  EXPECT_EQ(again.use, devices_[0]);
  read.pop_back();
  EXPECT_ANY_THROW(runOfLines(read, again)) << "without its last line it is no run";
}

}  // namespace

}  // namespace restlab
