// Executes one block of a suite: one scene and component, all methods, all runs. The methods are
// interleaved frame by frame, so that whatever slows the machine down slows all of them alike.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "experiments/runner/accumulate.h"
#include "experiments/runner/backend_choice.h"
#include "experiments/runner/suite.h"

namespace restlab {

// Errors of one frame against the reference.
struct FrameError {
  uint32_t frame = 0;             // of the history, from 0
  double mse = 0.0;               // against the two halves where the reference has them
  double mseWithoutLights = 0.0;  // over the pixels that show no light; NaN where all do
  double relmse = 0.0;
  double relmseTrimmed = 0.0;  // without the worst 0.1 % of the pixels
  double energyRatio = 0.0;
  double worstShare = 0.0;  // of the MSE, in the worst 0.1 % of the pixels
  uint64_t nonfinite = 0;   // channel values in the image
};

struct RunResult {
  size_t method = 0;
  uint32_t run = 0, seed = 0;
  FrameError measured;                  // of the frame after the warm-up
  std::vector<FrameError> checkpoints;  // the suite's further frames
  std::vector<double> timesMs;          // of the timed frames: the passes, nothing else
  std::vector<PassTiming> passes;       // median over the timed frames
  HealthSum health;                     // over the timed frames
};

struct MethodResult {
  std::vector<RunResult> runs;
  ImageSum evenRuns, oddRuns;  // of the measured frames: two halves for the squared bias
  Image shown;                 // measured frame of run 0
  std::map<std::string, std::string> metadata;  // of that image
  uint32_t featuresNeeded = 0, featuresUsed = 0;
  size_t bytesPerPixel = 0;
  DeviceUse use;
  double startupMs = 0.0;  // until its kernels were ready, wherever in this program that was
};

struct BlockResult {
  std::string scene, camera;
  uint32_t component = rl::RL_COMPONENT_ALL;
  uint32_t width = 0, height = 0;
  Reference reference;
  std::string referenceFile;
  // Of each method's kernels, what was spent on this scene before the block; empty: nothing.
  std::vector<double> startupMs;
  std::vector<uint8_t> withoutLights;  // one byte a pixel, 1 where no light is seen directly
  std::vector<MethodResult> methods;   // in the suite's order
};

// The session of a method that renders `picture`.
SessionConfig methodConfig(const Suite& suite, const SuiteMethod& method,
                           const PreparedScene& prepared, const SessionConfig& picture);

// What a block holds of each method beside the buffers of its session, roughly.
size_t hostBytesPerPixelOfMethod(const Suite& suite);

// Called after every finished run of a method.
using RunSink = std::function<void(const BlockResult&, const RunResult&)>;

// Renders the block into `block`, whose scene, size, reference and earlier
// start-up are set. Returns false when it
// was interrupted: the runs that were not finished are absent then, all others are kept.
bool executeBlock(const Suite& suite, const PreparedScene& prepared, const RunSink& sink,
                  BlockResult& block);

// Errors of `image` (MSE against the halves where there are halves). `withoutLights` as in
// BlockResult; empty: all pixels.
FrameError measureFrame(const Image& image, const Reference& reference, uint32_t frame,
                        const std::vector<uint8_t>& withoutLights);

}  // namespace restlab
