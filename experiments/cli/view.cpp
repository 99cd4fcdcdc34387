// restlab view: serves a page that shows two methods side by side with their reference.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "core/image/io/atomic_file.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/material_notes.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/reference/reference_progress.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/view/capture.h"
#include "experiments/view/prompt_end.h"
#include "experiments/view/redirect_file.h"
#include "experiments/view/view_loop.h"
#include "experiments/view/view_page.h"
#include "experiments/view/view_session.h"

extern char** environ;

namespace restlab {

namespace {

constexpr const char* kDefaultScene = "door-ajar";
// Default image size, or as many pixels in the camera's aspect ratio. Two CPU cores then render
// both panes several times a second.
constexpr uint32_t kWidth = 320, kHeight = 180;

constexpr const char* kInterrupted = "interrupted: the viewer ends";

constexpr uint64_t kMostFrames = 1u << 30;

struct ViewOptions {
  SceneOptions scene;
  std::vector<std::string> images;  // beside the scene's methods, or further ones after the first
                                    // image
  std::string reference, table;     // only for images
  bool anyReference = false;        // accept images of another scene
  MethodOptions first, second;
  std::string secondBackend;  // "": same as the first
  ViewServerOptions server;
  bool open = false;
  std::string capture;  // "": serve a page instead
  CaptureOptions captured;
  std::string tev;  // "": no tev
};

bool isImage(const std::string& name) { return std::filesystem::path(name).extension() == ".exr"; }
bool isResults(const std::string& name) {
  std::error_code status;
  return std::filesystem::is_directory(name, status);
}

// Fails if options other than those of any view and `more` were given.
void requireNoOptions(const CLI::App& verb, const std::string& file,
                      const std::set<std::string>& more, const std::string& why) {
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    static const std::set<std::string> ofAny = {
        "scene",     "--port",   "--listen",        "--open",
        "--capture", "--frames", "--any-reference", "--reference-spp",
        "--tev",     "--quiet",  "--verbose",       "-q",
        "-v"};
    if (option->count() > 0 && ofAny.count(name) + more.count(name) == 0)
      failUsage(fmt::format("view {}: {} is not for {}", file, name, why));
  }
}

void chooseSize(const PreparedScene& prepared, const SceneOptions& options, SessionConfig& config) {
  if (config.width == 0 && config.height == 0) {
    const double aspect = prepared.scene->source().cameras.at(prepared.camera).aspect;
    config.width = kWidth;
    if (aspect > 0.0) {
      config.width = std::max(1u, uint32_t(std::round(std::sqrt(aspect * kWidth * kHeight))));
    } else {
      config.height = kHeight;  // screens are wide
    }
  }
  completeConfig(prepared, options, config);
}

// Adds images beside the methods; pane B shows the first one.
void addImages(const ViewOptions& options, ViewStart& start, std::vector<SessionConfig>& panes) {
  if (options.images.empty()) return;
  start.images = readViewImages({options.images.begin(), options.images.end()}, {}, false);
  const Image& first = start.images.list.front().image;
  for (SessionConfig& config : panes) {
    if (config.width != 0 || config.height != 0) continue;
    config.width = first.width;
    config.height = first.height;
  }
}

ViewStart startOfMethods(ViewOptions& options) {
  resolveResolution(options.scene);
  MethodOptions& second = options.second;
  second.transport = options.first.transport;
  second.kernels = options.first.kernels;
  second.backend = options.first.backend;
  if (!options.secondBackend.empty() && options.secondBackend != second.backend.backend) {
    second.backend = {};
    second.backend.backend = options.secondBackend;
  }
  std::vector<SessionConfig> panes = {makeConfig(options.scene, options.first),
                                      makeConfig(options.scene, second)};
  ViewStart start;
  start.request = options.scene.request;
  addImages(options, start, panes);
  start.prepared = prepareScene(start.request);
  for (SessionConfig& config : panes) chooseSize(start.prepared, options.scene, config);
  start.settings = settingsOf(start.prepared, panes);
  requireSizeOf(start.images, start.settings, true);
  if (!options.anyReference) requireImagesOf(start);
  if (!start.images.list.empty())
    start.settings.panes.back().source = start.images.list.front().name;
  return start;
}

ViewStart startOf(const CLI::App& verb, ViewOptions& options) {
  const std::string& name = options.scene.request.scene;
  ViewStart start;
  if (isSuite(name)) {
    requireNoOptions(verb, name, {}, "a suite, which says it; change the file");
    return startOfSuite(name, options.anyReference);
  }
  if (isResults(name)) {
    requireNoOptions(verb, name, {"--table"}, "a folder of results, which is not rendered");
    start.images = readResultsImages(name, options.table, options.anyReference);
    const std::vector<std::string>& tables = start.images.tables;
    if (options.table.empty() && tables.size() > 1) {
      logInfo(fmt::format("{}: shows {}; the page and --table choose another one: {}", name,
                          tables.front(), fmt::join(tables, ", ")));
    }
  } else if (isImage(name)) {
    requireNoOptions(verb, name, {"images", "--ref"}, "images of files, which are not rendered");
    std::vector<std::filesystem::path> files = {name};
    files.insert(files.end(), options.images.begin(), options.images.end());
    start.images = readViewImages(files, options.reference, true, options.anyReference);
  } else {
    if (!options.reference.empty())
      failUsage("--ref: is for images alone; methods make their own reference");
    if (!options.table.empty()) failUsage("--table: is for a folder of results");
    return startOfMethods(options);
  }
  start.settings = settingsOf(start.images);
  return start;
}

LiveView viewOf(const ViewStart& start, const ReferenceStore& store) {
  if (!start.prepared.scene) return {start.images, start.settings};
  return {start.prepared, start.settings, store, start.images};
}

void logSessions(const LiveView& live) {
  if (!live.hasScene()) return;
  for (size_t i = 0; i < live.panes(); ++i) logStartup(live.session(i));
}

// Warns if no browser can be started here: the user may open the address elsewhere.
void openInBrowser(const std::string& file) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open", argument = file;
  char* const words[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, words[0], &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    logWarning(fmt::format("--open: xdg-open cannot be run ({}); open the address yourself",
                           std::strerror(error)));
  }
}

