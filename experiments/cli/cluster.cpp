// restlab plan, work, collect, submit: a suite on many machines.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>

#include "core/base/error.h"
#include "experiments/cli/options.h"
#include "experiments/cli/suite_options.h"
#include "experiments/cli/verbs.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/cluster/make_plan.h"
#include "experiments/runner/cluster/submit.h"
#include "experiments/runner/cluster/tasks_there.h"
#include "experiments/runner/cluster/work.h"

namespace restlab {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct PlanOptions {
  SuiteOptions suite;
  uint32_t runs = 1;
  uint64_t chunkSpp = 0;
  std::string estimate = "measured";
  bool dryRun = false;
};

struct WorkOptions {
  std::string folder;
  uint64_t index = 0, count = 1;
  double waitS = 0.0;
  bool json = false;
};

struct CollectOptions {
  std::string folder, out;
};

struct SubmitOptions {
  PlanOptions plan;
  std::string planning;  // the first option that only planning knows, where one was given
  SubmitRequest request;
  bool json = false;
};

void addPlanOptions(CLI::App& verb, PlanOptions& options) {
  addSuiteOptions(verb, options.suite);
  verb.add_option("--chunk", options.runs, "runs of a table that are one task (default 1)")
      ->transform(wholeNumberFrom(1, 1000000));
  verb.add_option("--chunk-spp", options.chunkSpp,
                  "samples per pixel of a reference that are one task, in whole blocks of 1024 "
                  "(default: at most 64 tasks)")
      ->transform(wholeNumberFrom(1, uint64_t(1) << 32));
  verb.add_option("--estimate", options.estimate,
                  "time and memory: measured (default), by some frames of each method, or none")
      ->check(CLI::IsMember({"measured", "none"}));
  verb.add_flag("--dry-run", options.dryRun, "prints tasks, time and memory; nothing is written");
}

PlanRequest requestOf(const PlanOptions& options, const Outcome& outcome,
                      const std::vector<Suite>& points) {
  PlanRequest request;
  request.out = fs::absolute(outFolder(options.suite, points.front())).lexically_normal();
  request.argv = outcome.argv;
  request.runsOfTask = options.runs;
  request.sppOfChunk = options.chunkSpp;
  request.measures = options.estimate == "measured";
  return request;
}

void planSuite(const PlanOptions& options, Outcome& outcome) {
  const std::vector<Suite> points = chosenSuites("plan", options.suite);
  const PlanRequest request = requestOf(options, outcome, points);
  const Plan plan = makePlan(points, request);
  if (!options.dryRun) savePlan(points, request, plan);
  printText(planTable(plan));
  if (!options.dryRun) {
    logInfo(
        fmt::format("{}: planned; `restlab work {} --index I` does task I, `restlab collect {}` "
                    "makes the tables",
                    planFile(request.out).string(),
                    options.suite.out.empty() ? request.out.string() : options.suite.out,
                    options.suite.out.empty() ? request.out.string() : options.suite.out));
  }
}

void work(const WorkOptions& options) {
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  const Plan plan = readPlan(folder);
  Json tasks = Json::array();
  for (uint64_t index = options.index; index < options.index + options.count; ++index) {
    const Task task = plan.task(index);
    const std::string what = plan.describe(task);
    const bool isMade = workTask(folder, plan, index, options.waitS);
    logInfo(fmt::format("task {} ({}): {}", index, what, isMade ? "done" : "was done already"));
    tasks.push_back({{"task", index},
                     {"what", what},
                     {"was_done_already", !isMade},
                     {"result", resultFile(folder, plan, task).string()}});
  }
  if (options.json)
    printJsonText(Json({{"folder", folder.string()}, {"tasks", std::move(tasks)}}).dump(2));
}

void sayWhatIsMissing(const Collected& collected, const fs::path& out) {
  if (collected.missing.empty()) {
    logInfo(fmt::format("{}: written, of all {}", out.string(), counted(collected.tasks, "task")));
    return;
  }
  logWarning(fmt::format("{}: runs of {} of {} are missing: {}; tables are of the others",
                         out.string(), collected.missing.size(), counted(collected.tasks, "task"),
                         rangesText(collected.missing)));
}

void collect(const CollectOptions& options) {
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  const fs::path out = options.out.empty() ? folder : fs::absolute(options.out).lexically_normal();
  const Plan plan = readPlan(folder);
  const Collected collected = collectResults(folder, plan, out);
  printText(collected.tables);
  sayWhatIsMissing(collected, out);
}

Json jsonOf(const SubmitRequest& request, const Submitted& submitted) {
  Json jobs = Json::array();
  for (const Submission& job : submitted.jobs) {
    jobs.push_back({{"id", job.id},
                    {"tasks", rangesText(job.tasks)},
                    {"asked_mib", job.asked.memoryMiB},
                    {"asked_s", job.asked.seconds}});
  }
  Json json = {
      {"folder", request.folder.string()}, {"engine", request.engine}, {"jobs", std::move(jobs)}};
  if (submitted.collected) {
    json["tasks"] = submitted.collected->tasks;
    json["missing"] = rangesText(submitted.collected->missing);
  }
  return json;
}

void submit(const SubmitOptions& options, Outcome& outcome) {
  SubmitRequest request = options.request;
  request.prints = !options.json;
  if (isPlanFolder(options.plan.suite.suite)) {
    request.folder = fs::absolute(options.plan.suite.suite).lexically_normal();
    if (!options.planning.empty()) {
      failUsage(
          fmt::format("submit {}: {} was settled when this was planned; submit the suite with "
                      "it, and another folder with -o",
                      options.plan.suite.suite, options.planning));
    }
    if (options.plan.dryRun) {
      printText(planTable(readPlan(request.folder)));
      return;
    }
  } else {
    const std::vector<Suite> points = chosenSuites("submit", options.plan.suite);
    const PlanRequest own = requestOf(options.plan, outcome, points);
    request.folder = own.out;
    const Plan plan = makePlan(points, own);
    if (!options.json) printText(planTable(plan));
    if (options.plan.dryRun) return;
    savePlan(points, own, plan);
  }
  const Submitted submitted = submitPlan(request, readPlan(request.folder));
  const std::optional<Collected>& collected = submitted.collected;
  if (options.json) printJsonText(jsonOf(request, submitted).dump(2));
  if (collected) {
    if (!options.json) printText(collected->tables);
    sayWhatIsMissing(*collected, request.folder);
  }
  if (submitted.refusal) throw Error(*submitted.refusal);
  if (collected && !collected->missing.empty()) {
    throw Error(ExitCode::badInput,
                fmt::format("{}: not all tasks could be done; `restlab status {}` says why",
                            request.folder.string(), request.folder.string()));
  }
}

}  // namespace

