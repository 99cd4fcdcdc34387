// A suite: the scenes, methods and settings of one experiment, read from TOML (docs/manual.md lists
// every key).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image/mask.h"
#include "core/scene/camera_path.h"
#include "experiments/runner/run/prepare.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/suite/light_events.h"

namespace restlab {

struct SuiteScene {
  SceneRequest request;
  std::string name;                // in tables and file names
  std::string reference;           // a file; "": rendered and cached
  uint32_t width = 0, height = 0;  // 0: as [settings] says
  bool reverseTurns = false;       // camera paths by an angle turn the other way
  bool optional = false;           // skipped, with a line, where its files are absent
  Truth truth = Truth::rendered;
  // Instead of the suite's.
  std::optional<uint32_t> maxBounces, warmupFrames, runs;
  std::optional<bool> russianRoulette, multiscatter;
  std::optional<std::string> cameraPath;  // its name
  // What scenes of one [[scene]] have in common, which are a sweep; 0: it has this one alone.
  size_t sweep = 0;
  std::string sweepName;  // in tables
  // Where the suite says so, for errors: file:line:column.
  std::string place, cameraPlace, environmentPlace, referencePlace, truthPlace, cameraPathPlace;

  bool hasOwnSettings() const {
    return maxBounces || warmupFrames || runs || russianRoulette || multiscatter || cameraPath;
  }
};

// A [[camera_path]], or "still", and what happens to lights on it, by frame.
struct SuitePath {
  std::string name;
  CameraPath camera;
  std::vector<LightEvent> events;
};

// What another program rendered, as a row of the tables.
struct ImageRow {
  std::vector<std::string> files;  // one a run; {scene} and {component} stand for the block's
  std::vector<double> timesMs;     // per frame, one a run; empty: unknown
  BiasClass bias = BiasClass::biased;
  std::string folder;  // of the suite: where relative names are looked for as well
  std::string filesPlace;
};

struct Suite;

struct SuiteMethod {
  std::string name;       // in tables and file names; unique
  std::string base;       // the same on every backend; the name where the suite has only one
  std::string given;      // as the suite says it, without what is swept
  SessionConfig session;  // integrator, mode, cache, parameters, specialise, and what runs them
  std::optional<ImageRow> images;  // then nothing is rendered, and `session` says nothing
  // Where the suite says so, for errors: file:line:column.
  std::string backendPlace, namePlace;

  // All of the integrator's, defaults too.
  ParameterMap parameters() const;
  // Of the measured frame. A history of other light is biased, whatever is made of it.
  BiasClass bias(const Suite& suite) const;
};

// Pixels of which further figures are taken; what is given is intersected.
struct SuiteMask {
  std::string name;                        // "table" makes the figures "mse@table", ...
  std::string scene;                       // "": of every scene
  std::vector<std::string> objects;        // any of them
  std::vector<PixelRectangle> rectangles;  // any of them
  bool withoutLights = false;
  // Where the suite says so, for errors: file:line:column.
  std::string place, objectsPlace, rectanglePlace;
};

struct Suite {
  std::string name, question, file;
  std::string point;     // of the sweep over settings, "max_bounces=4"; "" without one
  std::string resolved;  // the suite with its includes, overrides and sweeps, as TOML
  std::vector<SuiteScene> scenes;
  std::vector<SuiteMethod> methods;  // rows of images after those that are rendered
  std::vector<uint32_t> components = {rl::RL_COMPONENT_ALL};
  uint32_t width = 0, height = 0;  // 0: from the camera's aspect ratio
  uint32_t maxBounces = 8;
  bool multiscatter = false;
  bool russianRoulette = false;
  uint32_t warmupFrames = 32;  // the frame after them is the one whose error is measured
  uint32_t timedFrames = 8;    // per run, the measured one first
  uint32_t runs = 8;
  uint32_t seed = 1;  // of run 0; run r has seed + r
  // Frames since the view stands still and lights stay as they are, the first one being 1, whose
  // error is recorded too.
  std::vector<uint32_t> ages;
  bool accumulate = false;  // the error of the mean of the first 1, 2, 4, ... frames is recorded
  bool temporal = false;    // flicker and correlation of the timed frames are recorded
  bool timing = true;       // false: no times, so that runs may be made side by side
  uint32_t jobs = 1;        // runs side by side
  std::string baseline;     // name of the method that ratios are against; "": the first `path`
  std::vector<std::string> metrics;  // further ones, of the measured frame
  double holdsWithin = 0.01;         // of 1: what an energy ratio may be off in a sweep of scenes
  bool failOnNonfinite = false;      // a value that is not finite ends the run with an error
  bool failOnEnergy = false;         // likewise an energy that is far off (summary/scene_sweep.h)
  std::vector<SuiteMask> masks;
  std::vector<SuitePath> paths;  // all of them; "still" is the first
  CameraPath cameraPath;         // of every scene, from its camera
  std::string cameraPathName = "still", cameraPathPlace;
  std::vector<LightEvent> events;  // of that path, by frame
  // Of all methods that do not say their own.
  std::vector<std::string> backends = {"cpu"};
  std::string device, rayTracing;  // for the backends that can have them
  bool validate = false;
  std::string devicePlace, rayTracingPlace;  // for errors
  std::string referenceBackend = "cpu", referenceBackendPlace;
  uint32_t pixelFilter = rl::RL_FILTER_BOX;
  int threads = 0;
  ReferenceTarget target;

