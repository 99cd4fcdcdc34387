// restlab bias: tests whether a method is biased. A verdict with an interval, from independent
// runs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/scene/camera_path/camera_path.h"
#include "core/scene/scene.h"
#include "experiments/certificate/certify.h"
#include "experiments/certificate/outputs.h"
#include "experiments/certificate/reference_search.h"
#include "experiments/cli/file_pattern.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/results/folder_lock.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace {

using certificate::Certified;
using certificate::Question;

// Small images decide sooner: the number of runs matters, and each run has every pixel.
constexpr uint32_t kDefaultWidth = 96;
constexpr uint32_t kDefaultWarmup = 8, kDefaultFrames = 16;
// Settings of a kind of --camera-path that are not given.
const std::map<std::string, std::map<std::string, std::string>> kPathDefaults = {
    {"still", {}},
    {"orbit", {{"degrees_per_frame", "-0.25"}}},
    {"pan", {{"degrees_per_frame", "1.0"}}},
    {"dolly", {{"metres_per_frame", "0.02"}}},
    {"cut", {{"degrees", "-10.0"}, {"frame", "8"}}},
    {"back", {{"frame", "8"}}},
};

struct BiasOptions {
  SceneOptions scene;
  MethodOptions method;
  std::string images, reference, out, cameraPath;
  std::string against = "path";
  uint64_t runs = 0, maxRuns = certificate::Options().maxRuns;
  uint64_t maxReferenceSpp = certificate::Options().maxReferenceSpp;
  certificate::TimeLimit limit;
  bool isDryRun = false;
  uint32_t jobs = 0, warmup = kDefaultWarmup, frames = kDefaultFrames;
  bool warmupGiven = false, framesGiven = false, json = false;
  double marginPercent = 100.0 * certificate::Rules().margin;
};

std::vector<std::string> imagesLike(const std::string& pattern) {
  std::vector<std::string> files = filesLike(pattern);
  if (files.empty()) failInput(fmt::format("--images {}: no file is called that", pattern));
  return files;
}

// `name`: of the folder of results if --out is not given.
certificate::Options certificateOptions(const BiasOptions& options, const std::string& name) {
  certificate::Options result;
  result.rules.margin = options.marginPercent / 100.0;
  result.runs = options.runs;
  result.maxRuns = options.maxRuns;
  result.maxReferenceSpp = options.maxReferenceSpp;
  result.limit = options.limit;
  result.jobs = options.jobs;
  result.out = options.out.empty() ? std::filesystem::path("results") / ("bias-" + name)
                                   : std::filesystem::path(options.out);
  return result;
}

// Reads KIND or KIND,KEY=VALUE,... as the table that a suite would have.
CameraPath cameraPathOf(const std::string& text) {
  const std::string place = "--camera-path " + text;
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c == ',' && depth == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  const auto defaults = kPathDefaults.find(parts[0]);
  if (defaults == kPathDefaults.end()) {
    std::vector<std::string> kinds;
    for (const auto& [kind, keys] : kPathDefaults) kinds.push_back(kind);
    failUsage(
        fmt::format("--camera-path: there is no kind '{}'{}; known: {}; keyframes need a suite",
                    parts[0], didYouMean(parts[0], kinds), fmt::join(kinds, ", ")));
  }
  ConfigTable table = ConfigTable::parseText(fmt::format("kind = \"{}\"\n", parts[0]), place);
  std::map<std::string, std::string> values = defaults->second;
  for (size_t i = 1; i < parts.size(); ++i) {
    const size_t equals = parts[i].find('=');
    if (equals == std::string::npos || equals == 0)
      failUsage(fmt::format("{}: '{}' is not KEY=VALUE", place, parts[i]));
    if (parts[i].substr(0, equals) == "camera") values.erase("degrees");
    table.assign(parts[i].substr(0, equals), parts[i].substr(equals + 1), place);
  }
  for (const auto& [key, value] : values) {
    if (!table.has(key)) table.assign(key, value, place);
  }
  CameraPath path = parseCameraPath(table);
  table.finish();
  path.place = place;
  return path;
}