void writeCapture(const ViewStart& start, const ViewOptions& options) {
  requireCaptureSize(start.settings);
  // The reference is not stored: only the picture is written.
  LiveView live = viewOf(start, {});
  logSessions(live);
  const Figure figure = capture(live, options.captured);
  for (const std::string& name : figure.cutLabels)
    logWarning(fmt::format("'{}' does not fit above its picture and is cut", name));
  writeTextFile(options.capture, figurePng(figure, captureWords(live)));
  logInfo(fmt::format("{}: {:.0f}x{:.0f} pixels, frame {}", options.capture, figure.width,
                      figure.height, options.captured.frames));
}

// Returns the lines of the start that a page shows: warnings, and notes on the scene.
std::vector<std::string> toldAtStart(const PreparedScene& prepared) {
  std::vector<std::string> lines = keptWarnings();
  if (!prepared.scene) return lines;
  const Scene& scene = prepared.scene->source();
  for (const std::vector<std::string>& notes : {scene.notes, materialNotes(scene)})
    lines.insert(lines.end(), notes.begin(), notes.end());
  if (lines.size() > kKeptWarnings) lines.resize(kKeptWarnings);
  return lines;
}

ExitCode view(const CLI::App& verb, ViewOptions options) {
  if (options.scene.request.scene.empty()) options.scene.request.scene = kDefaultScene;
  std::optional<TevAddress> tev;
  if (!options.tev.empty()) tev = parseTevAddress(options.tev);
  if (!options.capture.empty()) {
    checkOutputs({{"--capture", options.capture, ".png"}}, options.scene.request);
    checkWritable(options.capture);
  }
  // Declared first to outlive everything that may be slow to construct or destroy.
  std::optional<PromptEnd> end;
  if (options.capture.empty()) end.emplace(verbosity() < 0 ? "" : kInterrupted);
  const ViewStart start = startOf(verb, options);
  if (start.prepared.scene) printWarnings(start.prepared);
  if (!options.capture.empty()) {
    writeCapture(start, options);
    return ExitCode::ok;
  }
  ReferenceStore store;
  store.folder = referenceCacheFolder();
  LiveView live = viewOf(start, store);
  logSessions(live);
  const int threads = start.settings.panes.front().config.threads;
  options.server.page = viewPage();
  ViewLoop loop(live,
                {start.request,
                 threads > 0 ? threads : int(std::thread::hardware_concurrency()),
                 {},
                 toldAtStart(start.prepared)},
                options.server, ".", tev);
  print("{}\n", loop.url());
  std::fflush(stdout);
  logInfo("open the address in a browser; Ctrl-C ends the viewer");
  std::optional<RedirectFile> redirect;  // kept until the end: browsers may be slow to start
  if (options.open) openInBrowser(redirect.emplace(loop.url()).path().string());
  try {
    loop.run();
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted) throw;
    end->setSaid();
    logInfo(error.what());  // the normal way to end the viewer
    return ExitCode::interrupted;
  }
  return ExitCode::ok;
}

