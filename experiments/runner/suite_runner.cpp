#include "experiments/runner/suite_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <exception>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/image/atomic_file.h"
#include "experiments/runner/build_info.h"
#include "experiments/runner/files.h"
#include "experiments/runner/interrupt.h"
#include "experiments/runner/log.h"
#include "experiments/runner/report.h"
#include "experiments/runner/suite_check.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// summary.csv, table.md and the images belong to one run: what an earlier one left would pass for
// this one's where this one ends early. results.jsonl says of every line which run it is of.
// A file that the suite itself reads stays.
void removeEarlierResults(const fs::path& out, const Suite& suite) {
  std::error_code status;
  const auto isRead = [&](const fs::path& file) {
    for (const SuiteScene& scene : suite.scenes) {
      for (const std::string& name : {scene.reference, scene.request.environment}) {
        if (!name.empty() && fs::equivalent(file, findAsset(name), status)) return true;
      }
    }
    return false;
  };
  std::vector<fs::path> old = {out / "summary.csv", out / "table.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator(out / "images", status)) {
    const fs::path extension = entry.path().extension();
    const bool isImage = extension == ".exr" || extension == ".png";
    if (isImage && !isRead(entry.path())) old.push_back(entry.path());
  }
  for (const fs::path& file : old) {
    if (!fs::is_directory(file, status)) fs::remove(file, status);
    if (fs::is_regular_file(file, status)) {
      failInput(fmt::format("{}: is of an earlier run and cannot be removed", file.string()));
    }
  }
}

class SuiteRun {
 public:
  SuiteRun(const Suite& suite, const SuiteRequest& request)
      : suite_(suite), request_(request), started_(utcNow()) {}

  bool execute() {
    check();
    makeWritableDirectory(request_.out / "references");
    removeEarlierResults(request_.out, suite_);
    writeRecord("running");
    try {
      const bool finished = executeAll();
      writeTables(finished);
      writeRecord(finished ? "finished" : "interrupted");
      return finished;
    } catch (const Error& error) {
      writeRecord(fmt::format("failed: {}", error.what()));
      throw;
    }
  }

 private:
  // Before anything in the folder changes: a wrong suite costs no earlier result.
  void check() {
    std::error_code status;
    const bool isNew = !fs::exists(request_.out, status);
    makeWritableDirectory(request_.out);  // quickly said, unlike what follows
    try {
      check_ = checkSuite(suite_);
    } catch (const Error&) {
      if (isNew) fs::remove(request_.out, status);
      throw;
    }
  }

  bool executeAll() {
    bool finished = true;
    for (const SuiteScene& scene : suite_.scenes) {
      std::string missing;
      if (scene.optional && assetsMissing(scene.request, missing)) {
        skipped_.push_back(fmt::format("skipped {}: {} is not here", scene.name, missing));
        logInfo(skipped_.back());
        continue;
      }
      const PreparedScene prepared = check_.only ? *check_.only : prepareScene(scene.request);
      printWarnings(prepared);
      for (const uint32_t component : suite_.components) {
        finished = finished && executeOne(scene, prepared, component);
      }
      if (!finished) break;
    }
    return finished;
  }

  bool executeOne(const SuiteScene& scene, const PreparedScene& prepared, uint32_t component) {
    BlockResult& block = blocks_.emplace_back();
    block.scene = scene.name;
    block.camera = prepared.cameraName;
    block.component = component;
    sceneResolution(suite_, scene, prepared, block.width, block.height);
    block.startupMs = check_.startupMs[scene.name];
    if (!obtain(scene, prepared, block)) return false;
    bool finished = false;
    std::exception_ptr failure;  // a lost device, say: what was finished before it is kept
    try {
      finished = executeBlock(
          suite_, prepared,
          [&](const BlockResult& of, const RunResult& run) {
            for (const std::string& line : resultLines(suite_, of, run, started_)) {
              appendLine(request_.out / "results.jsonl", line);
            }
          },
          block);
    } catch (const Error&) {
      if (block.methods.empty() || block.methods.back().runs.empty()) throw;
      failure = std::current_exception();
    }
    writeBlockImages(request_.out / "images", suite_, block);
    const std::vector<MethodSummary> rows = summarise(suite_, block);
    std::fputs(blockTable(suite_, rows).c_str(), stdout);
    std::fflush(stdout);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    for (MethodResult& method : block.methods) {
      // Only the numbers are needed from here on.
      method.evenRuns = ImageSum();
      method.oddRuns = ImageSum();
      method.shown = Image();
    }
    block.reference.mean = Image();
    block.reference.variance.reset();
    if (block.reference.half0) block.reference.half0 = block.reference.half1 = Image();
    writeTables(finished);
    if (failure) std::rethrow_exception(failure);
    return finished;
  }