Question questionOf(BiasOptions options) {
  resolveResolution(options.scene);
  const SessionConfig given = makeConfig(options.scene, options.method);
  Question question;
  question.request = options.scene.request;
  question.prepared = prepareScene(question.request);
  printWarnings(question.prepared);
  question.config = given;
  question.against = options.against;
  if (question.config.width == 0 && question.config.height == 0)
    question.config.width = kDefaultWidth;
  completeConfig(question.prepared, options.scene, question.config);
  const Method method = findMethod(question.config);
  const bool hasHistory = method.hasHistory(question.config.parameters);
  question.frames = options.frames;
  question.warmup = hasHistory || options.warmupGiven ? options.warmup : 0;
  if (options.cameraPath.empty()) return question;
  const CameraPath path = cameraPathOf(options.cameraPath);
  if (path.kind == CameraPathKind::still) return question;
  question.warmup = options.warmup;
  question.change = options.cameraPath;
  question.motion = motionOf(path, question.warmup + question.frames, question.prepared);
  return question;
}

// Throws for scenes that a certificate cannot judge, before the first run.
void checkTruths(const Suite& whole) {
  for (const SuiteScene& scene : whole.scenes) {
    const Suite suite = ofScene(whole, scene);
    if (scene.truth == Truth::exact && (suite.hasMovingCamera() || suite.lightChanges())) {
      failUsage(
          fmt::format("{}: the truth of {} is of its own camera and lights; leave 'truth' out "
                      "where they change",
                      scene.truthPlace, scene.name));
    }
    if (!scene.reference.empty()) {
      failUsage(fmt::format(
          "{}: a certificate renders its reference, until its error is small enough; leave "
          "'reference' out, or compare images with it (--images, --ref)",
          scene.referencePlace));
    }
    std::string missing;
    if (scene.truth == Truth::rendered) continue;
    if (scene.optional && assetsMissing(scene.request, missing)) continue;
    const PreparedScene prepared = prepareScene(scene.request);
    uint32_t width = 0, height = 0;
    sceneResolution(suite, scene, prepared, width, height);
    for (const uint32_t component : suite.components) {
      ReferenceConfig config = referenceOfSuite(suite, pictureOf(suite, width, height, component));
      plainOf(suite, scene, prepared, config);
    }
  }
}

// Returns nothing if the reference must be rendered.
std::optional<Reference> knownTruth(const Suite& suite, const SuiteScene& scene,
                                    const PreparedScene& prepared, const SessionConfig& picture) {
  if (scene.truth != Truth::exact) return std::nullopt;
  ReferenceConfig config = referenceOfSuite(suite, picture);
  const PreparedScene plain = plainOf(suite, scene, prepared, config);
  return exactReference(scene.request, plain, config);
}

// Makes the label unique, because files are named by it. Names do not include the camera,
// environment or backend.
void giveOwnLabel(std::vector<Certified>& all) {
  std::string& label = all.back().label;
  const std::string name = label;
  const auto isTaken = [&] {
    return std::any_of(all.begin(), all.end() - 1,
                       [&](const Certified& other) { return other.label == label; });
  };
  for (int number = 2; isTaken(); ++number) label = fmt::format("{}-{}", name, number);
}

// Logs rows of images: they exist already, and may come from one history.
void sayWhatIsLeftOut(const Suite& suite) {
  for (const SuiteMethod& method : suite.methods) {
    if (method.images) {
      logInfo(
          fmt::format("{}: '{}' is a row of images and gets no certificate; --images and --ref "
                      "certify those of independent runs",
                      suite.file, method.name));
    }
  }
}

