// restlab run: runs a suite of experiments.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "experiments/cli/options.h"
#include "experiments/cli/suite_options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/results/dry_run.h"
#include "experiments/runner/results/suite_runner.h"

namespace restlab {

namespace {

struct RunOptions {
  SuiteOptions suite;
  uint32_t jobs = 1;
  bool force = false, dryRun = false;
};

void setJobs(uint32_t jobs, Suite& suite) {
  suite.jobs = jobs;
  if (jobs < 2) return;
  if (suite.timing) {
    failUsage(
        fmt::format("-j {}: runs side by side disturb each other's times; give --set timing=false "
                    "to go without times",
                    jobs));
  }
  const std::vector<std::string> backends = suite.methodBackends();
  if (std::find(backends.begin(), backends.end(), "vulkan") != backends.end())
    failUsage(fmt::format("-j {}: runs on vulkan are made one after the other", jobs));
}

void runVerb(const RunOptions& options, Outcome& outcome) {
  std::vector<Suite> points = chosenSuites("run", options.suite);
  for (Suite& suite : points) setJobs(options.jobs, suite);
  SuiteRequest request;
  request.out = outFolder(options.suite, points.front());
  request.argv = outcome.argv;
  request.force = options.force;
  logChoice(points, request.out);
  if (options.dryRun) {
    printText(planText(points, request));
    return;
  }
  if (!runSuite(points, request)) {
    throw Error(ExitCode::interrupted,
                fmt::format("interrupted: finished runs are kept in {}; the same command goes on",
                            request.out.string()));
  }
}

}  // namespace

Action addRunVerb(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand("run", "run a suite: errors and times against references");
  addSuiteOptions(*verb, options->suite);
  verb->add_flag("--force", options->force, "make runs anew that are there already");
  verb->add_flag("--dry-run", options->dryRun,
                 "what would be run, with estimates of time and memory; nothing is written");
  verb->add_option("-j,--jobs", options->jobs,
                   "runs side by side, each with its share of the cores; needs timing = false")
      ->transform(wholeNumberFrom(1, 1024));
  verb->add_flag_callback(
      "--json", [] { setEventLog(true); }, "on stderr, one JSON object a line and event");
  return [options](Outcome& outcome) { runVerb(*options, outcome); };
}

}  // namespace restlab
