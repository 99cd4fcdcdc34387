#include "experiments/runner/cluster/submit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/cluster/tasks_there.h"
#include "experiments/runner/cluster/work.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr int kMostAttempts = 2;
constexpr double kAgain = 2.0;  // times the memory and the time

// Time and memory of the job that goes on: it merges references, and makes tables.
constexpr Asked kGoOn = {3600.0, 0.0};

std::string askedText(const Asked& asked) {
  if (asked.memoryMiB == 0.0 && asked.seconds == 0.0) return "nothing";
  return fmt::format("{:.0f} MiB and {:.0f} min", asked.memoryMiB, asked.seconds / 60.0);
}

class Submitter {
 public:
  Submitter(const SubmitRequest& request, Plan plan)
      : request_(request), folder_(request.folder), plan_(std::move(plan)) {
    submissions_ = readSubmissions(folder_);
    if (request_.goesOn) {
      round_ = submissions_.round();
      options_ = submissions_.options;
    } else {
      round_ = submissions_.round() + 1;
      options_ = request_.options.empty() ? submissions_.options : request_.options;
    }
    if (request_.engine == "slurm") {
      engine_ = makeSlurm(folder_, plan_, options_);
      if (!request_.goesOn) requireEmptyQueue();
    } else {
      engine_ = makeLocal(folder_, request_.processes);
    }
    submissions_.engine = request_.engine;
    submissions_.options = options_;
  }

  std::optional<Collected> submit() {
    while (true) {
      finishReferences();
      const std::vector<std::string> jobs = launchMissing();
      if (jobs.empty() && !isLaunched_) break;
      if (engine_->hasJobs()) {
        Submission next{engine_->goOn(askedToGoOn(), jobs), {}, askedToGoOn(), round_, utcNow()};
        print("{} goes on when they have ended\n", next.id);
        keep(std::move(next));
        return std::nullopt;
      }
    }
    return collectResults(folder_, plan_, folder_);
  }

 private:
  void requireEmptyQueue() const {
    const auto queue = slurmQueue(folder_, plan_);
    if (!queue)
      failInput("submit: squeue does not answer, so nobody knows what is in the queue already");
    if (queue->empty()) return;
    failUsage(
        fmt::format("submit {0}: {1} of this plan are in the queue already, job {2} first; "
                    "`restlab status {0}` "
                    "shows them",
                    folder_.string(), counted(queue->size(), "job"), queue->front().id));
  }

  // Memory for a merge of the largest reference.
  Asked askedToGoOn() const {
    Asked asked = kGoOn;
    if (plan_.residentMiB == 0.0) return {};
    for (const PlannedReference& reference : plan_.references) {
      const double own = double(reference.pixels) * double(referenceBytesPerPixel(plan_.target));
      asked.memoryMiB = std::max(asked.memoryMiB, own / kMiB);
    }
    asked.memoryMiB += 1024.0 + plan_.residentMiB;
    return asked;
  }

  // Merges references with all their chunks, and adds chunks to those that are not good enough.
  void finishReferences() {
    bool isChanged = false;
    std::vector<Suite> points;
    for (size_t r = 0; r < plan_.references.size(); ++r) {
      const PlannedReference& planned = plan_.references[r];
      if (planned.isWhole || !missingChunks(folder_, plan_, r).empty()) continue;
      if (isThere(folder_, plan_, planned)) continue;
      if (points.empty()) points = openPlan(folder_, plan_);
      const Reference merged = plannedReference(folder_, plan_, planned, neededOf(points, planned));
      if (meetsTarget(merged, plan_.target)) continue;
      TaskGroup more = lastChunks(r);
      more.first = more.end;
      more.end = sppExpected(merged, plan_.target);
      if (more.end <= more.first) continue;
      more.each = sppOfChunk(more.end - more.first, 0);
      logInfo(fmt::format(
          "reference {}: {} spp are not enough for a relmse of {:g} (since half of them: {:.3g}); "
          "{} more",
          planned.label, merged.spp, plan_.target.relmse, merged.relmseSinceHalf,
          counted(more.tasks(), "chunk")));
      plan_.groups.push_back(more);
      isChanged = true;
    }
    if (isChanged) writePlan(folder_, plan_);
  }

