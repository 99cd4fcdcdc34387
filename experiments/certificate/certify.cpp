#include "experiments/certificate/certify.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/radiance_range.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/image/metrics/metrics.h"
#include "experiments/certificate/reference_search.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/run/render_command.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab::certificate {
namespace {

using Batch = RunFolder::Batch;

// Pilot runs, from which the number of runs is planned.
constexpr uint64_t kPilotRuns = 64;
// With fewer rare events a mean is known no better than to one seventh.
constexpr double kFewEvents = 50.0;

std::string integratorName(const SessionConfig& config) {
  std::string name = config.integrator;
  if (findIntegrator(config.integrator).modes.size() > 1) name += " " + config.mode;
  if (!config.cache.empty()) name += ", " + config.cache;
  return name;
}

std::string parametersName(const SessionConfig& config) {
  std::string name;
  if (config.backend != "cpu") name += ", on " + config.backend;
  if (config.kernels == KernelChoice::general) name += ", general kernels";
  for (const auto& [key, value] : config.parameters)
    name += fmt::format(", {} {}", key, parameterText(value));
  if (config.components != rl::RL_COMPONENT_ALL)
    name += fmt::format(", {} light", componentName(config.components));
  return name;
}

std::string sceneName(const Question& question) {
  const std::string name =
      question.name.empty() ? question.prepared.scene->source().name : question.name;
  return question.change.empty() ? name : name + ", " + question.change;
}

std::string nameOf(const Question& question) {
  const SessionConfig& config = question.config;
  return sceneName(question) + ", " + integratorName(config) +
         (config.denoiser == "none" ? "" : ", " + config.denoiser) + parametersName(config);
}

void nameIt(const Question& question, Certified& c) {
  const SessionConfig& config = question.config;
  c.scene = sceneName(question);
  c.method = integratorName(config) + parametersName(config);
  c.denoiser = config.denoiser;
  c.name = nameOf(question);
  c.label = labelOf(question);
  const Method method = findMethod(config);
  const ParameterMap parameters = resolveParameters(method, config.parameters);
  // A history remembers the light that was.
  const bool remembers = lightChanges(question) && method.hasHistory(parameters);
  c.declared = remembers ? BiasClass::biased
                         : method.bias(config.mode, parameters, question.motion.has_value());
}

Evidence evidenceOf(const RunFolder& folder, const Question& question, Batch batch,
                    uint64_t count) {
  Evidence evidence(question.config.width, question.config.height);
  folder.forEach(batch, count, [&](const Image& image) { evidence.add(image); });
  return evidence;
}

// Plans the number of runs from pilot runs. `runS`: seconds per pilot run, set if they were
// rendered now.
uint64_t plannedRuns(RunFolder& folder, const Question& question, const stats::Truth& truth,
                     const Options& options, double& runS) {
  const uint64_t pilot = std::min(kPilotRuns, options.maxRuns);
  const auto start = std::chrono::steady_clock::now();
  const bool areThere = std::filesystem::exists(folder.file(Batch::first, pilot - 1));
  folder.make(Batch::first, pilot);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (!areThere) runS = spent.count() / double(pilot);
  const Evidence evidence = evidenceOf(folder, question, Batch::first, pilot);
  if (options.fewOfBiased && rejects(evidence.runs(), truth, options.rules))
    return std::min(kRunsForCells, options.maxRuns);
  const double needed = runsForEquivalence(evidence, truth, options.rules);
  if (std::isnan(needed)) {
    logWarning("no number of runs makes up for the reference's own error; cells are judged alone");
    return std::min(kRunsForCells, options.maxRuns);
  }
  const uint64_t wanted = uint64_t(std::ceil(std::min(needed, 1e9) / 32.0)) * 32;
  if (wanted > options.maxRuns) {
    logInfo(
        fmt::format("by the first {}, an unbiased method takes {} runs; {} are allowed "
                    "(--max-runs)",
                    counted(pilot, "run"), wanted, options.maxRuns));
  }
  return std::clamp(wanted, kFewestRuns, options.maxRuns);
}

// Limits runs to the remaining time, half of which is kept for a fresh batch. Warns if that is
// fewer than wanted.
uint64_t withinTime(uint64_t runs, double runS, const Options& options) {
  if (!options.limit.isSet() || runS <= 0.0) return runs;
  const double leftS = options.limit.leftS();
  const uint64_t allowed = std::max(uint64_t(0.5 * leftS / runS), kFewestRuns);
  if (allowed >= runs) return runs;
  logWarning(timeLimitText(allowed, runs, leftS, runS));
  return allowed;
}

void judgeRuns(RunFolder& folder, const Question& question, uint64_t runs, const Options& options,
               Certified& c) {
  folder.make(Batch::first, runs);
  const Evidence evidence = evidenceOf(folder, question, Batch::first, runs);
  c.health = folder.health();
  const auto freshBatch = [&] {
    logInfo("the first batch rejects; a fresh one has to say so, too");
    folder.make(Batch::fresh, runs);
    const stats::RunSet fresh = evidenceOf(folder, question, Batch::fresh, runs).runs();
    c.health = folder.health();
    return fresh;
  };
  c.certificate = judge(evidence, evidence.runs(), freshBatch, c.reference, options.rules);
  countNonfiniteSamples(c.certificate, c.health.health.counts[rl::RL_HEALTH_NONFINITE]);
  c.mean = evidence.mean();
}

void addNotes(Certified& c, const DenoiserInfo* denoiser) {
  const Certificate& certificate = c.certificate;
  const std::string outside = denoiser ? whyOutsideRange(*denoiser, c.reference.mean) : "";
  if (!outside.empty()) c.notes.push_back(outside);
  const stats::BlockGrid grid(c.mean.width, c.mean.height);
  if (certificate.cells.untestableShare > 0.0) {
    const std::string whole = testedAsAWhole(certificate, grid);
    c.notes.push_back(
        fmt::format("{:.1f} % of the image lies in cells that are too skewed for a t-test in {}, "
                    "merged ones too: "
                    "nothing is said of a cell there{}",
                    100.0 * certificate.cells.untestableShare,
                    stats::quantityName(leastTestable(certificate.cells, grid)),
                    whole.empty() ? "" : "; the image as a whole is tested in " + whole));
  }
  const bool isOneCell =
      grid.side > 1 && std::none_of(certificate.cells.cells.begin(), certificate.cells.cells.end(),
                                    [&](const stats::CellVerdict& v) {
                                      return v.area.size < grid.side && (v.testable || v.equal);
                                    });
  if (isOneCell)
    c.notes.push_back(
        "no cell smaller than the image could be tested: biases of both signs may cancel in it; "
        "more runs would tell");
  if (certificate.fewestEvents < kFewEvents) {
    c.notes.push_back(fmt::format(
        "heavy tails: the noise of the worst cell is like that of {:.1f} rare events in {} "
        "runs; a run more may change its mean",
        certificate.fewestEvents, certificate.cells.runs));
  }
  if (!c.reference.half0 && !c.reference.variance)
    c.notes.push_back("the reference says nothing of its own error and is taken as exact");
}

// Returns the command that renders the last frame of one of these runs; "" if `render` cannot.
std::string replayOf(const Question& question, uint32_t seed) {
  if (question.changes()) return "";
  std::vector<std::string> words = renderWords(question.request, question.config, question.config);
  for (const std::string& word :
       {std::string("--seed"), std::to_string(seed), std::string("--frame"),
        std::to_string(question.warmup + question.frames)})
    words.push_back(word);
  return shellCommand(words) + " --pixel X,Y";
}

uint64_t pixelHash(const Image& image) {
  return XXH3_64bits(image.pixels.data(), image.pixels.size() * sizeof(glm::vec3));
}

// Throws Error (badInput) if the metadata show that the images are of different methods.
void requireOneMethod(const std::string& file, const std::map<std::string, std::string>& words,
                      const std::string& first, const std::map<std::string, std::string>& ofFirst) {
  std::vector<std::string> keys = {"integrator", "mode",   "cache",         "denoiser",
                                   "spp",        "frames", "warmup_frames", "kernel"};
  for (const auto& [key, value] : words)
    if (key.rfind("parameter.", 0) == 0) keys.push_back(key);
  for (const std::string& key : keys) {
    const auto own = words.find(key), other = ofFirst.find(key);
    if (own == words.end() || other == ofFirst.end() || own->second == other->second) continue;
    failInput(fmt::format("{}: {} is '{}', but '{}' in {}; a certificate is of one method", file,
                          key, own->second, other->second, first));
  }
}

}  // namespace