// Passes every method of the suite on every scene to `take`. Calls `sceneIsDone` after the methods
// of a scene and component.
void forEachQuestion(const Suite& whole, const BiasOptions& options,
                     const std::function<void(const Question&)>& take,
                     const std::function<void()>& sceneIsDone) {
  if (!whole.referenceMethod.empty())
    failUsage(fmt::format("{}: its reference is the method '{}'; bias judges by path or bdpt",
                          whole.file, whole.referenceMethod));
  sayWhatIsLeftOut(whole);
  bool isAny = false;
  for (const SuiteScene& scene : whole.scenes) {
    const Suite suite = ofScene(whole, scene);
    std::string missing;
    if (scene.optional && assetsMissing(scene.request, missing)) {
      logInfo(fmt::format("skipped {}: {} is not here", scene.name, missing));
      continue;
    }
    Question question;
    question.request = scene.request;
    question.prepared = prepareScene(question.request);
    printWarnings(question.prepared);
    question.motion = motionOf(suite, scene, question.prepared);
    question.lights = lightPhases(suite, question.prepared);
    question.against = suite.referenceIntegrator;
    question.change = question.motion ? suite.cameraPathName : "";
    const std::string events = eventsText(suite.events, suite.warmupFrames);
    if (!events.empty()) question.change += (question.change.empty() ? "" : ", ") + events;
    uint32_t width = 0, height = 0;
    sceneResolution(suite, scene, question.prepared, width, height);
    for (const uint32_t component : suite.components) {
      const SessionConfig picture = pictureOf(suite, width, height, component);
      question.name = scene.name;
      question.exact = knownTruth(suite, scene, question.prepared, picture);
      for (const SuiteMethod& method : suite.rendered()) {
        question.config = methodConfig(suite, method, question.prepared, picture);
        question.config.threads = suite.threads;
        question.config.seed = suite.seed;
        const bool hasHistory = findMethod(question.config).hasHistory(question.config.parameters);
        question.warmup = options.warmupGiven                ? options.warmup
                          : hasHistory || question.changes() ? suite.warmupFrames
                                                             : 0;
        question.frames = options.framesGiven ? options.frames : suite.timedFrames;
        take(question);
        isAny = true;
      }
      sceneIsDone();
    }
  }
  if (!isAny) failInput(fmt::format("{}: none of its scenes is here", whole.file));
}

// `sceneIsDone`: receives all certificates so far.
std::vector<Certified> certifySuite(
    const std::vector<Suite>& points, const BiasOptions& options, const certificate::Options& how,
    const std::function<void(const std::vector<Certified>&)>& sceneIsDone) {
  std::vector<Certified> all;
  const auto take = [&](const Question& question) {
    all.push_back(certificate::certify(question, how));
    giveOwnLabel(all);
    logInfo(certificate::lineOf(all.back()));
  };
  for (const Suite& suite : points)
    forEachQuestion(suite, options, take, [&] { sceneIsDone(all); });
  return all;
}

// Prints the cost of each certificate; writes nothing.
void dryRun(const BiasOptions& options) {
  const certificate::Options how = certificateOptions(options, "");
  const auto print = [&](const Question& question) {
    restlab::print("{}", certificate::planOf(question, how));
  };
  const std::string& scene = options.scene.request.scene;
  if (!isSuite(scene)) return print(questionOf(options));
  const std::vector<Suite> points = loadSuites(scene, options.method.parameters, {});
  for (const Suite& suite : points) checkTruths(suite);
  for (const Suite& suite : points) forEachQuestion(suite, options, print, [] {});
}

// Fails with `why` if an option is used that is not in `usable`.
void requireAmong(const std::vector<std::string>& usable, const CLI::App& verb,
                  const std::string& why) {
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::find(usable.begin(), usable.end(), name) != usable.end())
      continue;
    failUsage(fmt::format("{}: {}", name, why));
  }
}