  bool obtain(const SuiteScene& scene, const PreparedScene& prepared, BlockResult& block) {
    if (!scene.reference.empty()) {
      // Of this configuration, as checkSuite() found.
      const fs::path found = findAsset(scene.reference);
      block.reference = readReference(found.empty() ? fs::path(scene.reference) : found);
      block.referenceFile = scene.reference;
      return true;
    }
    const std::string label =
        fmt::format("{}-{}-{}x{}", blockLabel(block), block.camera, block.width, block.height);
    try {
      const SessionConfig picture = pictureOf(suite_, block.width, block.height, block.component);
      block.reference = obtainReference(prepared, referenceConfigOf(picture), suite_.target,
                                        request_.out / "references", label);
    } catch (const Error& error) {
      if (error.code() != ExitCode::interrupted) throw;
      logInfo(error.what());
      blocks_.pop_back();
      return false;
    }
    block.referenceFile = "references/" + safeFileName(label) + ".exr";
    return true;
  }

  void writeTables(bool finished) {
    const std::string csv = summaryCsv(suite_, rows_);
    if (!csv.empty()) writeTextFile(request_.out / "summary.csv", csv);
    std::string text = fmt::format("# {}\n\n", suite_.name);
    if (!suite_.question.empty()) text += suite_.question + "\n\n";
    if (!finished) text += "Not finished: the rows below are of what was.\n\n";
    for (const std::string& line : skipped_) text += line + "\n\n";
    for (const BlockResult& block : blocks_) {
      std::vector<MethodSummary> own;
      for (const MethodSummary& row : rows_) {
        if (row.block == &block) own.push_back(row);
      }
      text += blockTable(suite_, own);
    }
    text += fmt::format(
        "{}, {} cores, Embree {}, {} {}; times are of the passes of a frame by the "
        "steady clock{}, without metrics and files.\n",
        cpuModel(), machineJson()["cores"].dump(), embreeVersion(), buildInfo().compiler,
        buildInfo().buildType, usesVulkan() ? " (vulkan: by the device's timestamps)" : "");
    for (const DeviceUse& use : check_.devices)
      text += fmt::format("\n{}: {}; rays by {}.\n", use.backend, use.device, use.rayTracing);
    writeTextFile(request_.out / "table.md", text);
  }

  bool usesVulkan() const {
    return std::any_of(check_.devices.begin(), check_.devices.end(),
                       [](const DeviceUse& use) { return use.backend == "vulkan"; });
  }

  // What was run, where, from which sources: whoever finds the folder can run it again.
  void writeRecord(const std::string& status) {
    nlohmann::ordered_json devices = nlohmann::ordered_json::array();
    for (const DeviceUse& use : check_.devices) {
      devices.push_back({{"backend", use.backend},
                         {"device", use.device},
                         {"ray_tracing", use.rayTracing},
                         {"validate", use.backend == "vulkan" && suite_.validate}});
    }
    nlohmann::ordered_json record = {{"schema", kResultsSchema},
                                     {"status", status},
                                     {"suite", suite_.name},
                                     {"file", suite_.file},
                                     {"argv", request_.argv},
                                     {"started", started_},
                                     {"written", utcNow()},
                                     {"build", buildJson()},
                                     {"machine", machineJson()},
                                     {"devices", devices},
                                     {"reference_backend", suite_.referenceBackend},
                                     {"skipped", skipped_},
                                     {"peak_resident_mib", peakResidentMiB()}};
    writeTextFile(request_.out / "run.json", record.dump(2) + "\n");
  }

  const Suite& suite_;
  const SuiteRequest& request_;
  std::string started_;
  SuiteCheck check_;
  std::vector<std::string> skipped_;
  std::deque<BlockResult> blocks_;  // rows point into it: addresses must stay
  std::vector<MethodSummary> rows_;
};

}  // namespace

bool runSuite(const Suite& suite, const SuiteRequest& request) {
  return SuiteRun(suite, request).execute();
}

}  // namespace restlab
