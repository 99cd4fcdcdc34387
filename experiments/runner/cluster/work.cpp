#include "experiments/runner/cluster/work.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/cluster/mark.h"
#include "experiments/runner/cluster/planned_reference.h"
#include "experiments/runner/cluster/task_file.h"
#include "experiments/runner/run/block.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/block_masks.h"
#include "experiments/runner/run/block_warnings.h"
#include "experiments/runner/run/image_rows.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/suite_check.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// RAII: folder on this machine's own disk (TMPDIR).
class Scratch {
 public:
  Scratch() {
    std::error_code status;
    const fs::path folder = fs::temp_directory_path(status);
    std::string name = (folder / "restlab-work-XXXXXX").string();
    if (status || !mkdtemp(name.data())) {
      failInput(fmt::format("TMPDIR {}: no folder can be made in it: {}", folder.string(),
                            status ? status.message() : std::strerror(errno)));
    }
    folder_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

[[noreturn]] void failInterrupted(const std::string& what) {
  throw Error(ExitCode::interrupted,
              fmt::format("interrupted: {} is not done; the same command does it anew", what));
}

// Returns the plan's devices, with those of this machine where they are of the same backend: what
// `run` on this machine would put into the keys of jobs.
std::vector<DeviceUse> devicesHere(const Plan& plan, const std::vector<DeviceUse>& own) {
  std::vector<DeviceUse> devices;
  const auto add = [&](const DeviceUse& use) {
    if (std::find(devices.begin(), devices.end(), use) == devices.end()) devices.push_back(use);
  };
  for (const DeviceUse& planned : plan.devices) {
    bool isOwn = false;
    for (const DeviceUse& use : own) {
      if (use.backend != planned.backend) continue;
      add(use);
      isOwn = true;
    }
    if (!isOwn) add(planned);
  }
  for (const DeviceUse& use : own) add(use);
  return devices;
}

bool workReference(const fs::path& folder, const Plan& plan, const Task& task) {
  const PlannedReference& planned = plan.references[task.of];
  const std::vector<Suite> points = openPlan(folder, plan);
  const NeededReference needed = neededOf(points, planned);
  if (referenceKey(needed.scene, needed.config) != planned.key) {
    failInput(fmt::format("{}: the scene of {} is not what it was when this was planned",
                          planFile(folder).string(), planned.label));
  }
  if (!planned.isWhole) {
    const bool isMade =
        renderChunk(needed.scene, needed.config, {task.first, task.end - task.first},
                    resultFile(folder, plan, task), plan.target);
    // Whoever makes the last chunk merges them, or every worker of a table would.
    if (missingChunks(folder, plan, task.of).empty() && !isThere(folder, plan, planned))
      mergedReference(folder, plan, task.of, needed);
    return isMade;
  }
  obtainReference(needed.scene, needed.config, plan.target, folder / "references", needed.label);
  return true;
}

// Says which chunks are missing, before scenes are loaded, and before there is a mark: the task has
// not begun. `waitS`: the references are there, says whoever handed the task over; how long to wait
// until they can be seen here.
void requireReferences(const fs::path& folder, const Plan& plan, const Task& task, double waitS) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (const size_t index : plan.tables[task.of].references) {
    const PlannedReference& planned = plan.references[index];
    const fs::path file = referenceFileOf(folder, planned.label);
    std::error_code status;
    lookAnew(file.parent_path());
    bool isSeen = fs::exists(file, status), isSaid = false;
    while (!isSeen && std::chrono::duration<double>(Clock::now() - start).count() < waitS) {
      if (!std::exchange(isSaid, true))
        logWarning(
            fmt::format("{}: is not to be seen here yet; waits {:g} s", file.string(), waitS));
      throwIfInterrupted("the task has not begun");
      std::this_thread::sleep_for(std::chrono::seconds(1));
      lookAnew(file.parent_path());
      isSeen = fs::exists(file, status);
    }
    if (isSeen && waitS > 0.0) continue;
    const std::vector<uint64_t> missing = missingChunks(folder, plan, index);
    if (missing.empty() || isThere(folder, plan, planned)) continue;
    failInput(fmt::format("{}: {}: {}", folder.string(), plan.describe(task),
                          notThereText(plan, index, missing)));
  }
}

// Makes the runs of a task.
class TableWork {
 public:
  TableWork(const fs::path& folder, const Plan& plan, const Task& task)
      : folder_(folder), plan_(plan), task_(task), started_(utcNow()) {}

  void execute() {
    const BlockPlace& place = plan_.tables[task_.of].block;
    std::vector<Suite> points = openPlan(folder_, plan_);
    // One scene and point alone, which are checked like those of `run`.
    Suite& point = points.at(place.point);
    point.scenes = {point.scenes.at(place.scene)};
    const std::vector<Suite> alone = {point};
    const std::vector<SuiteCheck> checks = checkSuites(alone);
    const SuiteScene& scene = alone.front().scenes.front();
    const Suite suite = ofScene(alone.front(), scene);
    if (!checks.front().only)
      failInput(
          fmt::format("{}: the files of scene {} are not here", folder_.string(), scene.name));
    const PreparedScene& prepared = *checks.front().only;
    printWarnings(prepared);
    BlockResult block = blockOf(suite, scene, prepared, place.component);
    block.startupMs = checks.front().startupMs.at(scene.name);
    takeReferences(
        suite, scene, prepared,
        [&](const NeededReference& needed) { return obtain(suite, needed); }, block);
    requirePlannedFile(block);
    keepReference(block);
    devices_ = devicesHere(plan_, checks.front().devices);
    makeJobs(suite, prepared, block);
  }

