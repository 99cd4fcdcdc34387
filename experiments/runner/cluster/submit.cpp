#include "experiments/runner/cluster/submit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "core/base/error.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/cluster/engine.h"
#include "experiments/runner/cluster/planned_reference.h"
#include "experiments/runner/cluster/sbatch_options.h"
#include "experiments/runner/cluster/tasks_there.h"
#include "experiments/runner/reference/reference_chunk.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr int kMostAttempts = 2;
constexpr double kAgain = 2.0;  // times the memory and the time

// Time of the job that goes on, which merges references and makes tables, in a small plan.
constexpr double kGoOnS = 3600.0;

// Bytes a second that it reads at least, from a file system that others use, and a task's share of
// tables and report.
constexpr double kBytesPerS = 50e6, kTaskS = 0.1;

std::string askedText(const Asked& asked) {
  std::vector<std::string> parts;
  if (asked.memoryMiB > 0.0) parts.push_back(fmt::format("{:.0f} MiB", asked.memoryMiB));
  if (asked.seconds > 0.0) parts.push_back(fmt::format("{:.0f} min", asked.seconds / 60.0));
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, " and "));
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
    const bool isSlurm = request_.engine == "slurm";
    engine_ =
        isSlurm ? makeSlurm(folder_, plan_, options_) : makeLocal(folder_, request_.processes);
    if (!request_.goesOn && (isSlurm || submissions_.engine == "slurm")) requireEmptyQueue(isSlurm);
    submissions_.engine = request_.engine;
    submissions_.options = options_;
  }

  Submitted submit() {
    if (request_.goesOn && goesOnLater()) return std::move(submitted_);
    for (bool isAgain = false; !submitted_.collected; isAgain = true) {
      do {
        finishReferences();
        launchMissing();
        if (!submitted_.jobs.empty()) {
          goOnAfter(idsOf(submitted_.jobs));
          return std::move(submitted_);
        }
        // Tasks refused now may be taken later, but tables are made of what there is.
        if (submitted_.refusal && !request_.goesOn) return std::move(submitted_);
      } while (isLaunched_);
      Collected collected = collectResults(folder_, plan_, folder_);
      // Results that turned out to be damaged are made anew, once.
      if (collected.setAside == 0 || isAgain) submitted_.collected = std::move(collected);
    }
    submissions_.collected = submissions_.round();
    writeSubmissions(folder_, submissions_);
    return std::move(submitted_);
  }

 private:
  static std::vector<std::string> idsOf(const std::vector<Submission>& jobs) {
    std::vector<std::string> ids;
    for (const Submission& job : jobs) ids.push_back(job.id);
    return ids;
  }

  void requireEmptyQueue(bool mustAnswer) const {
    const auto queue = slurmQueue(folder_, plan_);
    if (!queue && mustAnswer)
      failInput("submit: squeue does not answer, so nobody knows what is in the queue already");
    if (!queue || queue->empty()) return;
    failUsage(
        fmt::format("submit {0}: {1} of this plan are in the queue already, job {2} first; "
                    "`restlab status {0}` "
                    "shows them",
                    folder_.string(), counted(queue->size(), "job"), queue->front().id));
  }

  // Returns whether jobs of the plan are in the queue beside this one, after which another one goes
  // on: this one was requeued after it had handed them over.
  bool goesOnLater() {
    const char* own = std::getenv("SLURM_JOB_ID");
    const auto queue = own ? slurmQueue(folder_, plan_) : std::nullopt;
    std::set<std::string> ids;
    for (const QueuedJob& job : queue.value_or(std::vector<QueuedJob>()))
      if (job.state != "COMPLETING") ids.insert(job.id.substr(0, job.id.find('_')));
    if (own) ids.erase(own);
    if (ids.empty()) return false;
    const Submission* last = submissions_.all.empty() ? nullptr : &submissions_.all.back();
    if (last == nullptr || !last->tasks.empty() || ids.count(last->id) == 0)
      goOnAfter({ids.begin(), ids.end()});
    return true;
  }

  // Hands over the job that goes on after `ids`. Where that or a part of the tasks was refused,
  // this is said with what is in the queue.
  void goOnAfter(const std::vector<std::string>& ids) {
    const std::string there =
        fmt::format("{}, {} first, {} in the queue", counted(ids.size(), "job"), ids.front(),
                    ids.size() == 1 ? "is" : "are");
    std::optional<Error>& refusal = submitted_.refusal;
    const Asked asked = askedToGoOn();
    std::string id;
    try {
      id = engine_->goOn(asked, ids);
    } catch (const Error& error) {
      refusal =
          Error(error.code(),
                fmt::format("{}; {}: when they have ended, `restlab submit {} --engine slurm` "
                            "goes on",
                            refusal ? refusal->what() : error.what(), there, folder_.string()));
      return;
    }
    keepJob({id, {}, asked, round_, utcNow()});
    if (request_.prints) print("{} goes on when they have ended\n", id);
    if (!refusal) return;
    refusal = Error(refusal->code(),
                    fmt::format("{}; {}, and job {} goes on with the rest when they have ended",
                                refusal->what(), there, id));
  }

  // Memory for a merge of the largest reference, and time to read all chunks and jobs.
  Asked askedToGoOn() const {
    double bytes = 0.0, mebibytes = 0.0;
    for (const TaskGroup& group : plan_.groups()) {
      if (!group.isReference) continue;
      bytes += double(plan_.references[group.of].pixels) *
               double(chunkFileBytesPerPixel(group.end - group.first));
    }
    for (const PlannedReference& reference : plan_.references) {
      const double own = double(reference.pixels) * double(referenceBytesPerPixel(plan_.target));
      mebibytes = std::max(mebibytes, own / kMiB);
    }
    const Asked asked = {kGoOnS + bytes / kBytesPerS + double(plan_.tasks()) * kTaskS,
                         mebibytes + 1024.0 + plan_.residentMiB};
    // Nothing is asked for where nothing was measured, but by the user's words. They are for tasks:
    // this job may need more.
    const Asked own = ofUser(plan_.residentMiB > 0.0 ? asked : Asked(), 1.0);
    return {own.seconds > 0.0 ? std::max(own.seconds, asked.seconds) : 0.0,
            own.memoryMiB > 0.0 ? std::max(own.memoryMiB, asked.memoryMiB) : 0.0};
  }

  Asked ofUser(const Asked& asked, double times) const {
    return engine_->hasJobs() ? withOptions(asked, options_, times) : asked;
  }

  // Merges references with all their chunks, and adds chunks to those that are not good enough.
  void finishReferences() {
    bool isChanged = false;
    std::vector<Suite> points;
    isReady_.assign(plan_.references.size(), false);
    for (size_t r = 0; r < plan_.references.size(); ++r) {
      const PlannedReference& planned = plan_.references[r];
      isReady_[r] = isThere(folder_, plan_, planned);
      if (isReady_[r] || planned.isWhole || !missingChunks(folder_, plan_, r).empty()) continue;
      if (points.empty()) points = openPlan(folder_, plan_);
      const std::optional<Reference> merged =
          mergedReference(folder_, plan_, r, neededOf(points, planned));
      if (!merged) continue;
      isReady_[r] = meetsTarget(*merged, plan_.target);
      if (!isReady_[r] && addChunks(r, *merged)) isChanged = true;
    }
    if (isChanged) writePlan(folder_, plan_);
  }

  // Returns whether there was a chunk to add.
  bool addChunks(size_t reference, const Reference& merged) {
    TaskGroup more = lastChunks(reference);
    more.first = more.end;
    more.end = sppExpected(merged, plan_.target);
    if (more.end <= more.first) return false;
    more.each = sppOfChunk(more.end - more.first, plan_.sppOfChunk);
    logInfo(fmt::format(
        "reference {}: {} spp are not enough for a relmse of {:g} (since half of them: {:.3g}); "
        "{} more",
        plan_.references[reference].label, merged.spp, plan_.target.relmse, merged.relmseSinceHalf,
        counted(more.tasks(), "chunk")));
    plan_.add(more);
    return true;
  }

  TaskGroup lastChunks(size_t reference) const {
    TaskGroup last;
    for (const TaskGroup& group : plan_.groups())
      if (group.isReference && group.of == reference) last = group;
    return last;
  }

  // Hands over what is missing and may be tried: runs once their references are merged.
  void launchMissing() {
    isLaunched_ = false;
    const TasksThere there = tasksThere(folder_, plan_);
    std::vector<Task> missing;
    for (const uint64_t index : there.missing()) {
      const Task task = plan_.task(index);
      if (task.isReference || hasReferences(task)) missing.push_back(task);
    }
    const std::map<std::string, std::string> ends = endsOfLost(missing, there);
    // By what they ask for: as estimated, or more.
    std::map<double, std::vector<uint64_t>> chunks, runs;
    for (const Task& task : missing) {
      const std::optional<double> times = timesToAsk(task, there, ends);
      if (times) (task.isReference ? chunks : runs)[*times].push_back(task.index);
    }
    for (const auto* kind : {&chunks, &runs})
      for (const auto& [times, tasks] : *kind) launch(tasks, times);
  }

  bool hasReferences(const Task& task) const {
    const std::vector<size_t>& needed = plan_.tables[task.of].references;
    return std::all_of(needed.begin(), needed.end(), [&](size_t r) { return isReady_[r]; });
  }

  Asked askedOf(const std::vector<Task>& tasks, double times) const {
    return ofUser(askedFor(plan_, tasks, times), times);
  }

  // Each id is kept before the next is asked for. What the scheduler refuses, as it asks for too
  // much, keeps nothing else back.
  void launch(const std::vector<uint64_t>& indices, double times) {
    std::vector<Task> tasks;
    for (const uint64_t index : indices) tasks.push_back(plan_.task(index));
    const Asked asked = askedOf(tasks, times);
    for (const std::vector<uint64_t>& part : engine_->parts(indices)) {
      if (!engine_->hasJobs()) {
        isLaunched_ = true;
        keep({"", part, asked, round_, utcNow()});
        engine_->launch(part, asked);
        continue;
      }
      std::string id;
      try {
        id = engine_->launch(part, asked);
      } catch (const Error& error) {
        if (!submitted_.refusal) submitted_.refusal = error;
        continue;
      }
      keepJob({id, part, asked, round_, utcNow()});
      if (!request_.prints) continue;
      printText(fmt::format("{}: {}, tasks {}, each with {} asked for\n", submitted_.jobs.back().id,
                            tasks.front().isReference ? "references" : "runs", rangesText(part),
                            askedText(asked)));
    }
  }

  // Returns the mark that an attempt of this round has left; null if none began.
  const Mark* markOf(const Task& task, const TasksThere& there) const {
    const auto mark = there.marks.find(task.index);
    return mark != there.marks.end() && submissions_.isOfRound(mark->second, task.index)
               ? &mark->second
               : nullptr;
  }

  std::map<std::string, std::string> endsOfLost(const std::vector<Task>& tasks,
                                                const TasksThere& there) const {
    std::vector<std::string> lost;
    for (const Task& task : tasks) {
      const Mark* mark = markOf(task, there);
      if (mark && mark->error.empty() && !mark->job.empty()) lost.push_back(mark->job);
    }
    return engine_->hasJobs() ? slurmEnds(folder_, plan_, lost)
                              : std::map<std::string, std::string>();
  }

  // Returns the factor on what the task asks for; nothing if it is not to be tried again.
  std::optional<double> timesToAsk(const Task& task, const TasksThere& there,
                                   const std::map<std::string, std::string>& ends) const {
    const int attempts = submissions_.round() == round_ ? submissions_.attempts(task.index) : 0;
    if (attempts == 0) return 1.0;
    const bool isAgain = attempts < kMostAttempts;
    const Mark* mark = markOf(task, there);
    // Without a mark it never began, or its chunk was damaged.
    if (!mark) return isAgain ? std::optional<double>(1.0) : std::nullopt;
    if (!mark->error.empty()) return std::nullopt;
    const Asked& last = submissions_.last(task.index)->asked;
    const auto end = ends.find(mark->job);
    const bool isAsked = last.memoryMiB > 0.0 || last.seconds > 0.0;
    logWarning(fmt::format(
        "task {} ({}) ended without a result on {}{}, with {} asked for; {}", task.index,
        plan_.describe(task), mark->node, end == ends.end() ? "" : ": " + end->second,
        askedText(last),
        !isAgain  ? "it is not tried again"
        : isAsked ? fmt::format("it is tried again with {}", askedText(askedOf({task}, kAgain)))
                  : "it is tried again"));
    return isAgain ? std::optional<double>(kAgain) : std::nullopt;
  }

  void keepJob(Submission one) {
    submitted_.jobs.push_back(one);
    keep(std::move(one));
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
  std::vector<bool> isReady_;  // by reference: merged, and good enough
  bool isLaunched_ = false;    // tasks have ended, by an engine without jobs
  Submitted submitted_;
};

}  // namespace

Submitted submitPlan(const SubmitRequest& request, Plan plan) {
  return Submitter(request, std::move(plan)).submit();
}

}  // namespace restlab