Action addPlanVerb(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* verb =
      app.add_subcommand("plan", "cut a suite into tasks that any machine can do by their number");
  addPlanOptions(*verb, *options);
  return [options](Outcome& outcome) { planSuite(*options, outcome); };
}

Action addWorkVerb(CLI::App& app) {
  auto options = std::make_shared<WorkOptions>();
  CLI::App* verb = app.add_subcommand("work", "do a task of a plan");
  verb->add_option("folder", options->folder, "a folder that `plan` left")->required();
  verb->add_option("--index", options->index, "number of the task, from 0")
      ->required()
      ->transform(wholeNumberFrom(0, uint64_t(1) << 53));
  verb->add_option("--count", options->count,
                   "tasks from there on, one after the other (default 1)")
      ->transform(wholeNumberFrom(1, uint64_t(1) << 32));
  verb->add_option("--wait", options->waitS,
                   "seconds to wait for references that others have merged and a network file "
                   "system does not show here yet (default 0)")
      ->transform(numberFrom(0.0, 86400.0, "seconds"));
  verb->add_flag("--json", options->json, "the finished tasks as JSON");
  return [options](Outcome&) { work(*options); };
}

Action addCollectVerb(CLI::App& app) {
  auto options = std::make_shared<CollectOptions>();
  CLI::App* verb = app.add_subcommand(
      "collect", "make tables and report of a plan's finished tasks, and say what is missing");
  verb->add_option("folder", options->folder, "a folder that `plan` left")->required();
  verb->add_option("-o,--out", options->out, "folder of the results (default: the plan's)");
  return [options](Outcome&) { collect(*options); };
}

Action addSubmitVerb(CLI::App& app) {
  auto options = std::make_shared<SubmitOptions>();
  CLI::App* verb = app.add_subcommand(
      "submit", "plan a suite, and have its tasks done by Slurm or by processes here");
  addPlanOptions(*verb, options->plan);
  verb->get_option("suite")->description(
      "a TOML file, the name of an installed suite, or a folder that `plan` left");
  verb->add_option("--engine", options->request.engine, "slurm or local (default local)")
      ->check(CLI::IsMember({"slurm", "local"}));
  verb->add_option("--sbatch", options->request.options,
                   "options of sbatch, as \"--partition=NAME --mem=4G\"; they win over what the "
                   "plan asks for, and a second attempt asks for twice their --mem and --time");
  verb->add_option("-j,--jobs", options->request.processes,
                   "processes at a time of the local engine (default 1)")
      ->transform(wholeNumberFrom(1, 1024));
  verb->add_flag("--json", options->json, "jobs, and what is missing at the end, as JSON")
      ->excludes("--dry-run");
  verb->add_flag("--go-on", options->request.goesOn, "of the scripts that this writes")->group("");
  return [options, verb](Outcome& outcome) {
    const std::set<std::string> any = {"suite",  "--engine", "--sbatch",  "--jobs",
                                       "--json", "--go-on",  "--dry-run", "--estimate"};
    for (const CLI::Option* option : verb->get_options())
      if (option->count() > 0 && any.count(option->get_name()) == 0 && options->planning.empty())
        options->planning = option->get_name();
    submit(*options, outcome);
  };
}

}  // namespace restlab
