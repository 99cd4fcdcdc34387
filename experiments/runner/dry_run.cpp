#include "experiments/runner/dry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/image/intervals.h"
#include "core/error.h"
#include "experiments/runner/build_info.h"
#include "experiments/runner/experiment.h"
#include "experiments/runner/files.h"
#include "experiments/runner/interrupt.h"
#include "experiments/runner/job.h"
#include "experiments/runner/report.h"
#include "experiments/runner/suite_check.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// The first frame of a history is cheaper than those that have something to reuse.
constexpr uint32_t kProbeFrames = 4;

// Seconds of a frame with all that happens between the passes, by the steady clock.
double secondsOfFrame(const PreparedScene& prepared, const SessionConfig& config,
                      size_t& bytesPerPixel) {
  Session session(prepared.scene, config);
  bytesPerPixel = session.bytesPerPixel();
  std::vector<double> seconds;
  for (uint32_t i = 0; i < kProbeFrames; ++i) {
    throwIfInterrupted("nothing was written");
    const auto start = std::chrono::steady_clock::now();
    session.frame();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return seconds.back();
}

// One that a run would take as it is.
std::optional<Reference> findReference(const Suite& suite, const PreparedScene& prepared,
                                       const ReferenceConfig& config, const fs::path& out,
                                       const std::string& label) {
  const std::string key = referenceKey(prepared, config);
  for (const fs::path& file :
       {out / "references" / (label + ".exr"), referenceCacheFolder() / (key + ".exr")}) {
    std::error_code status;
    if (!fs::exists(file, status)) continue;
    try {
      Reference reference = readReference(file);
      const auto stored = reference.metadata.find("reference_key");
      const bool isOf = stored != reference.metadata.end() && stored->second == key;
      if (isOf && meetsTarget(reference, suite.target)) return reference;
    } catch (const Error&) {
      continue;  // a run says what is wrong with it
    }
  }
  return std::nullopt;
}

// All that a block is measured against: what there is of it, and the hash that its jobs' keys hold;
// "" where some of it is to be made.
std::string referencesThere(const Suite& suite, const SuiteScene& scene,
                            const PreparedScene& prepared, const SessionConfig& picture,
                            const fs::path& out, const BlockResult& block, std::string& hash) {
  if (!scene.reference.empty()) {
    const fs::path found = findAsset(scene.reference);
    hash = referenceHash(readReference(found.empty() ? fs::path(scene.reference) : found));
    return "a file";
  }
  ReferenceConfig config = referenceConfigOf(picture);
  const std::string label = referenceLabel(suite, block);
  if (block.motion) config.camera = cameraAt(*block.motion, suite.warmupFrames);
  const std::optional<Reference> measured = findReference(suite, prepared, config, out, label);
  if (!measured) return "";
  hash = referenceHash(*measured);
  if (block.motion && suite.temporal && suite.warmupFrames > 0) {
    config.camera = cameraAt(*block.motion, suite.warmupFrames - 1);
    const auto before = findReference(suite, prepared, config, out, label + "-before");
    if (!before) return "";
    hash += referenceHash(*before);
  }
  return fmt::format("{} spp", measured->spp);
}

struct Cost {
  size_t there = 0;
  double referenceS = 0.0, runS = 0.0, memoryMiB = 0.0;
  std::string reference;  // what there is of it
};

Cost costOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
            BlockResult& block, const SuiteRequest& request,
            const std::vector<DeviceUse>& devices) {
  Cost cost;
  const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  const double frames = double(suite.warmupFrames) + double(suite.timedFrames);
  size_t bytesPerPixel = 0;
  for (const SuiteMethod& method : suite.rendered()) {
    size_t own = 0;
    cost.runS +=
        frames * secondsOfFrame(prepared, methodConfig(suite, method, prepared, picture), own);
    bytesPerPixel += own + hostBytesPerPixelOfMethod(suite);
  }
  const size_t pixels = size_t(block.width) * block.height;
  cost.memoryMiB =
      double(pixels) * double(std::max(bytesPerPixel, kReferenceBytesPerPixel)) / (1024.0 * 1024.0);
  std::string hash;
  cost.reference = referencesThere(suite, scene, prepared, picture, request.out, block, hash);
  if (!cost.reference.empty()) {
    const JobStore store(request.out);
    for (uint32_t run = 0; run < suite.runs; ++run) {
      const JobIdentity identity =
          jobIdentity(suite, prepared, block, run, buildInfo(), hash, devices);
      cost.there += store.load(identity.key()).has_value();
    }
    return cost;
  }
  cost.reference = "to be made";
  SessionConfig path = picture;
  path.camera = prepared.camera;
  size_t ignored = 0;
  cost.referenceS = suite.target.spp > 0
                        ? double(suite.target.spp) * secondsOfFrame(prepared, path, ignored)
                        : suite.target.timeLimitS;
  return cost;
}

std::string duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60.0);
}

}  // namespace

std::string planText(const std::vector<Suite>& points, const SuiteRequest& request) {
  std::vector<SuiteCheck> checks;
  std::vector<DeviceUse> devices;
  for (const Suite& suite : points) {
    checks.push_back(checkSuite(suite));
    for (const DeviceUse& use : checks.back().devices) {
      if (std::find(devices.begin(), devices.end(), use) == devices.end()) devices.push_back(use);
    }
  }
  std::string lines, missing;
  double allS = 0.0, memoryMiB = 0.0;
  size_t jobs = 0, there = 0;
  for (size_t s = 0; s < points.front().scenes.size(); ++s) {
    const SuiteScene& named = points.front().scenes[s];
    if (named.optional && assetsMissing(named.request, missing)) {
      lines += fmt::format("| {} | skipped: {} is not here | | | | | |\n", named.name, missing);
      continue;
    }
    const PreparedScene prepared =
        checks.front().only ? *checks.front().only : prepareScene(named.request);
    for (const Suite& suite : points) {
      for (const uint32_t component : suite.components) {
        BlockResult block;
        block.scene = named.name;
        block.camera = prepared.cameraName;
        block.component = component;
        sceneResolution(suite, suite.scenes[s], prepared, block.width, block.height);
        block.motion = motionOf(suite, prepared);
        const Cost cost = costOf(suite, suite.scenes[s], prepared, block, request, devices);
        const double runsS = cost.runS * double(suite.runs - cost.there);
        lines += fmt::format("| {} | {}x{} | {} | {} of {} | {} | {} | {:.0f} MiB |\n",
                             blockLabel(suite, block), block.width, block.height,
                             suite.methods.size(), cost.there, suite.runs, cost.reference,
                             duration(cost.referenceS + runsS), cost.memoryMiB);
        allS += cost.referenceS + runsS;
        memoryMiB = std::max(memoryMiB, cost.memoryMiB);
        jobs += suite.runs;
        there += cost.there;
      }
    }
  }
  return fmt::format(
      "| table | size | methods | runs there | reference | time to go | memory |\n"
      "|---|---|---|---|---|---|---|\n{}\n"
      "{} jobs, {} there; about {} and {:.0f} MiB of buffers to go, by {} frames of each method.\n",
      lines, jobs, there, duration(allS), memoryMiB, kProbeFrames);
}

}  // namespace restlab
