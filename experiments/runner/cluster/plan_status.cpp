#include "experiments/runner/cluster/plan_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/runner/cluster/engine.h"
#include "experiments/runner/cluster/submissions.h"
#include "experiments/runner/cluster/tasks_there.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

// Returns whether the task of a mark may be at work.
bool isAtWork(const Mark& mark, const std::optional<std::vector<QueuedJob>>& queue) {
  if (!mark.error.empty()) return false;
  if (!mark.job.empty() && queue) {
    return std::any_of(queue->begin(), queue->end(), [&](const QueuedJob& job) {
      return job.id == mark.job && job.state == "RUNNING";
    });
  }
  return isAlive(mark).value_or(true);
}

std::string endText(const Mark& mark) {
  if (!mark.error.empty()) return mark.error;
  const std::string asked = mark.asked.memoryMiB > 0.0 || mark.asked.seconds > 0.0
                                ? fmt::format(" (asked for {:.0f} MiB and {:.0f} min)",
                                              mark.asked.memoryMiB, mark.asked.seconds / 60.0)
                                : "";
  return "was killed, or its node was lost" + asked;
}

// Returns the job that was to go on with the plan and is gone, with how it ended and its log; null
// if it waits or is at work, or if the last submission has come to its end.
Json stopped(const fs::path& folder, const Plan& plan, const Submissions& submissions,
             const std::vector<QueuedJob>& queue) {
  if (submissions.all.empty() || submissions.collected == submissions.round()) return nullptr;
  const Submission& last = submissions.all.back();
  const std::string job = last.tasks.empty() ? last.id : "";
  const auto isIt = [&](const QueuedJob& one) { return one.id == job; };
  if (!job.empty() && std::any_of(queue.begin(), queue.end(), isIt)) return nullptr;
  const auto ends =
      job.empty() ? std::map<std::string, std::string>() : slurmEnds(folder, plan, {job});
  const fs::path log = folder / "slurm" / (job + ".log");
  std::error_code status;
  return {{"job", job},
          {"end", ends.empty() ? "" : ends.begin()->second},
          {"log", !job.empty() && fs::exists(log, status) ? log.string() : ""}};
}

}  // namespace

Json planStatus(const fs::path& folder, const Plan& plan) {
  const TasksThere there = tasksThere(folder, plan);
  const Submissions submissions = readSubmissions(folder);
  std::optional<std::vector<QueuedJob>> queue;
  if (submissions.engine == "slurm") queue = slurmQueue(folder, plan);
  Json groups = Json::array(), ended = Json::array();
  uint64_t atWork = 0;
  for (const TaskGroup& group : plan.groups()) {
    uint64_t done = 0, own = 0;
    for (uint64_t index = group.firstTask; index < group.endTask(); ++index) {
      done += there.isDone[index];
      const auto mark = there.marks.find(index);
      if (mark == there.marks.end()) continue;
      if (isAtWork(mark->second, queue)) {
        ++own;
        continue;
      }
      ended.push_back({{"task", index},
                       {"what", plan.describe(plan.task(index))},
                       {"node", mark->second.node},
                       {"why", endText(mark->second)}});
    }
    atWork += own;
    groups.push_back(
        {{"kind", group.isReference ? "reference" : "runs"},
         {"of", group.isReference ? plan.references[group.of].label : plan.tables[group.of].label},
         {"tasks", group.tasks()},
         {"done", done},
         {"at_work", own}});
  }
  Json status = {{"folder", folder.string()},
                 {"suite", plan.suite},
                 {"planned", plan.planned},
                 {"tasks", plan.tasks()},
                 {"done", there.done()},
                 {"at_work", atWork},
                 {"missing", rangesText(there.missing())},
                 {"groups", std::move(groups)},
                 {"ended_without_a_result", std::move(ended)}};
  if (queue) {
    std::map<std::string, uint64_t> states;
    for (const QueuedJob& job : *queue) ++states[job.state];
    status["queue"] = states;
    if (Json job = stopped(folder, plan, submissions, *queue); !job.is_null())
      status["stopped"] = std::move(job);
  }
  return status;
}

std::string planStatusText(const Json& status) {
  const auto number = [](const Json& of, const char* key) { return of.at(key).get<uint64_t>(); };
  std::string text =
      fmt::format("{}: {}, planned {}: {} of {} tasks are done, {} at work\n",
                  status.at("folder").get<std::string>(), status.at("suite").get<std::string>(),
                  status.at("planned").get<std::string>(), number(status, "done"),
                  number(status, "tasks"), number(status, "at_work"));
  for (const Json& group : status.at("groups")) {
    const uint64_t atWork = number(group, "at_work");
    text += fmt::format(
        "  {} {}: {} of {} tasks{}\n", group.at("kind") == "reference" ? "reference" : "runs of",
        group.at("of").get<std::string>(), number(group, "done"), number(group, "tasks"),
        atWork > 0 ? fmt::format(", {} at work", atWork) : "");
  }
  if (status.contains("queue")) {
    std::vector<std::string> states;
    for (const auto& [state, count] : status.at("queue").items())
      states.push_back(fmt::format("{} {}", count.get<uint64_t>(), state));
    text += fmt::format("  queue: {}\n",
                        states.empty() ? "empty" : fmt::format("{}", fmt::join(states, ", ")));
  }
  if (status.contains("stopped")) {
    const Json& job = status.at("stopped");
    const auto word = [&](const char* key) { return job.at(key).get<std::string>(); };
    text += fmt::format(
        "  nothing goes on by itself: {}{}{}; `restlab submit {} --engine slurm` goes on\n",
        word("job").empty() ? std::string("no job for it was taken")
                            : fmt::format("job {} is gone", word("job")),
        word("end").empty() ? "" : ": " + word("end"),
        word("log").empty() ? "" : fmt::format(" (see {})", word("log")),
        status.at("folder").get<std::string>());
  }
  for (const Json& one : status.at("ended_without_a_result")) {
    text += fmt::format("  task {} ({}) on {}: {}\n", number(one, "task"),
                        one.at("what").get<std::string>(), one.at("node").get<std::string>(),
                        one.at("why").get<std::string>());
  }
  const std::string missing = status.at("missing").get<std::string>();
  if (!missing.empty()) text += fmt::format("  missing: tasks {}\n", missing);
  return text;
}

}  // namespace restlab
