#include "experiments/runner/results/dry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/results/measured_cost.h"
#include "experiments/runner/run/block.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/suite_check.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

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
                                const PreparedScene& prepared, const fs::path& out,
                                BlockResult block) {
  ReferencesThere there;
  std::vector<Reference> found;
  for (const NeededReference& needed : renderedReferences(suite, scene, prepared, block)) {
    auto reference = findReference(suite, needed.scene, needed.config, out, needed.label);
    if (reference) found.push_back(std::move(*reference));
    there.missing += reference ? 0 : 1;
  }
  if (there.missing > 0) {
    there.text = there.missing > 1 ? fmt::format("{} to be made", there.missing) : "to be made";
    return there;
  }
  size_t next = 0;
  takeReferences(
      suite, scene, prepared, [&](const NeededReference&) { return std::move(found.at(next++)); },
      block);
  there.hash = referenceHash(block.reference);
  if (block.referenceBefore) there.hash += referenceHash(*block.referenceBefore);
  there.text = !scene.reference.empty()         ? "a file"
               : scene.truth != Truth::rendered ? originOf(block.reference)
                                                : fmt::format("{} spp", block.reference.spp);
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
                                         const BlockResult& block) {
  const ReferenceTarget& target = suite.target;
  std::optional<double> seconds;
  if (target.timeLimitS > 0.0) seconds = target.timeLimitS;
  if (target.spp == 0) return seconds;
  const double bySamples = double(target.spp) * secondsOfSample(suite, prepared, block);
  return std::min(seconds.value_or(bySamples), bySamples);  // the target reached first
}

Cost costOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
            BlockResult& block, const SuiteRequest& request,
            const std::vector<DeviceUse>& devices) {
  Cost cost;
  const MeasuredCost measured = measureRun(suite, prepared, block);
  const ReferencesThere references = referencesThere(suite, scene, prepared, request.out, block);
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
  cost.seconds = measured.runS * double((toMake + beside - 1) / beside);
  const size_t pixels = size_t(block.width) * block.height;
  cost.memoryMiB =
      double(pixels) *
      double(std::max(measured.bytesPerPixel * beside, referenceBytesPerPixel(suite.target))) /
      (1024.0 * 1024.0);
  if (references.missing == 0) return cost;
  const std::optional<double> referenceS = secondsOfReference(suite, prepared, block);
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
        BlockResult block = blockOf(suite, suite.scenes[s], prepared, component);
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