 private:
  Reference obtain(const Suite& suite, const NeededReference& needed) const {
    const std::string key = referenceKey(needed.scene, needed.config);
    StoredReference stored = readStored(referenceFileOf(folder_, needed.label), key);
    if (stored.reference && meetsTarget(*stored.reference, suite.target))
      return std::move(*stored.reference);
    for (size_t index = 0; index < plan_.references.size(); ++index) {
      const PlannedReference& planned = plan_.references[index];
      if (planned.key != key) continue;
      if (planned.isWhole) {
        return obtainReference(needed.scene, needed.config, suite.target, folder_ / "references",
                               planned.label);
      }
      std::optional<Reference> merged = mergedReference(folder_, plan_, index, needed);
      if (!merged) {
        failInput(fmt::format("{}: {}", folder_.string(),
                              notThereText(plan_, index, missingChunks(folder_, plan_, index))));
      }
      if (meetsTarget(*merged, suite.target)) return std::move(*merged);
      failInput(
          fmt::format("{0}: reference {1} has {2} spp, which are not enough for its target yet; "
                      "`restlab submit {0}` adds chunks until they are",
                      folder_.string(), planned.label, merged->spp));
    }
    failInput(fmt::format("{}: is not the reference of this scene and these settings; plan again",
                          referenceFileOf(folder_, needed.label).string()));
  }

  // Refuses a file of the suite that is not what it was: errors of one table would be against two.
  void requirePlannedFile(const BlockResult& block) const {
    const std::string& planned = plan_.tables[task_.of].referenceHash;
    if (planned.empty() || referenceHash(block.reference) == planned) return;
    failInput(changedReferenceText(block.referenceFile));
  }

  // Leaves the file that the folder of results names.
  void keepReference(const BlockResult& block) const {
    std::error_code status;
    const fs::path file = folder_ / block.referenceFile;  // absolute for a file of the suite
    if (!fs::exists(file, status)) writeReference(file, block.reference);
  }

  void makeJobs(const Suite& suite, const PreparedScene& prepared, BlockResult& block) {
    std::string reference = referenceHash(block.reference);
    if (block.referenceBefore) reference += referenceHash(*block.referenceBefore);
    nlohmann::ordered_json jobs = nlohmann::ordered_json::array(), images = jobs;
    const JobStore store(scratch_.folder());
    if (task_.first == 0 && imageRuns(suite) > 0) {
      prepareMasks(suite, prepared, block);
      for (uint32_t run = 0; run < imageRuns(suite); ++run) {
        const ImageJob job = measureImages(suite, block, run, reference, started_);
        store.save(job.identity, job.data);
        images.push_back(job.identity.key());
      }
    }
    {
      BlockExecutor executor(suite, prepared, block);
      Progress progress(blockLabel(suite, block), task_.end - task_.first);
      for (uint64_t run = task_.first; run < task_.end; ++run) {
        const JobIdentity identity =
            jobIdentity(suite, prepared, block, uint32_t(run), buildInfo(), reference, devices_);
        const std::optional<JobData> job =
            executor.execute(uint32_t(run), identity.key(), started_);
        if (!job) failInterrupted(plan_.describe(task_));
        store.save(identity, *job);
        jobs.push_back(identity.key());
        progress.update(run + 1 - task_.first);
      }
      progress.finish();
    }
    nlohmann::ordered_json uses = nlohmann::ordered_json::array();
    for (const DeviceUse& use : devices_) uses.push_back({use.backend, use.device, use.rayTracing});
    packTask(resultFile(folder_, plan_, task_),
             {{"plan", plan_.id},
              {"task", task_.index},
              {"node", nodeName()},
              {"started", started_},
              {"written", utcNow()},
              {"devices", uses},
              {"scene", block.scene},
              {"camera", block.camera},
              {"component", componentName(block.component)},
              {"point", suite.point},
              {"width", block.width},
              {"height", block.height},
              {"reference", block.referenceFile},
              {"reference_hash", reference},
              {"warnings", warningsOf(suite, prepared, block)},
              {"jobs", jobs},
              {"images", images}},
             scratch_.folder() / "jobs");
  }

  const fs::path& folder_;
  const Plan& plan_;
  const Task& task_;
  std::string started_;
  Scratch scratch_;
  std::vector<DeviceUse> devices_;
};

}  // namespace

bool workTask(const fs::path& folder, const Plan& plan, uint64_t index, double waitS) {
  const Task task = plan.task(index);
  const fs::path result = resultFile(folder, plan, task);
  lookAnew(result.parent_path());
  std::error_code status;
  if (fs::exists(result, status)) {
    // Files of chunks are checked by renderChunk().
    const std::string why = task.isReference ? "" : whyDamaged(result);
    if (!task.isReference && why.empty()) return false;
    if (!why.empty()) logInfo(fmt::format("{}; done anew", why));
  }
  if (!fs::is_directory(folder / "at-work", status))
    failInput(fmt::format("{}: is not there (has the shared folder gone?)",
                          (folder / "at-work").string()));
  if (!task.isReference) requireReferences(folder, plan, task, waitS);
  TaskMark mark(folder, index);
  bool isMade = true;
  try {
    if (task.isReference) {
      isMade = workReference(folder, plan, task);
    } else {
      TableWork(folder, plan, task).execute();
    }
  } catch (const Error& error) {
    // After a signal, and where memory does not suffice, the mark stays without a line, as if the
    // process had been killed: the task may be tried again with more.
    const bool isLikeKilled =
        error.code() == ExitCode::interrupted || error.code() == ExitCode::deviceUnavailable;
    if (!isLikeKilled) mark.failed(error.what());
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    mark.failed(error.what());
    throw;
  }
  mark.done();
  return isMade;
}

}  // namespace restlab
