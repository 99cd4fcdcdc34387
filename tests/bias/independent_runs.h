// Independent runs of an integrator, ready for the bias test: a new seed and the whole history
// again.
//
// Frames of one history are correlated through reuse, so consecutive frames may not pose as
// samples: an observation is one history. Every frame of an unbiased method has the right mean,
// though, so the mean over a history's frames is as good an observation as its last frame, and a
// quieter one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/compiled_scene.h"
#include "core/session.h"
#include "experiments/statistics/bias_test.h"

namespace restlab::bias {

// What is run, and what of each history is compared: the mean of frames skipped .. frames - 1.
struct Method {
  std::string name;  // for messages
  SessionConfig config;
  uint32_t frames = 1;   // of one history
  uint32_t skipped = 0;  // less than `frames`
  // Of frame 0, 1, ...; the last one stays. Empty: the scene's own.
  std::vector<SceneCamera> cameras;
  // Called before each frame, after the camera is set; it may change the light.
  std::function<void(Session&, uint32_t frame)> before;
};

// Small enough for hundreds of runs; the aspect ratio of the lecture's table.
constexpr uint32_t kWidth = 64, kHeight = 36;

// `path` and `restir_gi` at kWidth x kHeight with their defaults, one thread (the test programs run
// side by side).
Method pathMethod(uint32_t frames);
Method restirMethod(uint32_t frames, uint32_t skipped, const ParameterMap& parameters = {});

// Compiled once a process.
std::shared_ptr<const CompiledScene> builtinScene(const std::string& name);

// The variable RESTLAB_TEST_SEED, 0 to 8, moves all seeds: whether a verdict was luck is asked by
// running a test again with fresh noise. This is by how much; 0 without it. Throws
// std::invalid_argument for other values.
uint32_t seedOffset();

// Seeds firstSeed, firstSeed + 1, ..., all moved by seedOffset().
stats::RunSet independentRuns(const std::shared_ptr<const CompiledScene>& scene,
                              const Method& method, uint32_t firstSeed, size_t runs);

// The images of those runs, one after the other.
void forEachRun(const std::shared_ptr<const CompiledScene>& scene, const Method& method,
                uint32_t firstSeed, size_t runs, const std::function<void(const Image&)>& take);

// Observations that are sums of one run of each method, all of them independent: the images of
// methods that compute parts of one whole.
stats::RunSet independentSums(const std::shared_ptr<const CompiledScene>& scene,
                              const std::vector<Method>& methods, uint32_t firstSeed, size_t runs);

// Runs the method and compares with the truth; the second batch, if it comes to that, has seeds of
// its own. Prints one line with what was found and the power of the test.
stats::BiasReport testMethod(const std::shared_ptr<const CompiledScene>& scene,
                             const Method& method, const stats::Truth& truth, size_t runs,
                             const stats::BiasOptions& options = {});

// The line that testMethod prints.
std::string describe(const std::string& name, const stats::BiasReport& report);

}  // namespace restlab::bias
