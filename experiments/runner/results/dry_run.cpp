#include "experiments/runner/results/dry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/suite_check.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Time the last of several frames: the first frame of a history is cheap, without reuse.
constexpr uint32_t kProbeFrames = 4;

// Returns the wall-clock seconds of a frame, including work between its passes.
double secondsOfFrame(const PreparedScene& prepared, const SessionConfig& config,
                      size_t& bytesPerPixel) {
  Session session(prepared.scene, config);
  bytesPerPixel = session.bytesPerPixel();
  double seconds = 0.0;
  for (uint32_t i = 0; i < kProbeFrames; ++i) {
    throwIfInterrupted("nothing was written");
    const auto start = std::chrono::steady_clock::now();
    session.frame();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return seconds;
}

// Finds a reference that a run would use without further samples.
std::optional<Reference> findReference(const Suite& suite, const PreparedScene& prepared,
                                       const ReferenceConfig& config, const fs::path& out,
                                       const std::string& label) {
  const std::string key = referenceKey(prepared, config);
  std::vector<fs::path> files = {out / "references" / (label + ".exr")};
  if (const fs::path cache = referenceCacheFolder(); !cache.empty())
    files.push_back(cache / (key + ".exr"));
  for (const fs::path& file : files) {
    std::error_code status;
    if (!fs::exists(file, status)) continue;
    try {
      Reference reference = readReference(file);
      const auto stored = reference.metadata.find("reference_key");
      const bool isOf = stored != reference.metadata.end() && stored->second == key;
      if (isOf && meetsTarget(reference, suite.target)) return reference;
    } catch (const Error&) {
      continue;  // a run reports the error
    }
  }
  return std::nullopt;
}

// References of a block that exist.
struct ReferencesThere {
  std::string text;    // for the table
  size_t missing = 0;  // number to be rendered
  std::string hash;    // part of the jobs' keys; "" if some are missing
};

ReferencesThere referencesThere(const Suite& suite, const SuiteScene& scene,
                                const PreparedScene& prepared, const SessionConfig& picture,
                                const fs::path& out, const BlockResult& block) {
  ReferencesThere there;
  if (!scene.reference.empty()) {
    const fs::path found = findAsset(scene.reference);
    there.hash = referenceHash(readReference(found.empty() ? fs::path(scene.reference) : found));
    there.text = "a file";
    return there;
  }
  ReferenceConfig config = referenceOfSuite(suite, picture);
  if (scene.truth != Truth::rendered) {
    const PreparedScene plain = plainOf(suite, scene, prepared, config);
    std::optional<Reference> truth;
    if (scene.truth == Truth::exact) {
      truth = exactReference(scene.request, plain, config);
    } else if (auto rendered =
                   findReference(suite, plain, config, out,
                                 plainLabel(scene.request, suite.cameraPathName, plain, config))) {
      truth = multiplied(std::move(*rendered), radianceFactor(scene.request.scene));
    }
    there.missing = truth ? 0 : 1;
    there.hash = truth ? referenceHash(*truth) : "";
    there.text = truth ? originOf(*truth) : "to be made";
    return there;
  }
  const std::string label = referenceLabel(suite, block);
  if (block.motion) config.camera = cameraAt(*block.motion, suite.warmupFrames);
  const std::optional<Reference> measured =
      findReference(suite, sceneAt(block.lights, prepared, suite.warmupFrames), config, out, label);
  there.missing = measured ? 0 : 1;
  if (measured) there.text = fmt::format("{} spp", measured->spp);
  if (measured) there.hash = referenceHash(*measured);
  if (block.motion && suite.temporal && suite.warmupFrames > 0) {
    config.camera = cameraAt(*block.motion, suite.warmupFrames - 1);
    const auto before =
        findReference(suite, sceneAt(block.lights, prepared, suite.warmupFrames - 1), config, out,
                      label + "-before");
    there.missing += before ? 0 : 1;
    if (before) there.hash += referenceHash(*before);
  }
  if (there.missing == 0) return there;
  there.hash.clear();
  there.text = there.missing > 1 ? fmt::format("{} to be made", there.missing) : "to be made";
  return there;
}

struct Cost {
  size_t there = 0;
  double seconds = 0.0, memoryMiB = 0.0;
  // Set if a reference stops at a target error: the time until then is unknown.
  bool isLowerBound = false;
  std::string reference;  // existing references, for the table
};

// Returns the seconds for one reference, if known.
std::optional<double> secondsOfReference(const Suite& suite, const PreparedScene& prepared,
                                         SessionConfig path) {
  path.camera = prepared.camera;
  const ReferenceTarget& target = suite.target;
  std::optional<double> seconds;
  if (target.timeLimitS > 0.0) seconds = target.timeLimitS;
  if (target.spp == 0) return seconds;
  size_t ignored = 0;
  const double bySamples = double(target.spp) * secondsOfFrame(prepared, path, ignored);
  return std::min(seconds.value_or(bySamples), bySamples);  // the target reached first
}

Cost costOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
            BlockResult& block, const SuiteRequest& request,
            const std::vector<DeviceUse>& devices) {
  Cost cost;
  const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  const double frames = double(suite.warmupFrames) + double(suite.timedFrames);
  double runS = 0.0;
  size_t bytesPerPixel = 0;
  for (const SuiteMethod& method : suite.rendered()) {
    size_t own = 0;
    runS += frames * secondsOfFrame(prepared, methodConfig(suite, method, prepared, picture), own);
    bytesPerPixel += own + hostBytesPerPixelOfMethod(suite);
  }
  const ReferencesThere references =
      referencesThere(suite, scene, prepared, picture, request.out, block);
  cost.reference = references.text;
  const JobStore store(request.out);
  for (uint32_t run = 0; references.missing == 0 && run < suite.runs; ++run) {
    const JobIdentity identity =
        jobIdentity(suite, prepared, block, run, buildInfo(), references.hash, devices);
    cost.there += store.load(identity.key()).has_value();
  }
  // Jobs in parallel: each has its share of the cores, with which the frames were timed, and its
  // own buffers.
  const size_t toMake = request.force ? suite.runs : suite.runs - cost.there;
  const size_t beside = std::max<size_t>(1, std::min<size_t>(suite.jobs, toMake));
  cost.seconds = runS * double((toMake + beside - 1) / beside);
  const size_t pixels = size_t(block.width) * block.height;
  cost.memoryMiB = double(pixels) *
                   double(std::max(bytesPerPixel * beside, referenceBytesPerPixel(suite.target))) /
                   (1024.0 * 1024.0);
  if (references.missing == 0) return cost;
  const std::optional<double> referenceS = secondsOfReference(suite, prepared, picture);
  cost.isLowerBound = !referenceS;
  cost.seconds += double(references.missing) * referenceS.value_or(0.0);
  return cost;
}

