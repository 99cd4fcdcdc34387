#include "experiments/runner/results/suite_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <deque>
#include <exception>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "core/base/control_characters.h"
#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/pace.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/results/clean.h"
#include "experiments/runner/results/folder_lock.h"
#include "experiments/runner/results/outputs.h"
#include "experiments/runner/results/results_log.h"
#include "experiments/runner/results/run_cost.h"
#include "experiments/runner/run/block.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/block_masks.h"
#include "experiments/runner/run/block_warnings.h"
#include "experiments/runner/run/image_rows.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/run_record.h"
#include "experiments/runner/run/suite_check.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Returns the busy share of all cores over a quarter of a second; 0 if unknown. The load average
// would still include a build that has just ended.
double busyShare() {
  const auto times = [] {
    std::ifstream stat("/proc/stat");
    std::string word;
    stat >> word;
    std::array<double, 2> idleAndAll{};
    for (int i = 0; i < 8; ++i) {  // user nice system idle iowait irq softirq steal
      double ticks = 0.0;
      stat >> ticks;
      if (i == 3 || i == 4) idleAndAll[0] += ticks;
      idleAndAll[1] += ticks;
    }
    return idleAndAll;
  };
  const auto before = times();
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  const auto after = times();
  const double all = after[1] - before[1];
  return all > 0.0 ? 1.0 - (after[0] - before[0]) / all : 0.0;
}

// Removes outputs of an earlier run, which would be mistaken for this one's if this run ends early.
// results.jsonl stays: each of its lines names its run. Files that the suite itself reads stay.
void removeEarlierResults(const fs::path& out, const Suite& suite) {
  std::error_code status;
  std::vector<fs::path> old = {out / "summary.csv", out / "table.md", out / "table.tex",
                               out / "report.html"};
  for (const fs::directory_entry& entry : fs::directory_iterator(out / "images", status)) {
    const fs::path extension = entry.path().extension();
    const bool isImage = extension == ".exr" || extension == ".png";
    if (isImage && !readsFile(suite, entry.path())) old.push_back(entry.path());
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(out / "plots", status)) {
    if (entry.path().extension() == ".svg") old.push_back(entry.path());
  }
  for (const fs::path& file : old) {
    if (!fs::is_directory(file, status)) fs::remove(file, status);
    if (fs::is_regular_file(file, status)) {
      failInput(fmt::format("{}: is of an earlier run and cannot be removed", file.string()));
    }
  }
}

// Returns a block's entry in the plan of run.json, without the keys of its jobs.
nlohmann::ordered_json planOf(const Suite& suite, const BlockResult& block) {
  return {{"point", suite.point},
          {"scene", block.scene},
          {"camera", block.camera},
          {"component", componentName(block.component)},
          {"width", block.width},
          {"height", block.height},
          {"reference", block.referenceFile},
          {"jobs", nlohmann::ordered_json::array()},
          {"images", nlohmann::ordered_json::array()},
          {"warnings", nlohmann::ordered_json::array()}};
}

class SuiteRun {
 public:
  SuiteRun(const std::vector<Suite>& points, const SuiteRequest& request)
      : points_(points),
        request_(request),
        started_(utcNow()),
        outputs_(request.out),
        store_(request.out) {}

  bool execute() {
    check();
    lock_.emplace(request_.out);
    makeWritableDirectory(request_.out / "references");
    log_.emplace(request_.out / "results.jsonl");
    removeEarlierResults(request_.out, points_.front());
    writeTextFile(request_.out / "suite.toml", points_.front().resolved);
    outputs_.use(devices_);
    makePlan();
    writeRecord("running");
    try {
      const bool finished = executeAll();
      outputs_.write(points_.front(), record_, finished);
      if (finished) printText(outputs_.sweepTables());
      writeRecord(finished ? "finished" : "interrupted");
      outputs_.writePages(points_.front(), record_);
      logEvent({{"event", finished ? "finished" : "interrupted"},
                {"folder", request_.out.string()},
                {"made", made_},
                {"were_there", reused_}});
      if (reused_ > 0)
        logInfo(fmt::format("{} of {} runs were there already", reused_, reused_ + made_));
      if (!finished) return false;
    } catch (const Error& error) {
      writeRecord(fmt::format("failed: {}", error.what()));
      throw;
    }
    const Suite& suite = points_.front();
    const std::string nonfinite = suite.failOnNonfinite ? outputs_.nonfinite() : "",
                      energies = suite.failOnEnergy ? outputs_.wrongEnergies() : "";
    const char* join = nonfinite.empty() || energies.empty() ? "" : "; ";
    if (!nonfinite.empty() || !energies.empty())
      throw Error(ExitCode::comparisonFailed, nonfinite + join + energies);
    return true;
  }

