// Independent runs of an integrator for the bias test: each has a new seed and a new history.
//
// Frames of one history are correlated by reuse, so consecutive frames are no independent samples:
// one observation is one history. Every frame of an unbiased method has the right mean, though, so
// the mean over a history's frames is as good an observation as its last frame, and less noisy.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/statistics/bias_test.h"

namespace restlab::bias {

// A method, and the part of each history that is compared: the mean of frames skipped .. frames -
// 1.
struct Method {
  std::string name;  // for messages
  SessionConfig config;
  uint32_t frames = 1;   // per history
  uint32_t skipped = 0;  // less than `frames`
  // Camera of frame 0, 1, ...; the last one is kept. Empty: the scene's own.
  std::vector<SceneCamera> cameras;
  // Called before each frame, after the camera is set; may change the light.
  std::function<void(Session&, uint32_t frame)> before;
};

// Small enough for hundreds of runs; aspect ratio 16:9.
constexpr uint32_t kWidth = 64, kHeight = 36;

// `path` and a method of reuse at kWidth x kHeight with their defaults and one thread (the test
// programs run in parallel).
Method pathMethod(uint32_t frames);
Method restirMethod(uint32_t frames, uint32_t skipped, const ParameterMap& parameters = {},
                    const std::string& integrator = "restir_gi");

// Compiles each scene once per process.
std::shared_ptr<const CompiledScene> builtinScene(const std::string& name);

// Returns the seed offset from the variable RESTLAB_TEST_SEED, 0 to 8, with which a test can be
// repeated with fresh noise. 0 if unset. Throws std::invalid_argument for other values.
uint32_t seedOffset();

// Uses the seeds firstSeed, firstSeed + 1, ..., all moved by seedOffset().
stats::RunSet independentRuns(const std::shared_ptr<const CompiledScene>& scene,
                              const Method& method, uint32_t firstSeed, size_t runs);

// Passes the images of those runs to `take`, one after the other.
void forEachRun(const std::shared_ptr<const CompiledScene>& scene, const Method& method,
                uint32_t firstSeed, size_t runs, const std::function<void(const Image&)>& take);

// Each observation is the sum of one run of each method, all independent: for methods that compute
// parts of one image.
stats::RunSet independentSums(const std::shared_ptr<const CompiledScene>& scene,
                              const std::vector<Method>& methods, uint32_t firstSeed, size_t runs);

// Runs the method and compares it with the truth; a second batch has its own seeds. Prints one line
// with the result and the power of the test.
stats::BiasReport testMethod(const std::shared_ptr<const CompiledScene>& scene,
                             const Method& method, const stats::Truth& truth, size_t runs,
                             const stats::BiasOptions& options = {});

// Returns the line that testMethod prints.
std::string describe(const std::string& name, const stats::BiasReport& report);

}  // namespace restlab::bias