void addSecondMethod(CLI::App& verb, ViewOptions& options) {
  MethodOptions& second = options.second;
  second.prefix = "--b-";
  second.choice.integrator = "path";
  second.choice.denoiser = "accumulate";
  for (const auto& [key, help, value] : methodSettings()) {
    const bool isBackend = value == &SessionConfig::backend;
    const std::string preset = second.choice.*value;
    const std::string fallback = isBackend ? "as --backend" : preset.empty() ? "the first" : preset;
    verb.add_option(std::string("--b-") + key,
                    isBackend ? options.secondBackend : second.choice.*value,
                    fmt::format("of pane B (default {})", fallback));
  }
  verb.add_option("--b-set", second.parameters, "KEY=VALUE: a parameter of pane B")
      ->take_all()
      ->allow_extra_args(false);
}

void addCapture(CLI::App& verb, ViewOptions& options) {
  CLI::Option* capture =
      verb.add_option("--capture", options.capture,
                      "PNG of A, B and the reference side by side, instead of a page");
  for (const char* ofPage : {"--port", "--listen", "--open", "--tev"})
    capture->excludes(verb.get_option(ofPage));
  verb.add_option("--frames", options.captured.frames, "of each pane, for --capture (default 1)")
      ->transform(wholeNumberFrom(1, kMostFrames))
      ->needs(capture);
  verb.add_option("--reference-spp", options.captured.referenceSpp,
                  "samples per pixel of the reference, for --capture (default 64)")
      ->transform(wholeNumberFrom(2, ViewLoop::kMostReferenceSpp))
      ->needs(capture);
}

}  // namespace

Action addViewVerb(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* verb = app.add_subcommand(
      "view", "compare two methods and their reference live, on a page in a browser");
  addSceneOptions(*verb, options->scene);
  verb->get_option("scene")->required(false)->description(
      "a glTF, Mitsuba or scene file, a built-in scene (default door-ajar), a suite *.toml: its "
      "first two methods, "
      "a folder of `run`: its images, or an image *.exr");
  verb->add_option("images", options->images,
                   "*.exr: more images to compare, or one beside the methods of a scene");
  verb->add_option("-r,--ref", options->reference, "of images: the reference, an EXR");
  verb->add_flag("--any-reference", options->anyReference,
                 "also images that say they are of another scene or setting");
  verb->add_option("--table", options->table,
                   "of a folder of results: the scene and component (default: the first)");
  verb->get_option("--resolution")
      ->description("WxH pixels (default: 320x180, or as many in the camera's aspect ratio)");
  options->first.choice.integrator = "restir_gi";
  addMethodOptions(*verb, options->first);
  verb->get_option("--integrator")
      ->description("of pane A, as the next ones: restlab list integrators (default restir_gi)");
  addSecondMethod(*verb, *options);
  verb->add_option("--port", options->server.port, "of the page (default: any that is free)")
      ->transform(wholeNumberFrom(0, 65535));
  verb->add_option("--listen", options->server.listen,
                   "address or name of this machine (default 127.0.0.1: nobody else reaches the "
                   "page; 0.0.0.0: every network)");
  verb->add_flag("--open", options->open, "open the page in a browser");
  verb->add_option("--tev", options->tev,
                   "HOST[:PORT] of a running tev, which gets the images, too (port 14158)");
  addCapture(*verb, *options);
  return [verb, options](Outcome& outcome) { outcome.code = view(*verb, *options); };
}

}  // namespace restlab