 private:
  // Checks before the folder changes: a wrong suite must not delete earlier results.
  void check() {
    std::error_code status;
    const bool isNew = !fs::exists(request_.out, status);
    makeWritableDirectory(request_.out);  // fails fast, before the slow checks
    try {
      checks_ = checkSuites(points_);
      for (const SuiteCheck& found : checks_) {
        for (const DeviceUse& use : found.devices) {
          if (std::find(devices_.begin(), devices_.end(), use) == devices_.end())
            devices_.push_back(use);
        }
      }
    } catch (const Error&) {
      if (isNew) fs::remove(request_.out, status);
      throw;
    }
  }

  // Lists every block in the order of executeAll(); only names are known yet.
  void makePlan() {
    std::string missing;
    for (size_t s = 0; s < points_.front().scenes.size(); ++s) {
      const SuiteScene& scene = points_.front().scenes[s];
      if (scene.optional && assetsMissing(scene.request, missing)) continue;
      for (const Suite& suite : points_) {
        for (const uint32_t component : suite.components) {
          BlockResult block;
          block.scene = scene.name;
          block.component = component;
          plan_.push_back(planOf(suite, block));
          const Suite own = ofScene(suite, scene);
          pace_.plan(own.runs, costOfRun(own, scene));
        }
      }
    }
  }

  bool executeAll() {
    // All points have the same scenes.
    for (size_t s = 0; s < points_.front().scenes.size(); ++s) {
      const SuiteScene& scene = points_.front().scenes[s];
      std::string missing;
      if (scene.optional && assetsMissing(scene.request, missing)) {
        const std::string line = fmt::format("skipped {}: {} is not here", scene.name, missing);
        skipped_.push_back(line);
        outputs_.note(line);
        logInfo(line);
        continue;
      }
      const SuiteCheck& first = checks_.front();
      const PreparedScene prepared = first.only ? *first.only : prepareScene(scene.request);
      printWarnings(prepared);
      for (size_t p = 0; p < points_.size(); ++p) {
        for (const uint32_t component : points_[p].components) {
          if (!executeBlock(p, points_[p].scenes[s], prepared, component)) return false;
        }
      }
    }
    return true;
  }

  bool executeBlock(size_t point, const SuiteScene& scene, const PreparedScene& prepared,
                    uint32_t component) {
    // Keep the suite until the end: the block's rows point to it.
    const Suite& suite = ofScenes_.emplace_back(ofScene(points_[point], scene));
    BlockResult block = blockOf(suite, scene, prepared, component);
    block.startupMs = checks_[point].startupMs[scene.name];
    if (!obtain(suite, scene, prepared, block)) return false;
    nlohmann::ordered_json& plan = plan_.at(next_++);
    plan = planOf(suite, block);
    for (const std::string& line : warningsOf(suite, prepared, block)) {
      logWarning(line);
      outputs_.note("Warning: " + line);
      plan["warnings"].push_back(line);
    }
    bool finished = false;
    std::exception_ptr failure;  // rethrown after finished runs are written, e.g. a lost device
    try {
      finished = executeRuns(suite, scene, prepared, block, plan);
    } catch (const Error&) {
      if (block.methods.empty()) throw;
      failure = std::current_exception();
    }
    if (!block.methods.empty()) {
      printText(outputs_.add(suite, std::move(block)));
      std::fflush(stdout);
    }
    outputs_.write(points_.front(), record_, false);
    if (failure) std::rethrow_exception(failure);
    return finished;
  }