  TaskGroup lastChunks(size_t reference) const {
    TaskGroup last;
    for (const TaskGroup& group : plan_.groups)
      if (group.isReference && group.of == reference) last = group;
    return last;
  }

  // Hands over what is missing and may be tried. Returns the ids of jobs.
  std::vector<std::string> launchMissing() {
    isLaunched_ = false;
    const TasksThere there = tasksThere(folder_, plan_);
    // By what they ask for: as estimated, or more.
    std::map<double, std::vector<uint64_t>> chunks, runs;
    for (const uint64_t index : there.missing()) {
      const Task task = plan_.task(index);
      const std::optional<double> times = timesToAsk(task, there);
      if (times) (task.isReference ? chunks : runs)[*times].push_back(index);
    }
    std::vector<std::string> ids;
    for (const auto& [times, tasks] : chunks) launch(tasks, times, {}, ids);
    // Where the error decides, nobody knows yet which chunks there will be.
    if (!chunks.empty() && plan_.target.relmse > 0.0) return ids;
    const std::vector<std::string> after = ids;
    for (const auto& [times, tasks] : runs) launch(tasks, times, after, ids);
    return ids;
  }

  void launch(const std::vector<uint64_t>& indices, double times,
              const std::vector<std::string>& after, std::vector<std::string>& ids) {
    std::vector<Task> tasks;
    for (const uint64_t index : indices) tasks.push_back(plan_.task(index));
    const Asked asked = askedFor(plan_, tasks, times);
    isLaunched_ = true;
    if (!engine_->hasJobs()) keep({"", indices, asked, round_, utcNow()});
    const std::vector<std::string> own = engine_->launch(indices, asked, after);
    if (own.empty()) return;
    const std::string names = fmt::format("{}", fmt::join(own, " "));
    printText(fmt::format("{}: {}, tasks {}, each with {} asked for\n", names,
                          tasks.front().isReference ? "references" : "runs", rangesText(indices),
                          askedText(asked)));
    keep({names, indices, asked, round_, utcNow()});
    ids.insert(ids.end(), own.begin(), own.end());
  }

  // Returns the factor on what the task asks for; nothing if it is not to be tried again.
  std::optional<double> timesToAsk(const Task& task, const TasksThere& there) const {
    const int attempts = submissions_.round() == round_ ? submissions_.attempts(task.index) : 0;
    if (attempts == 0) return 1.0;
    const auto mark = there.marks.find(task.index);
    // Without a mark it never began: its references failed, or its node did.
    if (mark == there.marks.end())
      return attempts < kMostAttempts ? std::optional<double>(1.0) : std::nullopt;
    if (!mark->second.error.empty()) return std::nullopt;
    const Submission* last = submissions_.last(task.index);
    const std::string end = mark->second.job.empty() ? "" : engine_->endOf(mark->second.job);
    const bool isAgain = attempts < kMostAttempts;
    const Asked again = askedFor(plan_, {task}, kAgain);
    const bool isAsked = last->asked.memoryMiB > 0.0 || last->asked.seconds > 0.0;
    logWarning(fmt::format("task {} ({}) ended without a result on {}{}, with {} asked for; {}",
                           task.index, plan_.describe(task), mark->second.node,
                           end.empty() ? "" : ": " + end, askedText(last->asked),
                           !isAgain  ? "it is not tried again"
                           : isAsked ? fmt::format("it is tried again with {}", askedText(again))
                                     : "it is tried again"));
    return isAgain ? std::optional<double>(kAgain) : std::nullopt;
  }

  void keep(Submission one) {
    submissions_.all.push_back(std::move(one));
    writeSubmissions(folder_, submissions_);
  }

  const SubmitRequest& request_;
  const fs::path& folder_;
  Plan plan_;
  Submissions submissions_;
  std::string options_;
  uint64_t round_ = 0;
  std::unique_ptr<Engine> engine_;
  bool isLaunched_ = false;
};

}  // namespace

std::optional<Collected> submitPlan(const SubmitRequest& request, Plan plan) {
  return Submitter(request, std::move(plan)).submit();
}

}  // namespace restlab
