// restlab: the command line. Data on stdout; errors, warnings and progress on stderr.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <utility>

#include "core/backend/kernel_choice.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/kernel_progress.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"

namespace {

using namespace restlab;

constexpr const char* kFooter =
    "Exit codes: 0 ok, 1 a comparison failed, 2 bad usage or configuration, 3 bad input,\n"
    "4 device unavailable, 130 interrupted (finished results are kept).\n"
    "docs/reference.md has every option, setting, parameter and column; docs/manual.md the rest.";

struct Verb {
  const char* name;
  Action action;
};

std::vector<std::string> optionNames(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

// Rejects unknown options before any other error in the command line is reported.
void checkOptionNames(const CLI::App& verb, const std::vector<std::string>& arguments) {
  const std::vector<std::string> known = optionNames(verb);
  bool isOfOther = false;  // the value of --sbatch: options of another program
  for (const std::string& argument : arguments) {
    if (std::exchange(isOfOther, argument == "--sbatch")) continue;
    if (argument == "--") return;
    if (argument.empty()) failUsage(fmt::format("{}: an argument is empty", verb.get_name()));
    const bool isLong = argument.rfind("--", 0) == 0;
    const bool isShort = !isLong && argument.size() > 1 && argument[0] == '-' &&
                         std::isalpha(static_cast<unsigned char>(argument[1]));
    if (!isLong && !isShort) continue;
    const std::string name =
        isLong ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    failUsage(fmt::format("{}: unknown option '{}'{}", verb.get_name(), name,
                          didYouMean(isLong ? name : argument, known)));
  }
}

void addVerbosity(CLI::App& verb) {
  verb.add_flag_callback(
      "-q,--quiet", [] { setVerbosity(-1); }, "errors and warnings only");
  verb.add_flag_callback(
      "-v,--verbose", [] { setVerbosity(1); }, "details on stderr");
  verb.set_help_flag("-h,--help", "this help");
  verb.footer(kFooter);
}

int runVerb(CLI::App& app, std::vector<Verb>& verbs, const std::vector<std::string>& argv) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.name);
  if (argv.size() < 2) {
    std::fputs(app.help().c_str(), stderr);
    return int(ExitCode::badUsage);
  }
  const auto find = [&](const std::string& name) {
    const auto found = std::find_if(verbs.begin(), verbs.end(),
                                    [&](const Verb& candidate) { return candidate.name == name; });
    if (found == verbs.end()) {
      failUsage(fmt::format("unknown verb '{}' (known: {}){}", name, fmt::join(names, ", "),
                            didYouMean(name, names)));
    }
    return found;
  };
  if (argv[1] == "-h" || argv[1] == "--help" || argv[1] == "help") {
    if (argv.size() > 3) failUsage("help: takes one verb, as in: restlab help run");
    printText(argv.size() == 2 ? app.help() : app.get_subcommand(find(argv[2])->name)->help());
    return int(ExitCode::ok);
  }
  if (argv[1] == "--version") {
    print("restlab {} ({}{}, {})\n", buildInfo().version, buildInfo().gitCommit,
          buildInfo().gitDirty ? " modified" : "", librariesText());
    return int(ExitCode::ok);
  }
  const auto verb = find(argv[1]);
  checkOptionNames(*app.get_subcommand(verb->name), {argv.begin() + 2, argv.end()});
  try {
    std::vector<std::string> reversed(argv.rbegin(), argv.rend() - 1);
    app.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    printText(app.get_subcommand(verb->name)->help());
    return int(ExitCode::ok);
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    failUsage(fmt::format("{}: {} needs a value (see restlab {} --help)", verb->name,
                          text.substr(0, text.find(':')), verb->name));
  } catch (const CLI::ParseError& error) {
    std::string line = error.what();
    line.erase(std::min(line.find('\n'), line.size()));
    failUsage(fmt::format("{}: {} (see restlab {} --help)", verb->name, line, verb->name));
  }
  Outcome outcome;
  outcome.argv = argv;
  verb->action(outcome);
  return int(outcome.code);
}

int failStdout() {
  logError("stdout: cannot be written (is the disk full?)");
  return int(ExitCode::badInput);
}

}  // namespace

int main(int argc, char** argv) {
  installInterruptHandler();
  logCompiledKernels();
  setArguments(std::vector<std::string>(argv, argv + argc));
  CLI::App app("restlab measures ReSTIR-style path tracing against converged references",
               "restlab");
  app.require_subcommand(0, 1);
  app.footer(kFooter);
  std::vector<Verb> verbs = {
      {"run", addRunVerb(app)},         {"status", addStatusVerb(app)},
      {"report", addReportVerb(app)},   {"clean", addCleanVerb(app)},
      {"plan", addPlanVerb(app)},       {"work", addWorkVerb(app)},
      {"collect", addCollectVerb(app)}, {"submit", addSubmitVerb(app)},
      {"render", addRenderVerb(app)},   {"reference", addReferenceVerb(app)},
      {"compare", addCompareVerb(app)}, {"figure", addFigureVerb(app)},
      {"denoise", addDenoiseVerb(app)}, {"info", addInfoVerb(app)},
      {"list", addListVerb(app)},       {"bench", addBenchVerb(app)},
      {"view", addViewVerb(app)},       {"bias", addBiasVerb(app)},
      {"graph", addGraphVerb(app)},     {"bsdf", addBsdfVerb(app)},
      {"convert", addConvertVerb(app)}, {"distance-field", addDistanceFieldVerb(app)}};
  for (const Verb& verb : verbs) addVerbosity(*app.get_subcommand(verb.name));
  try {
    checkDefaultKernelChoice();
    const int code = runVerb(app, verbs, std::vector<std::string>(argv, argv + argc));
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 ? code : failStdout();
  } catch (const Error& error) {
    std::fflush(stdout);
    logError(error.what());
    return int(error.code());
  } catch (const std::bad_alloc&) {
    logError("out of memory; choose a smaller resolution or scene");
    return int(ExitCode::deviceUnavailable);
  } catch (const std::exception& error) {
    // fmt throws if a stream cannot be written.
    if (std::ferror(stdout) != 0) return failStdout();
    logError(fmt::format("internal error: {}", error.what()));
    return int(ExitCode::badInput);
  }
}