// Rejects combinations of scene, suite and image options.
void checkOptions(const CLI::App& verb, const BiasOptions& options) {
  const bool hasImages = !options.images.empty();
  const std::string& scene = options.scene.request.scene;
  if (hasImages != !options.reference.empty()) {
    failUsage(hasImages ? "--images: needs --ref REF.exr, the truth they are compared with"
                        : "--ref: goes with --images; of a scene the reference is rendered");
  }
  if (hasImages == !scene.empty()) {
    failUsage(hasImages ? "bias: takes a scene or a suite, or --images with --ref, not both; a "
                          "pattern is quoted: --images 'run-*.exr'"
                        : "bias: needs a scene or a suite, or --images with --ref");
  }
  if (hasImages) {
    requireAmong(
        {"--help", "--quiet", "--verbose", "--images", "--ref", "--out", "--json", "--margin"},
        verb,
        "nothing is rendered for --images, which go with --ref, --margin, --out and --json alone");
  } else if (isSuite(scene)) {
    requireAmong({"--help", "--quiet", "--verbose", "scene", "--set", "--runs", "--max-runs",
                  "--jobs", "--out", "--json", "--margin", "--warmup", "--frames", "--dry-run",
                  "--time-limit", "--max-reference-spp"},
                 verb, fmt::format("the suite {} says that; --set KEY=VALUE changes it", scene));
  }
  if (options.runs > 0 && verb.get_option("--max-runs")->count() > 0)
    failUsage("--max-runs: --runs says how many there are; give one of the two");
}

// Returns the command of the certificates in a folder; "" if there are none.
std::string commandOf(const std::filesystem::path& folder) {
  std::ifstream in(folder / "certificates.json");
  const auto document = nlohmann::json::parse(in, nullptr, /*allow_exceptions=*/false);
  const bool hasOne =
      document.is_object() && document.contains("command") && document["command"].is_string();
  return hasOne ? document["command"].get<std::string>() : "";
}

void bias(BiasOptions options, const CLI::App& verb, Outcome& outcome) {
  checkOptions(verb, options);
  options.warmupGiven = verb.get_option("--warmup")->count() > 0;
  options.framesGiven = verb.get_option("--frames")->count() > 0;
  const std::string& scene = options.scene.request.scene;
  if (options.isDryRun) return dryRun(options);
  const std::string command = shellCommand(outcome.argv);
  certificate::Options how;
  std::string table;
  std::vector<Certified> all;
  std::optional<FolderLock> lock;
  // Open the folder only after all checks, and log which certificates it will lose.
  const auto openFolder = [&](const std::string& name) {
    how = certificateOptions(options, name);
    makeWritableDirectory(how.out);
    lock.emplace(how.out);
    const std::string before = commandOf(how.out);
    if (!before.empty() && before != command)
      logInfo(fmt::format("{}: page, tables and maps will replace those of {}", how.out.string(),
                          before));
  };
  if (!options.images.empty()) {
    how = certificateOptions(options, "images");
    all.push_back(certificate::certifyImages(imagesLike(options.images), options.reference, how));
    openFolder("images");
    table = certificate::markdownOf(all);
  } else if (isSuite(scene)) {
    const std::vector<Suite> points = loadSuites(scene, options.method.parameters, {});
    for (const Suite& suite : points) checkTruths(suite);
    openFolder(safeFileName(std::filesystem::path(scene).stem().string()));
    how.fewOfBiased = true;
    // Write the table after each scene: the whole suite may take hours.
    all = certifySuite(points, options, how, [&](const std::vector<Certified>& some) {
      table = certificate::suiteMarkdownOf(some, how.rules, command);
      certificate::writeTable(how.out, table);
    });
  } else {
    const Question question = questionOf(options);
    openFolder(certificate::labelOf(question));
    all.push_back(certificate::certify(question, how));
    table = certificate::markdownOf(all);
  }
  certificate::writeOutputs(how.out, all, table, command);
  bool isEquivalent = true;
  nlohmann::ordered_json documents = nlohmann::ordered_json::array();
  for (const Certified& certified : all) {
    isEquivalent =
        isEquivalent && certified.certificate.verdict == certificate::Verdict::equivalent;
    if (options.json)
      documents.push_back(certificate::jsonOf(certified));
    else if (all.size() == 1)
      print("{}", certificate::textOf(certified));
    else
      print("{}\n", certificate::lineOf(certified));
  }
  if (options.json) printJsonText((all.size() == 1 ? documents[0] : documents).dump(2));
  logInfo(fmt::format("{}: report.html, certificates.json, certificates.md and maps",
                      how.out.string()));
  if (!isEquivalent) outcome.code = ExitCode::comparisonFailed;
}

}  // namespace

