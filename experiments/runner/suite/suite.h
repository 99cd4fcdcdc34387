// A suite: the scenes, methods and settings of one experiment, read from TOML (keys:
// docs/manual.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image/metrics/mask.h"
#include "core/scene/camera_path/camera_path.h"
#include "experiments/runner/suite/light_events.h"
#include "experiments/runner/suite/prepare.h"
#include "experiments/runner/suite/reference_target.h"
#include "experiments/runner/suite/swept_value.h"

namespace restlab {

constexpr int64_t kNoBounces = -1;

struct SuiteScene {
  SceneRequest request;
  std::string name;                // in tables and file names
  std::string reference;           // a file; "": rendered and cached
  uint32_t width = 0, height = 0;  // 0: from [settings]
  bool reverseTurns = false;       // turns of camera paths get the opposite sign
  bool optional = false;           // skipped with a message if its files are absent
  Truth truth = Truth::rendered;
  // Settings of this scene instead of the suite's.
  ParameterMap transport;  // of transportSchema()
  // Bounces that the scene's file has, kNoBounces if none; nullopt: the file is not asked.
  std::optional<int64_t> suggestedBounces;
  std::optional<uint32_t> warmupFrames, runs;
  std::optional<std::string> cameraPath;  // name of the path
  // Number of the [[scene]] whose scenes are a sweep, from 1; 0: a [[scene]] of one scene.
  size_t sweep = 0;
  std::string sweepName;  // in tables
  // Places in the suite, for errors: file:line:column.
  std::string place, cameraPlace, environmentPlace, referencePlace, truthPlace, cameraPathPlace;

  bool hasOwnSettings() const { return !transport.empty() || warmupFrames || runs || cameraPath; }
};

// A [[camera_path]], or "still", with the light events on it, by frame.
struct SuitePath {
  std::string name;
  CameraPath camera;
  std::vector<LightEvent> events;
};

// Row of images that another program rendered.
struct ImageRow {
  std::vector<std::string> files;  // one per run; {scene} and {component} are replaced by the
                                   // block's
  std::vector<double> timesMs;     // per frame, one per run; empty: unknown
  BiasClass bias = BiasClass::biased;
  std::string folder;  // of the suite; also searched for relative names
  std::string filesPlace;
};

struct Suite;

struct SuiteMethod {
  std::string name;                // in tables and file names; unique
  std::string base;                // same on every backend; equals the name if there is only one
  std::string given;               // as in the suite, without swept values
  std::vector<SweptValue> swept;   // those that the name holds
  SessionConfig session;           // integrator, mode, cache, parameters, kernels, backend
  std::optional<ImageRow> images;  // if set, nothing is rendered, and `session` is unused
  // Places in the suite, for errors: file:line:column.
  std::string backendPlace, namePlace;