double TimeLimit::leftS() const {
  if (!isSet()) return std::numeric_limits<double>::infinity();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  return std::max(seconds - spent.count(), 0.0);
}

std::string timeLimitText(uint64_t allowed, uint64_t wanted, double leftS, double runS) {
  const std::string left =
      leftS < 0.5 ? "is used up" : fmt::format("leaves {} s", shortNumber(leftS, 2));
  const double neededS = 2.0 * double(allowed) * runS;
  if (neededS <= leftS) {
    return fmt::format("{} runs instead of {}: --time-limit {}, half of them for a fresh batch",
                       allowed, wanted, left);
  }
  return fmt::format(
      "{} runs, the fewest that say anything, instead of {}: --time-limit {}; with a fresh batch "
      "they take about {} s",
      allowed, wanted, left, shortNumber(neededS, 2));
}

std::string labelOf(const Question& question) {
  constexpr size_t kLongest = 120;  // file names are limited to 255 bytes
  const std::string name = safeFileName(nameOf(question));
  if (name.size() <= kLongest) return name;
  return name.substr(0, kLongest) + "-" + hexHash(XXH3_64bits(name.data(), name.size()));
}

Certified certify(const Question& question, const Options& options) {
  Certified c;
  nameIt(question, c);
  makeWritableDirectory(options.out / "references");
  c.reference = question.exact ? *question.exact
                               : convergedReference(question, safeFileName(c.scene), options);
  const stats::BlockGrid grid(question.config.width, question.config.height);
  const stats::Truth truth = truthOf(c.reference, grid);
  c.referenceError = relativeError(truth);
  RunFolder folder(question, options.out / "runs", options.jobs);
  double runS = 0.0;
  uint64_t runs =
      options.runs > 0 ? options.runs : plannedRuns(folder, question, truth, options, runS);
  runs = withinTime(runs, runS, options);
  judgeRuns(folder, question, runs, options, c);
  // Use all planned runs if the pilot runs rejected but the first batch did not decide.
  if (options.fewOfBiased && options.runs == 0 && c.certificate.verdict == Verdict::notDecided) {
    Options all = options;
    all.fewOfBiased = false;
    const uint64_t planned =
        withinTime(plannedRuns(folder, question, truth, all, runS), runS, options);
    if (planned > runs) judgeRuns(folder, question, runs = planned, options, c);
  }
  c.how = fmt::format(
      "{} runs at {}x{}, each the mean of {} of a history with a seed of its own. The reference "
      "{}.",
      runs, question.config.width, question.config.height,
      question.frames == 1
          ? fmt::format("frame {}", question.warmup + 1)
          : fmt::format("frames {} to {}", question.warmup + 1, question.warmup + question.frames),
      question.exact
          ? "is in closed form"
          : fmt::format(
                "has {} spp{}{}", c.reference.spp,
                question.against == "path" ? "" : fmt::format(" of {}", question.against),
                countedViews(question).size() == 1 ? "" : " over the views of these frames"));
  c.replay = replayOf(question, folder.seedOf(Batch::first, 0));
  addNotes(c, findMethod(question.config).denoiser);
  return c;
}