  // Of any of its scenes.
  uint32_t mostRuns() const;
  uint32_t fewestRuns() const;
  // The methods that are no rows of images.
  std::span<const SuiteMethod> rendered() const;
  // Index of a method's yardstick: the baseline, else the first `path` method on the same backend,
  // for a row of images on the first one; methods.size() where there is none. A baseline that is
  // named without its backend is the one on the method's backend.
  size_t yardstick(size_t method) const;
  // The yardstick of all methods in words, for headings: "gi, spatial_radius=8.0", or "path on the
  // same backend" where each backend has its own; "" where there is none.
  std::string yardstickName() const;
  // Index of the plain average of that yardstick's frames: the first `path` with the denoiser
  // `accumulate` on the same backend; methods.size() where there is none.
  size_t average(size_t method) const;
  // Names the average of its frames, as yardstickName() names it.
  std::string averageName() const;
  // Index of the first method that differs in nothing but the backend; itself where it is the
  // first.
  size_t onFirstBackend(size_t method) const;
  // Backends of the methods, in their order, each once.
  std::vector<std::string> methodBackends() const;
  // Of the history; `age` as in `ages`.
  uint32_t frameOfAge(uint32_t age) const;
  // True where the camera is not the scene's in every frame.
  bool hasMovingCamera() const { return cameraPath.kind != CameraPathKind::still; }
  // True where a lamp is switched after the first frame.
  bool lightChanges() const { return !events.empty() && events.back().frame > 0; }
  // Completes `config`, whose backend is set, by what the settings say of that backend.
  void chooseDevice(SessionConfig& config) const;

 private:
  size_t firstPath(size_t method, const std::string& denoiser) const;
  std::string nameOfAll(size_t (Suite::*of)(size_t) const) const;
};

// The suite as it is for one of its scenes, whose own settings win.
Suite ofScene(const Suite& suite, const SuiteScene& scene);

// Reads a suite with `--set KEY=VALUE` overrides: a key of [settings], of [reference] as
// reference.KEY, of every method that knows it as method.KEY, of one as method.NAME.KEY, of [sweep]
// as sweep.KEY, or a top-level one; and with `--sweep KEY=VALUES`, further keys of [sweep]. One
// suite for every combination of the settings that are swept. Throws Error (badUsage) with file,
// line and column.
std::vector<Suite> loadSuites(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::string>& sweeps);

// The same where nothing sweeps settings; throws Error (badUsage) where something does.
Suite loadSuite(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace restlab
