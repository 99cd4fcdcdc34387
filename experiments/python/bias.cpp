// Certificates of bias, as `restlab bias` makes them.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "experiments/certificate/certify.h"
#include "experiments/certificate/outputs.h"
#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/python/settings.h"
#include "experiments/python/values.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/results/folder_lock.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

using certificate::Certified;
using certificate::Question;

// As `restlab bias` has them.
constexpr uint32_t kWidth = 96, kWarmup = 8, kFrames = 16;
constexpr uint64_t kMostRuns = 1'000'000;
constexpr double kLeastMargin = 1e-4, kMostMargin = 50.0;  // percent

struct Wish {
  std::optional<uint64_t> runs;
  double marginPercent = 0.0, timeLimitS = 0.0;
  std::string against, out;
  std::optional<uint32_t> warmup, frames;
  uint32_t jobs = 0;
};

void check(const Wish& wish) {
  const std::vector<std::string>& known = referenceIntegrators();
  if (std::find(known.begin(), known.end(), wish.against) == known.end())
    failUsage(fmt::format("against '{}': must be {}", wish.against, fmt::join(known, " or ")));
  if (wish.runs && (*wish.runs < certificate::kFewestRuns || *wish.runs > kMostRuns))
    failUsage(
        fmt::format("runs {}: must be {} to {}", *wish.runs, certificate::kFewestRuns, kMostRuns));
  if (!(wish.marginPercent >= kLeastMargin && wish.marginPercent <= kMostMargin))
    failUsage(fmt::format("margin {}: must be {:g} to {:g} percent", wish.marginPercent,
                          kLeastMargin, kMostMargin));
  if (!(wish.timeLimitS >= 0.0))
    failUsage(fmt::format("time_limit {}: must be seconds, or 0 for none", wish.timeLimitS));
  if (wish.frames == 0u) failUsage("frames 0: must be at least 1");
}

Question questionOf(Settings& settings, const Wish& wish) {
  Question question;
  if (settings.config.width == 0 && settings.config.height == 0) settings.config.width = kWidth;
  question.request = settings.request;
  question.prepared = prepare(settings);
  question.config = settings.config;
  question.against = wish.against;
  const Method method = findMethod(question.config);
  const ParameterMap parameters = resolveParameters(method, question.config.parameters);
  question.warmup = wish.warmup.value_or(method.hasHistory(parameters) ? kWarmup : 0);
  question.frames = wish.frames.value_or(kFrames);
  return question;
}

Certified certified(Settings& settings, const Wish& wish) {
  const Question question = questionOf(settings, wish);
  certificate::Options options;
  options.rules.margin = wish.marginPercent / 100.0;
  options.runs = wish.runs.value_or(0);
  options.limit.seconds = wish.timeLimitS;
  options.jobs = wish.jobs;
  options.out = wish.out.empty()
                    ? std::filesystem::path("results") / ("bias-" + certificate::labelOf(question))
                    : std::filesystem::path(wish.out);
  makeWritableDirectory(options.out);
  const FolderLock lock(options.out);
  const Certified result = certificate::certify(question, options);
  certificate::writeOutputs(options.out, {result}, certificate::markdownOf({result}),
                            shellCommand(arguments()));
  return result;
}

}  // namespace

void addBias(py::module_& module) {
  module.def(
      "bias",
      [](const py::object& scene, const std::optional<uint64_t>& runs, double margin,
         const std::string& against, const std::optional<uint32_t>& warmup,
         const std::optional<uint32_t>& frames, double timeLimit, uint32_t jobs,
         const py::object& out, const py::kwargs& keywords) {
        const Wish wish{runs,   margin, timeLimit, against, out.is_none() ? "" : textOf(out, "out"),
                        warmup, frames, jobs};
        check(wish);
        Settings settings = settingsOf(scene, keywords);
        const Certified result = rendering([&] { return certified(settings, wish); });
        return objectOf(certificate::jsonOf(result));
      },
      py::arg("scene"), py::kw_only(), py::arg("runs") = py::none(), py::arg("margin") = 0.5,
      py::arg("against") = "path", py::arg("warmup") = py::none(), py::arg("frames") = py::none(),
      py::arg("time_limit") = 0.0, py::arg("jobs") = 0, py::arg("out") = py::none(),
      "Is a method biased? The certificate of `restlab bias` as a dict, from independent runs; its "
      "page, tables\nand runs stay in the folder out. margin in percent of the image's mean. "
      "Further keywords: those of Session.");
}

}  // namespace restlab::python