  // Returns all parameters of the method, defaults included.
  ParameterMap parameters() const;
  // Returns the bias of the measured frame. A history under another light makes any mode biased.
  BiasClass bias(const Suite& suite) const;
};

// Mask over which further figures are computed; the conditions are intersected.
struct SuiteMask {
  std::string name;                        // "table" adds the figures "mse@table", ...
  std::string scene;                       // "": every scene
  std::vector<std::string> objects;        // union
  std::vector<PixelRectangle> rectangles;  // union
  bool withoutLights = false;
  // Places in the suite, for errors: file:line:column.
  std::string place, objectsPlace, rectanglePlace;
};

struct Suite : TransportSettings {
  std::string name, question, file;
  std::string point;              // values of swept settings, "max_bounces=4"; "" without a sweep
  std::vector<SweptValue> swept;  // the same, one by one
  std::string resolved;           // suite with includes, overrides and sweeps, as TOML
  std::vector<SuiteScene> scenes;
  std::vector<SuiteMethod> methods;  // rendered ones first, then rows of images
  std::vector<uint32_t> components = {rl::RL_COMPONENT_ALL};
  uint32_t width = 0, height = 0;  // 0: from the camera's aspect ratio
  uint32_t warmupFrames = 32;      // the next frame is the measured one
  uint32_t timedFrames = 8;        // per run, the measured one first
  uint32_t runs = 8;
  uint32_t seed = 1;  // of run 0; run r uses seed + r
  // Ages at which the error is also recorded: frames since view and lights came to rest, the first
  // one being 1.
  std::vector<uint32_t> ages;
  bool accumulate = false;  // record the error of the mean of the first 1, 2, 4, ... frames
  bool temporal = false;    // record flicker and correlation of the timed frames
  bool timing = true;       // false: no times, which allows parallel runs
  uint32_t jobs = 1;        // runs in parallel
  std::string baseline;     // method that ratios are relative to; "": the first `path`
  std::vector<std::string> metrics;  // further metrics of the measured frame
  double holdsWithin = 0.01;         // tolerance of energy ratios around 1 in a sweep of scenes
  bool failOnNonfinite = false;      // end with an error after a value that is not finite
  bool failOnEnergy = false;         // end with an error if an energy is far off
                                     // (tables/scene_sweep.h)
  std::vector<SuiteMask> masks;
  std::vector<SuitePath> paths;  // the first is "still"
  CameraPath cameraPath;         // applied to every scene, relative to its camera
  std::string cameraPathName = "still", cameraPathPlace;
  std::vector<LightEvent> events;  // on that path, by frame
  // Default for methods without their own.
  std::vector<std::string> backends = {"cpu"};
  std::string device, rayTracing;  // for backends that support them
  bool validate = false;
  std::string devicePlace, rayTracingPlace;  // for errors
  std::string referenceBackend = "cpu", referenceBackendPlace;
  std::string referenceIntegrator = "path";  // one of referenceIntegrators()
  // Method whose converged image is the reference instead; "": none.
  std::string referenceMethod;
  int threads = 0;
  ReferenceTarget target;

  // Over its scenes.
  uint32_t maxRuns() const;
  uint32_t minRuns() const;
  // Returns the first row of referenceMethod; null if there is none.
  const SuiteMethod* referenceRow() const;
  // Returns the methods without rows of images.
  std::span<const SuiteMethod> rendered() const;
  // Returns the index of the method that ratios of `method` are relative to: the baseline, else the
  // first `path` method on the same backend (for a row of images: on the first backend);
  // methods.size() if there is none. A baseline named without backend is looked up on the method's
  // backend.
  size_t baselineOf(size_t method) const;
  // Describes the baseline of all methods, for headings: "gi, spatial_radius=8.0", or "path on the
  // same backend" if each backend has its own; "" if there is none.
  std::string baselineName() const;
  // Returns the index of the plain average of frames: the first `path` with the denoiser
  // `accumulate` on the same backend; methods.size() if there is none.
  size_t average(size_t method) const;
  // Describes the average for headings, like baselineName().
  std::string averageName() const;
  // Returns the index of the first method that differs only in the backend; `method` if it is the
  // first.
  size_t onFirstBackend(size_t method) const;
  // Returns the backends of the methods in order, each once.
  std::vector<std::string> methodBackends() const;
  // Returns the frame of the history at that age (see `ages`).
  uint32_t frameOfAge(uint32_t age) const;
  // Returns whether the camera differs from the scene's in some frame.
  bool hasMovingCamera() const { return cameraPath.kind != CameraPathKind::still; }
  // Returns whether a light is switched after the first frame.
  bool lightChanges() const { return !events.empty() && events.back().frame > 0; }
  // Adds the settings of the backend in `config` to it.
  void chooseDevice(SessionConfig& config) const;

 private:
  size_t firstPath(size_t method, const std::string& denoiser) const;
  std::string nameOfAll(size_t (Suite::*of)(size_t) const) const;
};

// Returns the suite with one scene's own settings applied.
Suite ofScene(const Suite& suite, const SuiteScene& scene);

// Reads a suite with `--set KEY=VALUE` overrides: KEY of [settings], reference.KEY of [reference],
// method.KEY of every method that knows it, method.NAME.KEY of one method, sweep.KEY of [sweep], or
// a top-level key; and with `--sweep KEY=VALUES`, further keys of [sweep]. Returns one suite per
// combination of swept settings. `name` is looked for by findSuite(). Throws Error (badUsage) with
// file, line and column.
std::vector<Suite> loadSuites(const std::filesystem::path& name,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::string>& sweeps);

// Reads a suite without swept settings; throws Error (badUsage) if there are any.
Suite loadSuite(const std::filesystem::path& name, const std::vector<std::string>& overrides);

}  // namespace restlab