std::string duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60.0);
}

// Lists the methods of the tables; each once if settings are swept.
std::string methodsText(const std::vector<Suite>& points) {
  std::string lines =
      "| method | integrator, mode | cache | backend | denoiser | parameters that are given |\n"
      "|---|---|---|---|---|---|\n";
  std::set<std::string> said;
  for (const Suite& suite : points) {
    for (const SuiteMethod& method : suite.methods) {
      if (!said.insert(method.name).second) continue;
      if (method.images) {
        lines += fmt::format("| {} | image | | | | {} |\n", method.name,
                             fmt::join(method.images->files, ", "));
        continue;
      }
      std::vector<std::string> given;
      for (const auto& [key, value] : method.session.parameters)
        given.push_back(fmt::format("{} = {}", key, parameterText(value)));
      const SessionConfig& session = method.session;
      const std::string mode = session.mode.empty() ? "" : ", " + session.mode;
      lines += fmt::format("| {} | {}{} | {} | {} | {} | {} |\n", method.name, session.integrator,
                           mode, cacheName(session), session.backend, session.denoiser,
                           fmt::join(given, ", "));
    }
  }
  return lines;
}

}  // namespace

std::string planText(const std::vector<Suite>& points, const SuiteRequest& request) {
  const std::vector<SuiteCheck> checks = checkSuites(points);
  std::vector<DeviceUse> devices;
  for (const SuiteCheck& found : checks) {
    for (const DeviceUse& use : found.devices) {
      if (std::find(devices.begin(), devices.end(), use) == devices.end()) devices.push_back(use);
    }
  }
  std::string lines, missing;
  double allS = 0.0, memoryMiB = 0.0;
  bool isLowerBound = false;
  size_t jobs = 0, there = 0;
  for (size_t s = 0; s < points.front().scenes.size(); ++s) {
    const SuiteScene& named = points.front().scenes[s];
    if (named.optional && assetsMissing(named.request, missing)) {
      lines += fmt::format("| {} | skipped: {} is not here | | | | | |\n", named.name, missing);
      continue;
    }
    const PreparedScene prepared =
        checks.front().only ? *checks.front().only : prepareScene(named.request);
    for (const Suite& point : points) {
      const Suite suite = ofScene(point, point.scenes[s]);
      for (const uint32_t component : suite.components) {
        BlockResult block;
        block.scene = named.name;
        block.camera = prepared.cameraName;
        block.component = component;
        sceneResolution(suite, suite.scenes[s], prepared, block.width, block.height);
        block.motion = motionOf(suite, suite.scenes[s], prepared);
        block.lights = lightPhases(suite, prepared);
        const Cost cost = costOf(suite, suite.scenes[s], prepared, block, request, devices);
        lines += fmt::format(
            "| {} | {}x{} | {} | {} of {} | {} | {}{} | {:.0f} MiB |\n", blockLabel(suite, block),
            block.width, block.height, suite.methods.size(), cost.there, suite.runs, cost.reference,
            cost.isLowerBound ? "at least " : "", duration(cost.seconds), cost.memoryMiB);
        allS += cost.seconds;
        isLowerBound = isLowerBound || cost.isLowerBound;
        memoryMiB = std::max(memoryMiB, cost.memoryMiB);
        jobs += suite.runs;
        there += cost.there;
      }
    }
  }
  const std::string unknown =
      isLowerBound
          ? "\nThe time of references that are to reach a relmse is not known, and not in it.\n"
          : "";
  return fmt::format(
      "{}\n| table | size | methods | runs there | reference | time to go | memory |\n"
      "|---|---|---|---|---|---|---|\n{}\n"
      "{} jobs, {} there; {} {} and {:.0f} MiB of buffers to go, by {} frames of each method.\n{}",
      methodsText(points), lines, jobs, there, isLowerBound ? "at least" : "about", duration(allS),
      memoryMiB, kProbeFrames, unknown);
}

}  // namespace restlab
