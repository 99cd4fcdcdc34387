// Executes one block of a suite: one scene and component, all methods, run after run. The methods
// are interleaved frame by frame, so that a slowdown of the machine affects all of them alike.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/suite.h"
#include "experiments/statistics/bias_runs.h"

namespace restlab {

// Errors of one image against the reference.
struct FrameError {
  uint32_t frame = 0;             // of the history, from 0; the last one for an accumulated image
  double mse = 0.0;               // against the two halves if the reference has them
  double mseWithoutLights = 0.0;  // over pixels that show no light; NaN if all do
  // Upper bound on the variance that the noise of the halves adds to the MSE of all runs: includes
  // the image's own noise (experiments/statistics/halves_noise.h). 0 without halves, NaN if not
  // recorded.
  double mseVarianceAtMost = 0.0;
  // For mseWithoutLights, whose mask is not kept: the same upper bound, and the part of the
  // variance that all unbiased methods have.
  double insideVarianceAtMost = 0.0, insideVarianceCommon = 0.0;
  double relmse = 0.0;         // numerators against the two halves, like mse
  double relmseTrimmed = 0.0;  // without the worst 0.1 % of the pixels
  double energyRatio = 0.0;
  double worstShare = 0.0;  // of the MSE, caused by the worst 0.1 % of the pixels
  uint64_t nonfinite = 0;   // channel values in the image
};

// Error of the accumulated first frames of the history (HistoryMean), warm-up included.
struct AccumulatedError {
  uint32_t frames = 0;
  double timeMs = 0.0;  // passes since the history began; NaN: not measured
  FrameError error;
};

// How errors and values of successive frames are correlated. With a moving camera only the measured
// frame and the one before it have references: all but the differences are NaN then. Every product
// takes one error against each half of the reference, so that its own noise cancels.
struct TemporalFigures {
  double variance = 0.0;             // mean over pixels of the sample variance over frames: flicker
  double difference = 0.0;           // mean |f_t - f_{t-1}|
  double referenceDifference = 0.0;  // same for the references: real motion; 0 for a still camera
  // Upper bound on the part of referenceDifference that is the references' own noise.
  double referenceDifferenceNoise = 0.0;
  // mean (e_t - e_{t-1})^2 of the errors e = f - reference: change without motion. The reference's
  // difference is taken once from each half, so that its noise cancels.
  double errorDifferenceSquared = 0.0;
  // mean (f_t - half0)(f_{t+k} - half1), divided by its value at k = 0, for k = 1...; NaN without
  // halves or with too few frames.
  std::array<double, 8> autocorrelation{};
};

// Error and time of one frame of the history.
struct AgedError {
  uint32_t age = 0;     // frames since the view came to rest, this one included
  double timeMs = 0.0;  // of this frame's passes; NaN: not measured
  FrameError error;
};

struct RunResult {
  size_t method = 0;
  uint32_t run = 0, seed = 0;
  std::string machine;                        // processor and device; "": not recorded
  FrameError measured;                        // of the first frame after the warm-up
  std::vector<AgedError> aged;                // at the suite's ages
  std::vector<AccumulatedError> accumulated;  // after 1, 2, 4, ... frames, if the suite asks for it
  std::optional<TemporalFigures> temporal;    // if the suite asks for it
  // Time of all passes of each timed frame; empty if not measured. For an image of another program:
  // the time in the suite.
  std::vector<double> timesMs;
  std::vector<std::pair<std::string, MetricValue>> figures;  // further metrics of the measured
                                                             // frame
  std::vector<PassTiming> passes;                            // median over the timed frames
  std::vector<PassTiming> scenePasses;                       // work for the scene, over all frames
  std::vector<double> residuals;                             // Session::residuals()
  HealthSum health;                                          // over the timed frames
  HealthSum warmupHealth;                                    // over the warm-up frames
};

struct MethodResult {
  std::vector<RunResult> runs;
  BiasRuns measured;                            // the measured frames
  Image shown;                                  // measured frame of the first run
  std::map<std::string, std::string> metadata;  // of that image
  std::string featuresLeftOut;                  // "+"-joined, or "none"
  std::string lightLeftOut;                     // Session::lightLeftOut()
  size_t bytesPerPixel = 0;
  DeviceUse use;
  double startupMs = 0.0;  // total time in this program until its kernels were ready
  size_t codeBytes = 0;    // machine code of kernels that were compiled for the scene
};

struct BlockResult {
  std::string scene, camera;
  uint32_t component = rl::RL_COMPONENT_ALL;
  uint32_t width = 0, height = 0;
  // Path of a moving camera; absent if every frame uses the scene's camera.
  std::optional<CameraMotion> motion;
  std::vector<LightPhase> lights;            // empty: lights as loaded in every frame
  Reference reference;                       // of the measured frame's camera and light
  std::optional<Reference> referenceBefore;  // of the frame before the measured one, if requested
  std::string referenceFile;
  // Start-up time of each method's kernels on this scene before the block; empty: none.
  std::vector<double> startupMs;
  std::vector<uint8_t> withoutLights;  // one byte per pixel, 1 if no light is seen directly
  std::vector<PixelMask> masks;        // of the suite; an empty mask belongs to another scene
  std::vector<MethodResult> methods;   // in the suite's order
  // Processors or devices of runs, if they were made on unlike ones: only ratios of times say
  // something then.
  std::vector<std::string> unlikeMachines;
};

// Contents of a job folder: one run of every rendered method, or of the rows of images.
struct JobMethod {
  std::vector<nlohmann::ordered_json> lines;  // of results.jsonl
  Image measured;
  std::map<std::string, std::string> metadata;  // of that image
};
struct JobData {
  std::vector<JobMethod> methods;  // in the suite's order; their lines have the names
};

// Returns the session settings of a method that renders `picture`.
SessionConfig methodConfig(const Suite& suite, const SuiteMethod& method,
                           const PreparedScene& prepared, const SessionConfig& picture);

// Approximate memory of a block per method, besides the buffers of the session.
size_t hostBytesPerPixelOfMethod(const Suite& suite);

// Renders runs of a block; its scene, size, reference and earlier start-up times must be set.
class BlockExecutor {
 public:
  BlockExecutor(const Suite& suite, const PreparedScene& prepared, BlockResult& block);
  ~BlockExecutor();
  BlockExecutor(const BlockExecutor&) = delete;
  BlockExecutor& operator=(const BlockExecutor&) = delete;

  // Opens the sessions at the first call. `job`: the key written to the lines. Returns nothing if
  // interrupted.
  std::optional<JobData> execute(uint32_t run, const std::string& job,
                                 const std::string& startedUtc);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Adds the job's runs to the block. Throws std::exception if data are missing.
void addJob(const Suite& suite, const JobData& job, BlockResult& block);

// Sets `unlikeMachines`. Forgets times of curves where machines are unlike: their means would be of
// no machine.
void compareMachines(BlockResult& block);

// Computes the errors of `image`, against the halves of the reference if it has them.
// `withoutLights`: see BlockResult; empty: all pixels.
FrameError measureFrame(const Image& image, const Reference& reference, uint32_t frame,
                        const std::vector<uint8_t>& withoutLights);

}  // namespace restlab
