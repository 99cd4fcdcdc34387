#include "experiments/runner/run/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <stdexcept>
#include <thread>

#include "core/backend/stop.h"
#include "core/image/metrics/metrics.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/run/block_masks.h"
#include "experiments/runner/run/figures.h"
#include "experiments/runner/run/run_record.h"
#include "experiments/runner/run/temporal.h"
#include "experiments/runner/suite/picture.h"
#include "experiments/statistics/halves_noise.h"
#include "experiments/statistics/image_sum.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

// Returns the median over frames of each pass, in the pass order of the first frame.
std::vector<PassTiming> medianPasses(const std::vector<std::vector<PassTiming>>& frames) {
  std::vector<PassTiming> medians = frames.front();
  for (size_t pass = 0; pass < medians.size(); ++pass) {
    std::vector<double> times;
    for (const auto& frame : frames) times.push_back(frame.at(pass).timeMs);
    medians[pass].timeMs = median(times);
  }
  for (size_t pass = 0; pass < medians.size(); ++pass)
    medians[pass].isOnce = std::all_of(frames.begin(), frames.end(),
                                       [&](const auto& frame) { return frame.at(pass).isOnce; });
  std::erase_if(medians, [](const PassTiming& pass) { return pass.isOnce; });
  return medians;
}

// Adds the work for the scene of a frame to that of the frames before it.
void addSceneWork(const FrameStats& stats, std::vector<PassTiming>& passes) {
  for (const PassTiming& pass : stats.passes) {
    if (!pass.isOnce) continue;
    const auto known = std::find_if(passes.begin(), passes.end(), [&](const PassTiming& other) {
      return other.name == pass.name;
    });
    if (known == passes.end())
      passes.push_back(pass);
    else
      known->timeMs += pass.timeMs;
  }
}

// Returns the age at which the error of this frame is recorded, 0 if it is not.
uint32_t ageOf(const Suite& suite, uint32_t frame) {
  const auto found = std::find_if(suite.ages.begin(), suite.ages.end(),
                                  [&](uint32_t age) { return suite.frameOfAge(age) == frame; });
  return found == suite.ages.end() ? 0 : *found;
}

// Accumulated images are measured after 1, 2, 4, ... frames, and after all of them.
bool isAccumulationPoint(uint32_t count, uint32_t all) {
  return count == all || (count & (count - 1)) == 0;
}

std::map<std::string, std::string> imageMetadata(const PreparedScene& prepared,
                                                 const Session& session, const RunResult& run) {
  std::map<std::string, std::string> metadata = describe(prepared, session.config());
  metadata["device"] = session.device();
  metadata["ray_tracing"] = session.rayTracing();
  metadata.merge(provenanceWords());
  metadata["seed"] = std::to_string(run.seed);
  metadata["kind"] = "image";
  metadata["spp"] = "1";
  metadata["frame"] = std::to_string(run.measured.frame);
  metadata["mse"] = fmt::format("{:.9g}", run.measured.mse);
  if (!run.timesMs.empty()) metadata["time_ms_median"] = fmt::format("{:.6g}", median(run.timesMs));
  metadata["health"] = run.health.text();
  return metadata;
}

}  // namespace

SessionConfig methodConfig(const Suite& suite, const SuiteMethod& method,
                           const PreparedScene& prepared, const SessionConfig& picture) {
  SessionConfig config = picture;
  config.integrator = method.session.integrator;
  config.mode = method.session.mode;
  config.cache = method.session.cache;
  config.parameters = method.session.parameters;
  config.kernels = method.session.kernels;
  config.denoiser = method.session.denoiser;
  config.backend = method.session.backend;
  suite.chooseDevice(config);
  config.camera = prepared.camera;
  if (suite.jobs > 1 && suite.threads == 0)
    config.threads = int(std::max(1u, std::thread::hardware_concurrency() / suite.jobs));
  return config;
}