Certified certifyImages(const std::vector<std::string>& files, const std::string& reference,
                        const Options& options) {
  if (files.size() < 2 * kFewestRuns) {
    failInput(
        fmt::format("--images: {}, the first of which is {}; a certificate takes at least {}, "
                    "each from an independent run",
                    counted(files.size(), "file"), files.at(0), 2 * kFewestRuns));
  }
  Certified c;
  c.reference = readReference(reference);
  requireUsable(reference, c.reference);
  const Image& mean = c.reference.mean;
  Evidence evidence(mean.width, mean.height), first = evidence, fresh = evidence;
  std::map<uint64_t, std::string> pixels = {{pixelHash(mean), "the reference " + reference}};
  std::map<std::string, std::string> wordsOfFirst;
  std::map<std::string, std::string> seeds;
  for (size_t i = 0; i < files.size(); ++i) {
    const LayeredImage file = readColours(files[i]);
    const Image& image = file.layers.at("");
    requireSameWindow(files[i] + ":", windowOf(image), "the reference " + reference,
                      windowOf(mean));
    const auto [other, isNew] = pixels.emplace(pixelHash(image), files[i]);
    if (!isNew) {
      failInput(fmt::format("{}: has the pixels of {}; a certificate takes independent runs",
                            files[i], other->second));
    }
    if (i == 0 || c.reference.metadata.contains("scene_hash")) {  // else warned once
      requireSameConfiguration(fmt::format("{}, for {}", reference, files[i]), c.reference.metadata,
                               file.metadata);
    }
    if (i == 0) wordsOfFirst = file.metadata;
    requireOneMethod(files[i], file.metadata, files[0], wordsOfFirst);
    if (const auto seed = file.metadata.find("seed"); seed != file.metadata.end()) {
      const auto [same, isOther] = seeds.emplace(seed->second, files[i]);
      if (!isOther) {
        failInput(fmt::format("{}: has the seed {} of {}; a certificate takes independent runs",
                              files[i], seed->second, same->second));
      }
    }
    evidence.add(image);
    (i % 2 == 0 ? first : fresh).add(image);
  }
  const stats::BlockGrid grid(mean.width, mean.height);
  c.name = fmt::format("images against {}", std::filesystem::path(reference).filename().string());
  c.label = "images";
  c.isOfImages = true;
  c.referenceError = relativeError(truthOf(c.reference, grid));
  // Test cells with one half of the images, confirm with the other; the mean uses all.
  c.certificate = judge(
      evidence, first.runs(), [&] { return fresh.runs(); }, c.reference, options.rules);
  c.mean = evidence.mean();
  c.how = fmt::format(
      "{} images at {}x{}: the bias of the image is of all of them, cells are tested by each "
      "second "
      "one and confirmed by the others.",
      files.size(), mean.width, mean.height);
  addNotes(c, nullptr);
  return c;
}

}  // namespace restlab::certificate
