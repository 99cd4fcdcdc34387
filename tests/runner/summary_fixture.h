// Runs with known numbers: three of `path` and three of a biased `restir_gi`, with a reference of 1
// in exact halves.
#pragma once

#include <gtest/gtest.h>

#include "experiments/runner/tables/summary.h"

namespace restlab {

inline constexpr uint32_t kSide = 4;

inline RunResult makeRun(uint32_t run, double mse, std::vector<double> timesMs) {
  RunResult result;
  result.run = run;
  result.measured.mse = mse;
  result.measured.mseWithoutLights = run == 0 ? 0.5 * mse : 0.25 * mse;
  result.measured.relmse = 2.0 * mse;
  result.measured.energyRatio = 1.0;
  result.measured.worstShare = 0.1;
  result.passes = {{"pass", timesMs.front()}};
  result.timesMs = std::move(timesMs);
  return result;
}

class SummaryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    suite_.methods.resize(2);
    suite_.timedFrames = 2;
    suite_.methods[0].name = "path";
    suite_.methods[0].session.integrator = "path";
    suite_.methods[0].session.mode = "unbiased";
    suite_.methods[1].name = "gi";
    suite_.methods[1].session.integrator = "restir_gi";
    suite_.methods[1].session.mode = "biased";
    block_.scene = "scene";
    block_.width = block_.height = kSide;
    block_.reference.mean = Image(kSide, kSide, glm::vec3(1.0f));
    block_.reference.half0 = block_.reference.half1 = block_.reference.mean;
    block_.methods.resize(2);
    addRun(0, makeRun(0, 0.8, {10.0, 20.0}), 1.0f);
    addRun(0, makeRun(1, 1.0, {40.0, 80.0}), 1.0f);
    addRun(0, makeRun(2, 1.2, {12.0, 24.0}), 1.0f);
    addRun(1, makeRun(0, 0.10, {11.0, 22.0}), 1.1f);
    addRun(1, makeRun(1, 0.08, {44.0, 88.0}), 1.1f);
    addRun(1, makeRun(2, 0.12, {13.2, 26.4}), 1.1f);
  }
  void addRun(size_t method, RunResult run, float pixel) {
    MethodResult& result = block_.methods[method];
    result.measured.add(Image(kSide, kSide, glm::vec3(pixel)));
    result.runs.push_back(std::move(run));
  }
  Suite suite_;
  BlockResult block_;
};

}  // namespace restlab
