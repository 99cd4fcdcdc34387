#include "experiments/runner/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/image/intervals.h"
#include "core/image/metrics.h"
#include "experiments/runner/interrupt.h"
#include "experiments/runner/light_mask.h"
#include "experiments/runner/log.h"
#include "experiments/runner/suite_check.h"

namespace restlab {

namespace {

// Median over frames of each pass, in the order of the first frame.
std::vector<PassTiming> medianPasses(const std::vector<std::vector<PassTiming>>& frames) {
  std::vector<PassTiming> medians = frames.front();
  for (size_t pass = 0; pass < medians.size(); ++pass) {
    std::vector<double> times;
    for (const auto& frame : frames) times.push_back(frame.at(pass).timeMs);
    medians[pass].timeMs = median(times);
  }
  return medians;
}

bool isCheckpoint(const Suite& suite, uint32_t frame) {
  return std::find(suite.checkpoints.begin(), suite.checkpoints.end(), frame) !=
         suite.checkpoints.end();
}

void keepShown(const Session& session, const PreparedScene& prepared, const RunResult& run,
               Image image, MethodResult& method) {
  method.shown = std::move(image);
  method.metadata = describe(prepared, session.config());
  method.metadata["device"] = method.use.device;
  method.metadata["ray_tracing"] = method.use.rayTracing;
  method.metadata["seed"] = std::to_string(run.seed);
  method.metadata["spp"] = "1";
  method.metadata["frame"] = std::to_string(run.measured.frame);
  method.metadata["mse"] = fmt::format("{:.9g}", run.measured.mse);
  method.metadata["time_ms_median"] = fmt::format("{:.6g}", median(run.timesMs));
  method.metadata["health"] = run.health.text();
}

}  // namespace

SessionConfig methodConfig(const Suite& suite, const SuiteMethod& method,
                           const PreparedScene& prepared, const SessionConfig& picture) {
  SessionConfig config = picture;
  config.integrator = method.session.integrator;
  config.mode = method.session.mode;
  config.cache = method.session.cache;
  config.parameters = method.session.parameters;
  config.specialise = method.session.specialise;
  config.backend = method.session.backend;
  suite.chooseDevice(config);
  config.camera = prepared.camera;
  config.russianRoulette = suite.russianRoulette;
  return config;
}

size_t hostBytesPerPixelOfMethod(const Suite& suite) {
  // The session's image, those that are kept of a run, the one that is shown, and the two sums.
  const size_t images = 3 + suite.checkpoints.size();
  return images * sizeof(glm::vec3) + 2 * sizeof(glm::dvec3);
}

FrameError measureFrame(const Image& image, const Reference& reference, uint32_t frame,
                        const std::vector<uint8_t>& withoutLights) {
  // A reference without halves stands for both: its own noise is then part of the MSE.
  const Image& half0 = reference.half0 ? *reference.half0 : reference.mean;
  const Image& half1 = reference.half1 ? *reference.half1 : reference.mean;
  FrameError error;
  error.frame = frame;
  error.nonfinite = countNonfinite(image);
  error.relmse = evaluateMetric("relmse_e1e-2", image, reference.mean).value;
  error.relmseTrimmed = evaluateMetric("relmse_e1e-2_trim0.1", image, reference.mean).value;
  error.energyRatio = evaluateMetric("energy_ratio", image, reference.mean).value;
  error.mse = mseAgainstHalves(image, half0, half1);
  error.worstShare = worstPixelShare(squaredErrorPerPixel(image, half0, half1));
  const bool any = withoutLights.empty() ||
                   std::find(withoutLights.begin(), withoutLights.end(), 1) != withoutLights.end();
  error.mseWithoutLights = any ? mseAgainstHalves(image, half0, half1, withoutLights)
                               : std::numeric_limits<double>::quiet_NaN();
  return error;
}

bool executeBlock(const Suite& suite, const PreparedScene& prepared, const RunSink& sink,
                  BlockResult& block) {
  const size_t count = suite.methods.size();
  std::vector<std::unique_ptr<Session>> sessions;
  block.methods.assign(count, MethodResult());
  const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  StartupLog startup;
  for (size_t m = 0; m < count; ++m) {
    sessions.push_back(std::make_unique<Session>(
        prepared.scene, methodConfig(suite, suite.methods[m], prepared, picture),
        hostBytesPerPixelOfMethod(suite)));
    block.methods[m].featuresNeeded = sessions[m]->featuresNeeded();
    block.methods[m].featuresUsed = sessions[m]->featuresUsed();
    block.methods[m].bytesPerPixel = sessions[m]->bytesPerPixel();
    block.methods[m].use = deviceUseOf(*sessions[m]);
    block.methods[m].startupMs =
        sessions[m]->startup().timeMs + (block.startupMs.empty() ? 0.0 : block.startupMs.at(m));
    startup.add(*sessions[m]);
  }
  startup.print();

  block.withoutLights = pixelsWithoutLights(prepared, sessions.front()->config());

  const uint32_t frames = suite.warmupFrames + suite.timedFrames;
  Progress progress(fmt::format("{} ({})", block.scene, componentName(block.component)),
                    uint64_t(suite.runs) * frames);
  for (uint32_t run = 0; run < suite.runs; ++run) {
    std::vector<RunResult> results(count);
    std::vector<std::vector<std::vector<PassTiming>>> passes(count);
    std::vector<std::vector<std::pair<uint32_t, Image>>> kept(count);  // by frame
    for (size_t m = 0; m < count; ++m) {
      results[m].method = m;
      results[m].run = run;
      results[m].seed = suite.seed + run;
      sessions[m]->reset(results[m].seed);
    }
    for (uint32_t frame = 0; frame < frames; ++frame) {
      for (size_t m = 0; m < count; ++m) {
        const FrameStats stats = sessions[m]->frame();
        if (interruptRequested()) return false;
        if (frame >= suite.warmupFrames) {
          results[m].timesMs.push_back(stats.timeMs);
          results[m].health.add(stats);
          passes[m].push_back(stats.passes);
        }
        // Only copied here: errors are computed after the run, not between timed frames.
        if (frame == suite.warmupFrames || isCheckpoint(suite, frame)) {
          kept[m].emplace_back(frame, sessions[m]->radiance());
        }
      }
      progress.update(uint64_t(run) * frames + frame + 1);
    }
    for (size_t m = 0; m < count; ++m) {
      RunResult& result = results[m];
      MethodResult& method = block.methods[m];
      result.passes = medianPasses(passes[m]);
      for (auto& [frame, image] : kept[m]) {
        const FrameError error = measureFrame(image, block.reference, frame, block.withoutLights);
        if (frame != suite.warmupFrames) {
          result.checkpoints.push_back(error);
          continue;
        }
        result.measured = error;
        (run % 2 == 0 ? method.evenRuns : method.oddRuns).add(image);
        if (run == 0) keepShown(*sessions[m], prepared, result, std::move(image), method);
      }
      method.runs.push_back(std::move(result));
      sink(block, method.runs.back());
    }
  }
  return true;
}

}  // namespace restlab
