// Executes one block of a suite: one scene and component, all methods, run after run. The methods
// are interleaved frame by frame, so that whatever slows the machine down slows all of them alike.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/image/bias_runs.h"
#include "experiments/runner/summary/accumulate.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Errors of one image against the reference.
struct FrameError {
  uint32_t frame = 0;             // of the history, from 0; of an accumulation its last one
  double mse = 0.0;               // against the two halves where the reference has them
  double mseWithoutLights = 0.0;  // over the pixels that show no light; NaN where all do
  // Of what the noise of the halves adds to the MSE of all runs, and at most that: the image's own
  // noise is in it (core/image/halves_noise.h). 0 without halves, NaN where it was not recorded.
  double mseVarianceAtMost = 0.0;
  // The same of mseWithoutLights, whose mask is not kept, and what every unbiased method has of it.
  double insideVarianceAtMost = 0.0, insideVarianceCommon = 0.0;
  double relmse = 0.0;         // its numerators against the two halves, like mse
  double relmseTrimmed = 0.0;  // without the worst 0.1 % of the pixels
  double energyRatio = 0.0;
  double worstShare = 0.0;  // of the MSE, in the worst 0.1 % of the pixels
  uint64_t nonfinite = 0;   // channel values in the image
};

// Error of what the first frames of the history give (HistoryMean), those of the warm-up included.
struct AccumulatedError {
  uint32_t frames = 0;
  double timeMs = 0.0;  // passes since the history began; NaN: not measured
  FrameError error;
};

// How the timed frames hang together; with a moving camera only the measured frame and the one
// before it, whose references are known: all but the differences are NaN then. Errors are taken
// against the two halves of the reference in turns, so that its own noise is in none of the
// products.
struct TemporalFigures {
  double variance = 0.0;             // mean over pixels of the sample variance over frames: flicker
  double difference = 0.0;           // mean |f_t - f_{t-1}|
  double referenceDifference = 0.0;  // the same of the references: what moved; 0 of a still camera
  // At most so much of that is the references' own noise.
  double referenceDifferenceNoise = 0.0;
  // mean (e_t - e_{t-1})^2 of the errors e = f - reference: what changes though nothing moved. The
  // differences are taken against those of the two halves, so that their noise cancels.
  double errorDifferenceSquared = 0.0;
  // mean (f_t - half0)(f_{t+k} - half1) over that of k = 0, k = 1...; NaN where there are too few
  // frames or no halves.
  std::array<double, 8> autocorrelation{};
};

// Error of one frame of the history, and what it cost.
struct AgedError {
  uint32_t age = 0;     // frames since the view stands still, this one included
  double timeMs = 0.0;  // of this frame's passes; NaN: not measured
  FrameError error;
};

struct RunResult {
  size_t method = 0;
  uint32_t run = 0, seed = 0;
  FrameError measured;                        // of the frame after the warm-up
  std::vector<AgedError> aged;                // of the suite's ages
  std::vector<AccumulatedError> accumulated;  // 1, 2, 4, ... frames, where the suite asks for it
  std::optional<TemporalFigures> temporal;    // where the suite asks for it
  // Of the timed frames: the passes, nothing else; empty where they were not measured. Of an image
  // what the suite says.
  std::vector<double> timesMs;
  std::vector<std::pair<std::string, MetricValue>> figures;  // further ones, of the measured frame
  std::vector<PassTiming> passes;                            // median over the timed frames
  HealthSum health;                                          // over the timed frames
  HealthSum warmupHealth;                                    // over those before: the history's
};

struct MethodResult {
  std::vector<RunResult> runs;
  BiasRuns measured;                            // the measured frames
  Image shown;                                  // measured frame of the first run that is there
  std::map<std::string, std::string> metadata;  // of that image
  std::string featuresLeftOut;                  // "+"-joined, or "none"
  size_t bytesPerPixel = 0;
  DeviceUse use;
  double startupMs = 0.0;  // until its kernels were ready, wherever in this program that was
};

struct BlockResult {
  std::string scene, camera;
  uint32_t component = rl::RL_COMPONENT_ALL;
  uint32_t width = 0, height = 0;
  // The path of a moving camera; nothing where it is the scene's in every frame.
  std::optional<CameraMotion> motion;
  std::vector<LightPhase> lights;            // empty: they are as loaded in every frame
  Reference reference;                       // of the measured frame's camera and light
  std::optional<Reference> referenceBefore;  // of the frame before it, where it is asked for
  std::string referenceFile;
  // Of each method's kernels, what was spent on this scene before the block; empty: nothing.
  std::vector<double> startupMs;
  std::vector<uint8_t> withoutLights;  // one byte a pixel, 1 where no light is seen directly
  std::vector<PixelMask> masks;        // the suite's; empty where one is of another scene
  std::vector<MethodResult> methods;   // in the suite's order
};

// One run of every rendered method, or of the rows of images: what a job folder holds.
struct JobMethod {
  std::vector<nlohmann::ordered_json> lines;  // of results.jsonl
  Image measured;
  std::map<std::string, std::string> metadata;  // of that image
};
struct JobData {
  std::vector<JobMethod> methods;  // in the suite's order; the lines name them
};

// The session of a method that renders `picture`.
SessionConfig methodConfig(const Suite& suite, const SuiteMethod& method,
                           const PreparedScene& prepared, const SessionConfig& picture);

// What a block holds of each method beside the buffers of its session, roughly.
size_t hostBytesPerPixelOfMethod(const Suite& suite);

// Renders runs of a block whose scene, size, reference and earlier start-up are set.
class BlockExecutor {
 public:
  BlockExecutor(const Suite& suite, const PreparedScene& prepared, BlockResult& block);
  ~BlockExecutor();
  BlockExecutor(const BlockExecutor&) = delete;
  BlockExecutor& operator=(const BlockExecutor&) = delete;

  // Opens the sessions at the first call. `job`: the key that the lines carry. Nothing when it was
  // interrupted.
  std::optional<JobData> execute(uint32_t run, const std::string& job,
                                 const std::string& startedUtc);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Adds the job's runs to the block; throws std::exception where the job does not hold them.
void addJob(const Suite& suite, const JobData& job, BlockResult& block);

// Errors of `image` (MSE against the halves where there are halves). `withoutLights` as in
// BlockResult; empty: all pixels.
FrameError measureFrame(const Image& image, const Reference& reference, uint32_t frame,
                        const std::vector<uint8_t>& withoutLights);

}  // namespace restlab