Action addBiasVerb(CLI::App& app) {
  auto options = std::make_shared<BiasOptions>();
  CLI::App* verb =
      app.add_subcommand("bias", "is a method biased? a verdict from independent runs");
  addSceneOptions(*verb, options->scene);
  verb->get_option("scene")->required(false)->description(
      "a glTF, Mitsuba or scene file, a built-in scene, or a suite, whose methods are all "
      "certified");
  verb->get_option("--resolution")
      ->description("WxH pixels (default: 96 wide, the camera's aspect ratio)");
  addMethodOptions(*verb, options->method);
  verb->add_option("--runs", options->runs,
                   "independent runs of the first batch; a rejection takes as many fresh ones "
                   "(default: as many as the first 64 ask for)")
      ->transform(wholeNumberFrom(certificate::kFewestRuns, 1'000'000));
  verb->add_option("--max-runs", options->maxRuns, "that these may ask for (default 4096)")
      ->transform(wholeNumberFrom(certificate::kFewestRuns, 1'000'000));
  verb->add_option("--max-reference-spp", options->maxReferenceSpp,
                   "samples per pixel that the reference may take (default 4194304); a coarser one "
                   "makes the interval wider")
      ->transform(wholeNumberFrom(2, uint64_t(1) << 32));
  verb->add_option("--time-limit", options->limit.seconds,
                   "seconds: at most half of them for the reference, as many runs as fit into the "
                   "rest")
      ->transform(numberFrom(1.0, 1e9, "seconds"));
  verb->add_flag("--dry-run", options->isDryRun,
                 "say what the reference and the runs will take, and stop");
  verb->add_option("--margin", options->marginPercent,
                   "percent of the image's mean, within which a bias does not count (default 0.5)")
      ->transform(numberFrom(1e-4, 50.0));
  verb->add_option("--against", options->against,
                   "integrator that renders the reference: bdpt shares no choice of lights and no "
                   "weights with path (default path)")
      ->option_text("path|bdpt")
      ->check(CLI::IsMember(referenceIntegrators()));
  verb->add_option("--warmup", options->warmup,
                   "frames of a history before those that count (default 8; 0 of a method without "
                   "a history in a still view)")
      ->transform(wholeNumberFrom(0, 1u << 20));
  verb->add_option("--frames", options->frames, "frames whose mean is a run (default 16)")
      ->transform(wholeNumberFrom(1, 1u << 20));
  verb->add_option(
      "--camera-path", options->cameraPath,
      "KIND[,KEY=VALUE...]: the camera moves as by a [[camera_path]] of a suite: orbit, "
      "pan, dolly, cut, back (default: still)");
  verb->add_option("-j,--jobs", options->jobs, "runs side by side (default: one a core)")
      ->transform(wholeNumberFrom(1, 1024));
  verb->add_option("--images", options->images,
                   "pattern of EXR files, quoted: independent runs of any program");
  verb->add_option("--ref", options->reference, "EXR file that --images are compared with");
  verb->add_option(
      "-o,--out", options->out,
      "folder of the results (default results/bias-SCENE-METHOD, bias-SUITE, bias-images)");
  verb->add_flag("--json", options->json, "as JSON");
  return [options, verb](Outcome& outcome) { bias(*options, *verb, outcome); };
}

}  // namespace restlab