  bool executeRuns(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                   BlockResult& block, nlohmann::ordered_json& plan) {
    std::string reference = referenceHash(block.reference);
    if (block.referenceBefore) reference += referenceHash(*block.referenceBefore);
    BlockExecutor executor(suite, prepared, block);
    measureImageRows(suite, prepared, block, reference, plan);
    Progress progress(blockLabel(suite, block), suite.runs);
    const double cost = costOfRun(suite, scene);
    const std::set<std::string> made =
        makeSideBySide(suite, prepared, block, reference, progress, cost);
    for (uint32_t run = 0; run < suite.runs; ++run) {
      const JobIdentity identity = identityOf(suite, prepared, block, run, reference);
      const std::string key = identity.key();
      std::optional<JobData> job;
      if (!request_.force || made.count(key) != 0) job = store_.load(key);
      const bool isReused = job.has_value() && made.count(key) == 0;
      if (!job) {
        Stopwatch watch;
        job = executor.execute(run, key, started_);
        if (!job) return false;
        store_.save(identity, *job);
        pace_.made(watch.lap(), cost);
      } else if (isReused && suite.jobs < 2) {
        pace_.found(cost);
      }
      ++(isReused ? reused_ : made_);
      log_->add(key, *job, !isReused);
      addJob(suite, *job, block);
      plan["jobs"].push_back(key);
      if (made.count(key) == 0) logRun(suite, block, run, key, isReused);
      writeRecord("running");
      // With several jobs, makeSideBySide() has reported the progress already.
      if (suite.jobs < 2) progress.update(run + 1, "", pace_.progress());
    }
    progress.finish();
    sayWhatIsLeft(suite, prepared, block, reference);
    return true;
  }

  // Logs further runs of an earlier, longer `run`, which the tables leave out.
  void sayWhatIsLeft(const Suite& suite, const PreparedScene& prepared, const BlockResult& block,
                     const std::string& reference) const {
    uint32_t runs = suite.runs;
    while (store_.record(identityOf(suite, prepared, block, runs, reference).key())) ++runs;
    if (runs == suite.runs) return;
    const bool isOwn = std::any_of(
        suite.scenes.begin(), suite.scenes.end(),
        [&](const SuiteScene& scene) { return scene.name == block.scene && scene.runs; });
    const std::string how = isOwn ? fmt::format("runs = {} in its [[scene]]", runs)
                                  : fmt::format("--set runs={}", runs);
    logInfo(fmt::format("{}: not taken, though there: {} of further runs; {} takes them",
                        blockLabel(suite, block), runs - suite.runs, how));
  }

  static void logRun(const Suite& suite, const BlockResult& block, uint32_t run,
                     const std::string& key, bool wasThere) {
    logEvent({{"event", "run"},
              {"table", blockLabel(suite, block)},
              {"run", run},
              {"job", key},
              {"was_there", wasThere}});
  }

  JobIdentity identityOf(const Suite& suite, const PreparedScene& prepared,
                         const BlockResult& block, uint32_t run,
                         const std::string& reference) const {
    return jobIdentity(suite, prepared, block, run, buildInfo(), reference, devices_);
  }