size_t hostBytesPerPixelOfMethod(const Suite& suite) {
  // Session image, kept frames of a run, shown image, images of the runs.
  size_t images = 3 + suite.ages.size(), sums = 0;
  images += 1 + std::min<size_t>(suite.runs, BiasRuns::kGroups);
  if (suite.accumulate) {
    images += 2 + size_t(std::bit_width(suite.warmupFrames + suite.timedFrames));
    ++sums;
  }
  if (suite.temporal) {
    images += TemporalSum::kLags + 1;
    sums += 2;
  }
  return images * sizeof(glm::vec3) + sums * sizeof(glm::dvec3);
}

FrameError measureFrame(const Image& image, const Reference& reference, uint32_t frame,
                        const std::vector<uint8_t>& withoutLights) {
  // Without halves the mean stands in for both: the reference's own noise is then part of the MSE.
  const Image& half0 = reference.half0 ? *reference.half0 : reference.mean;
  const Image& half1 = reference.half1 ? *reference.half1 : reference.mean;
  FrameError error;
  error.frame = frame;
  error.nonfinite = countNonfinite(image);
  const RelativeError relative = relmseAgainstHalves(image, reference.mean, half0, half1);
  error.relmse = relative.relmse;
  error.relmseTrimmed = relative.trimmed;
  error.energyRatio = evaluateMetric("energy_ratio", image, reference.mean).value;
  error.mse = mseAgainstHalves(image, half0, half1);
  if (reference.half0) error.mseVarianceAtMost = sharedVarianceAtMost(image, half0, half1);
  error.worstShare = worstPixelShare(squaredErrorPerPixel(image, half0, half1));
  const bool any = withoutLights.empty() ||
                   std::find(withoutLights.begin(), withoutLights.end(), 1) != withoutLights.end();
  error.mseWithoutLights = any ? mseAgainstHalves(image, half0, half1, withoutLights)
                               : std::numeric_limits<double>::quiet_NaN();
  if (any && reference.half0) {
    error.insideVarianceAtMost = sharedVarianceAtMost(image, half0, half1, withoutLights);
    error.insideVarianceCommon = halvesNoise(half0, half1, withoutLights).varianceOfProduct;
  }
  return error;
}

struct BlockExecutor::Impl {
  Impl(const Suite& ofSuite, const PreparedScene& ofScene, BlockResult& ofBlock)
      : suite(ofSuite), prepared(ofScene), block(ofBlock) {}

  void open() {
    const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
    StartupLog startup;
    for (size_t m = 0; m < suite.rendered().size(); ++m) {
      sessions.push_back(std::make_unique<Session>(
          prepared.scene, methodConfig(suite, suite.methods[m], prepared, picture),
          hostBytesPerPixelOfMethod(suite)));
      const Session& session = *sessions.back();
      MethodResult method;
      method.featuresLeftOut = featureNames(rl::RL_FEATURE_ALL & ~session.featuresUsed());
      // A reference by a method has its light alone: rows answer for their bias.
      if (suite.referenceMethod.empty()) method.lightLeftOut = session.lightLeftOut();
      method.bytesPerPixel = session.bytesPerPixel();
      method.codeBytes = session.codeBytes();
      method.use = deviceUseOf(session);
      method.startupMs =
          session.startup().timeMs + (block.startupMs.empty() ? 0.0 : block.startupMs.at(m));
      descriptions.push_back(std::move(method));
      startup.add(session);
    }
    startup.print();
    prepareMasks(suite, prepared, block);
  }

  // Data collected from one method's frames during a run.
  struct Frames {
    std::vector<std::vector<PassTiming>> passes;
    std::vector<std::pair<uint32_t, Image>> kept;          // frame index, image
    std::vector<std::pair<AccumulatedError, Image>> sums;  // accumulated images
    std::optional<HistoryMean> accumulated;
    double timeMs = 0.0;  // since the history began
    std::optional<TemporalSum> temporal;
  };

