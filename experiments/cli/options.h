// Options that several verbs share, and their translation to a session.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/run/prepare.h"

namespace restlab {

struct SceneOptions {
  SceneRequest request;
  std::string resolution;  // "WxH"
  uint32_t width = 0, height = 0;
  uint32_t seed = 1;
  uint32_t maxBounces = 8;
  std::string component = "all";
  std::string filter = "box";
  bool multiscatter = false;
  int threads = 0;
};

// What kernels run on.
struct BackendChoice {
  std::string backend = "cpu";
  std::string device;      // a part of its name
  std::string rayTracing;  // "": the backend's best
  bool validate = false;
};

struct MethodOptions {
  SessionConfig choice;  // methodSettings() of it, but for the backend
  BackendChoice backend;
  std::vector<std::string> parameters;  // KEY=VALUE
  std::string prefix = "--";            // of its options, for errors
  bool russianRoulette = false;
  bool general = false;
};

// Bounds that the options state in --help.
constexpr uint32_t kMaxBounces = 1024;

// A number in lo..hi, which may have a unit: of "seconds" s, m or h, of "degrees" deg.
CLI::Validator numberFrom(double lo, double hi, const std::string& unit = "");
// A whole number in lo..hi, also as 1e6.
CLI::Validator wholeNumberFrom(uint64_t lo, uint64_t hi);

void addSceneOptions(CLI::App& verb, SceneOptions& options);
void addMethodOptions(CLI::App& verb, MethodOptions& options);
void addBackendOptions(CLI::App& verb, BackendChoice& options);
void addOutput(CLI::App& verb, std::string& output);
void addThreads(CLI::App& verb, int& threads);
void addMultiscatter(CLI::App& verb, bool& multiscatter);

// KEY=VALUE of `option`; `owner` has the known ones, for errors. Throws badUsage.
ParameterMap parseParameters(const std::vector<ParameterInfo>& known, const std::string& owner,
                             const std::vector<std::string>& given,
                             const std::string& option = "--set");
// What can be said without opening anything; whether a device is there the session says. Throws
// badUsage.
void applyBackend(const BackendChoice& choice, SessionConfig& config);

// Width and height from --resolution, --width, --height; 0 where not given. Throws badUsage.
void resolveResolution(SceneOptions& options);

// A validated configuration; camera and size are filled in from the scene. Throws badUsage.
SessionConfig makeConfig(const SceneOptions& scene, const MethodOptions& method);
void completeConfig(const PreparedScene& prepared, SessionConfig& config);

struct OutputFile {
  std::string option;  // as the user named it, for errors
  std::filesystem::path file;
  std::string extension;  // that it must have, in either case
  std::string hint = {};  // for who has named it otherwise
};

// Throws badUsage where an output has another extension, or is another output, the scene or the
// environment.
void checkOutputs(const std::vector<OutputFile>& outputs, const SceneRequest& request);

// "a,b" to {"a", "b"}; empty items are an error naming `option`.
std::vector<std::string> splitList(const std::string& text, const std::string& option);

}  // namespace restlab