  // Renders missing runs in parallel if the suite asks for it. Returns the keys of finished ones,
  // which are in the store.
  std::set<std::string> makeSideBySide(const Suite& suite, const PreparedScene& prepared,
                                       BlockResult& block, const std::string& reference,
                                       Progress& progress, double cost) {
    std::set<std::string> made;
    if (suite.jobs < 2) return made;
    prepareMasks(suite, prepared, block);  // once, not in each thread
    std::vector<uint32_t> missing;
    for (uint32_t run = 0; run < suite.runs; ++run) {
      const std::string key = identityOf(suite, prepared, block, run, reference).key();
      if (request_.force || !store_.load(key)) {
        missing.push_back(run);
      } else {
        pace_.found(cost);
      }
    }
    std::mutex mutex;  // guards made, failure, progress, pace_ and watch
    Stopwatch watch;
    std::exception_ptr failure;
    std::atomic<size_t> next = 0;
    const auto work = [&] {
      try {
        BlockExecutor executor(suite, prepared, block);
        for (size_t i = next++; i < missing.size(); i = next++) {
          const JobIdentity identity = identityOf(suite, prepared, block, missing[i], reference);
          const std::optional<JobData> job = executor.execute(missing[i], identity.key(), started_);
          if (!job) return;
          store_.save(identity, *job);
          const std::lock_guard lock(mutex);
          made.insert(identity.key());
          pace_.made(watch.lap(), cost);
          logRun(suite, block, missing[i], identity.key(), false);
          progress.update(suite.runs - missing.size() + made.size(), "", pace_.progress());
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = missing.size();
      }
    };
    {
      std::vector<std::jthread> workers;
      for (size_t i = 0; i < std::min<size_t>(suite.jobs, missing.size()); ++i)
        workers.emplace_back(work);
    }
    if (failure) std::rethrow_exception(failure);
    return made;
  }

  // Always measured anew, because this is fast.
  void measureImageRows(const Suite& suite, const PreparedScene& prepared, BlockResult& block,
                        const std::string& reference, nlohmann::ordered_json& plan) {
    if (imageRuns(suite) > 0) prepareMasks(suite, prepared, block);
    for (uint32_t run = 0; run < imageRuns(suite); ++run) {
      const ImageJob job = measureImages(suite, block, run, reference, started_);
      const std::string key = job.identity.key();
      store_.save(job.identity, job.data);
      log_->add(key, job.data);
      addJob(suite, job.data, block);
      plan["images"].push_back(key);
    }
  }

  // Returns false after an interrupt.
  bool obtain(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
              BlockResult& block) {
    const fs::path folder = request_.out / "references";
    try {
      takeReferences(
          suite, scene, prepared,
          [&](const NeededReference& needed) {
            return obtainReference(needed.scene, needed.config, suite.target, folder, needed.label);
          },
          block);
    } catch (const Error& error) {
      if (error.code() != ExitCode::interrupted) throw;
      logInfo(error.what());
      return false;
    }
    if (scene.reference.empty() && scene.truth != Truth::rendered)
      writeReference(request_.out / block.referenceFile, block.reference);
    return true;
  }

  // Lists the methods that --methods has left.
  std::vector<std::string> methodNames() const {
    std::vector<std::string> names;
    for (const SuiteMethod& method : points_.front().methods) names.push_back(method.name);
    return names;
  }

  // Writes run.json: all that is needed to run this again (arguments, devices, sources).
  void writeRecord(const std::string& status) {
    nlohmann::ordered_json devices = nlohmann::ordered_json::array();
    for (const DeviceUse& use : devices_) {
      devices.push_back({{"backend", use.backend},
                         {"device", use.device},
                         {"ray_tracing", use.rayTracing},
                         {"validate", use.backend == "vulkan" && points_.front().validate}});
    }
    record_ = {{"schema", kResultsSchema},
               {"status", status},
               {"suite", points_.front().name},
               {"file", points_.front().file},
               {"argv", request_.argv},
               {"methods", methodNames()},
               {"started", started_},
               {"busy_at_start", busyAtStart_},
               {"written", utcNow()},
               {"build", buildJson()},
               {"machine", machineJson()},
               {"devices", devices},
               {"reference_backend", points_.front().referenceBackend},
               {"skipped", skipped_},
               {"plan", plan_},
               {"peak_resident_mib", peakResidentMiB()}};
    writeTextFile(request_.out / "run.json", jsonWithoutControls(record_.dump(2)) + "\n");
  }

  const std::vector<Suite>& points_;
  const SuiteRequest& request_;
  std::string started_;
  double busyAtStart_ = busyShare();  // by other programs
  Outputs outputs_;
  JobStore store_;
  std::optional<FolderLock> lock_;
  std::optional<ResultsLog> log_;
  std::vector<SuiteCheck> checks_;  // by point
  std::vector<DeviceUse> devices_;
  std::vector<std::string> skipped_;
  std::vector<nlohmann::ordered_json> plan_;
  nlohmann::ordered_json record_;  // contents of run.json
  Pace pace_;
  std::deque<Suite> ofScenes_;  // addresses must stay
  size_t next_ = 0;             // block in the plan
  size_t made_ = 0, reused_ = 0;
};

}  // namespace

bool runSuite(const std::vector<Suite>& points, const SuiteRequest& request) {
  return SuiteRun(points, request).execute();
}

}  // namespace restlab