  void take(size_t m, uint32_t frame, const FrameStats& stats, RunResult& result, Frames& frames) {
    frames.timeMs += stats.timeMs + stats.sceneMs;
    if (suite.timing) addSceneWork(stats, result.scenePasses);
    const bool isTimed = frame >= suite.warmupFrames;
    (isTimed ? result.health : result.warmupHealth).add(stats);
    if (isTimed) {
      if (suite.timing) {
        result.timesMs.push_back(stats.timeMs);
        frames.passes.push_back(stats.passes);
      }
    }
    // Only copy here: errors are computed after the run, not between timed frames.
    const bool isBefore = block.referenceBefore && frame + 1 == suite.warmupFrames;
    const uint32_t age = ageOf(suite, frame);
    if (age > 0) {
      AgedError& aged = result.aged.emplace_back();
      aged.age = age;
      aged.timeMs = suite.timing ? stats.timeMs : std::numeric_limits<double>::quiet_NaN();
    }
    if (frame == suite.warmupFrames || isBefore || age > 0)
      frames.kept.emplace_back(frame, sessions[m]->radiance());
    if (suite.accumulate) accumulate(*sessions[m], frame, frames);
    if (isTimed && suite.temporal && !block.motion) {
      if (!frames.temporal) frames.temporal.emplace(block.reference);
      frames.temporal->add(sessions[m]->radiance());
    }
  }

  // Accumulates from the start of the history, because its time includes the warm-up.
  void accumulate(const Session& session, uint32_t frame, Frames& frames) const {
    if (!frames.accumulated) frames.accumulated.emplace(session.averagedFrames());
    frames.accumulated->add(session.radiance());
    const uint32_t count = frame + 1;
    if (!isAccumulationPoint(count, suite.warmupFrames + suite.timedFrames)) return;
    AccumulatedError point;
    point.frames = count;
    point.timeMs = suite.timing ? frames.timeMs : std::numeric_limits<double>::quiet_NaN();
    point.error.frame = frame;
    frames.sums.emplace_back(point, frames.accumulated->mean());
  }

  void measure(RunResult& result, Frames& frames, Image& measured) const {
    if (suite.timing) result.passes = medianPasses(frames.passes);
    if (block.referenceBefore) {
      const auto at = std::find_if(frames.kept.begin(), frames.kept.end(), [&](const auto& kept) {
        return kept.first + 1 == suite.warmupFrames;
      });
      result.temporal =
          figuresOfPair(at->second, (at + 1)->second, *block.referenceBefore, block.reference);
      if (ageOf(suite, at->first) == 0) frames.kept.erase(at);
    }
    for (auto& [frame, image] : frames.kept) {
      const FrameError error = measureFrame(image, block.reference, frame, block.withoutLights);
      for (AgedError& aged : result.aged) {
        if (suite.frameOfAge(aged.age) == frame) aged.error = error;
      }
      if (frame != suite.warmupFrames) continue;
      result.measured = error;
      result.figures = measureFigures(suite, block, image);
      measured = std::move(image);
    }
    for (auto& [point, image] : frames.sums) {
      point.error = measureFrame(image, block.reference, point.error.frame, block.withoutLights);
      result.accumulated.push_back(point);
    }
    if (frames.temporal) result.temporal = frames.temporal->figures();
  }

  // Returns nothing after a signal.
  std::optional<JobData> execute(uint32_t run, const std::string& job,
                                 const std::string& startedUtc) {
    try {
      return executeWhole(run, job, startedUtc);
    } catch (const FrameStopped&) {
      return std::nullopt;
    }
  }

  std::optional<JobData> executeWhole(uint32_t run, const std::string& job,
                                      const std::string& startedUtc) {
    if (sessions.empty()) open();
    const size_t count = suite.rendered().size();
    std::vector<RunResult> results(count);
    std::vector<Frames> frames(count);
    for (size_t m = 0; m < count; ++m) {
      results[m].method = m;
      results[m].run = run;
      results[m].seed = suite.seed + run;
      sessions[m]->reset(results[m].seed);
    }
    const uint32_t length = suite.warmupFrames + suite.timedFrames;
    for (uint32_t frame = 0; frame < length; ++frame) {
      const PreparedScene& shown = sceneAt(block.lights, prepared, frame);
      std::optional<SceneCamera> camera;
      if (block.motion) camera = cameraAt(*block.motion, frame);
      for (size_t m = 0; m < count; ++m) {
        sessions[m]->setScene(shown.scene);
        if (camera) sessions[m]->setCamera(*camera);
        const FrameStats stats = sessions[m]->frame();
        if (interruptRequested()) return std::nullopt;
        take(m, frame, stats, results[m], frames[m]);
      }
    }
    noteUndrawnLights();
    JobData data;
    for (size_t m = 0; m < count; ++m) {
      JobMethod& method = data.methods.emplace_back();
      measure(results[m], frames[m], method.measured);
      results[m].residuals = sessions[m]->residuals();
      method.metadata = imageMetadata(sceneAt(block.lights, prepared, suite.warmupFrames),
                                      *sessions[m], results[m]);
      if (const auto camera = measuredCamera(suite, block)) {
        describeCamera(*camera, method.metadata);
        method.metadata["camera_index"] = "none";
        method.metadata["camera_path"] = suite.cameraPathName;
      }
      method.lines = runLines(suite, block, descriptions[m], results[m], job, startedUtc);
    }
    return data;
  }

  void noteUndrawnLights() {
    undrawnLights.clear();
    for (size_t m = 0; m < sessions.size(); ++m) {
      const std::string text = sessions[m]->drawnLights().text();
      if (text.empty()) continue;
      undrawnLights.push_back(
          fmt::format("{}, {}: {}", prepared.scene->source().name, suite.methods[m].name, text));
    }
  }

  const Suite& suite;
  const PreparedScene& prepared;
  BlockResult& block;
  std::vector<std::unique_ptr<Session>> sessions;
  std::vector<MethodResult> descriptions;  // constant over runs
  std::vector<std::string> undrawnLights;  // lines, after the last run
};

BlockExecutor::BlockExecutor(const Suite& suite, const PreparedScene& prepared, BlockResult& block)
    : impl_(std::make_unique<Impl>(suite, prepared, block)) {}

BlockExecutor::~BlockExecutor() {
  for (const std::string& line : impl_->undrawnLights) logInfo(line);
}

std::optional<JobData> BlockExecutor::execute(uint32_t run, const std::string& job,
                                              const std::string& startedUtc) {
  return impl_->execute(run, job, startedUtc);
}

void addJob(const Suite& suite, const JobData& job, BlockResult& block) {
  block.methods.resize(suite.methods.size());
  for (const JobMethod& own : job.methods) {
    const std::string name = own.lines.at(0).at("method").get<std::string>();
    const auto found = std::find_if(suite.methods.begin(), suite.methods.end(),
                                    [&](const SuiteMethod& method) { return method.name == name; });
    if (found == suite.methods.end())
      throw std::invalid_argument(fmt::format("the suite has no method '{}'", name));
    const size_t m = size_t(found - suite.methods.begin());
    MethodResult& method = block.methods[m];
    RunResult run = runOfLines(own.lines, method);
    run.method = m;
    method.measured.add(own.measured);
    if (method.runs.empty()) {  // run 0 if present
      method.shown = own.measured;
      method.metadata = own.metadata;
    }
    method.runs.push_back(std::move(run));
  }
}

void compareMachines(BlockResult& block) {
  // Compare within a method: a table may have methods on several devices.
  std::vector<std::string> unlike;
  for (const MethodResult& method : block.methods) {
    std::vector<std::string> own;
    for (const RunResult& run : method.runs) {
      const bool isKnown = std::find(own.begin(), own.end(), run.machine) != own.end();
      if (!run.timesMs.empty() && !run.machine.empty() && !isKnown) own.push_back(run.machine);
    }
    if (own.size() > 1 && unlike.empty()) unlike = own;
  }
  block.unlikeMachines = unlike;
  if (unlike.empty()) return;
  constexpr double kForgotten = std::numeric_limits<double>::quiet_NaN();
  for (MethodResult& method : block.methods) {
    for (RunResult& run : method.runs) {
      for (AgedError& aged : run.aged) aged.timeMs = kForgotten;
      for (AccumulatedError& point : run.accumulated) point.timeMs = kForgotten;
    }
  }
}

}  // namespace restlab
