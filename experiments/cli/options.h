// Options shared by several verbs, and their translation to a session.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/suite/prepare.h"

namespace restlab {

// Given ones of transportSchema(), by name, as texts.
using TransportTexts = std::map<std::string, std::string>;

struct SceneOptions {
  SceneRequest request;
  std::string resolution;  // "WxH"
  uint32_t width = 0, height = 0;
  uint32_t seed = 1;
  TransportTexts transport;  // those that change the expected image
  std::string component = "all";
  int threads = 0;
};

// Options of the backend.
struct BackendChoice {
  std::string backend = "cpu";
  std::string device;      // part of its name
  std::string rayTracing;  // "": the backend's best
  bool validate = false;
};

struct MethodOptions {
  SessionConfig choice;  // has methodSettings(), without the backend
  BackendChoice backend;
  std::vector<std::string> parameters;  // KEY=VALUE
  std::string prefix = "--";            // of its options, for error messages
  TransportTexts transport;             // those that leave the expected image as it is
  std::string kernels;                  // "": RESTLAB_KERNELS, or exact
};

// Accepts a number in lo..hi, optionally with a unit: s, m or h for "seconds", deg for "degrees".
CLI::Validator numberFrom(double lo, double hi, const std::string& unit = "");
// Accepts a whole number in lo..hi, also as 1e6.
CLI::Validator wholeNumberFrom(uint64_t lo, uint64_t hi);

// Adds --variant, --define and --allow-unknown, which are written behind the name of the scene; the
// scene's option comes first.
void addSceneSettings(CLI::App& verb, std::string& scene);
void addSceneOptions(CLI::App& verb, SceneOptions& options);
void addMethodOptions(CLI::App& verb, MethodOptions& options);
void addBackendOptions(CLI::App& verb, BackendChoice& options);
void addOutput(CLI::App& verb, std::string& output);
void addThreads(CLI::App& verb, int& threads);
// Adds the settings of transportSchema() for which `isMeant` returns true.
void addTransport(CLI::App& verb, TransportTexts& given,
                  const std::function<bool(const ParameterInfo&)>& isMeant);
// Sets what was given. Throws badUsage.
void applyTransport(const TransportTexts& given, TransportSettings& settings);

// Parses KEY=VALUE of `option`. `owner`: the part that has the parameters `known`, for errors.
// Throws badUsage.
ParameterMap parseParameters(const std::vector<ParameterInfo>& known, const std::string& owner,
                             const std::vector<std::string>& given,
                             const std::string& option = "--set");
// Checks what can be checked without a device; the session finds out whether the device exists.
// Throws badUsage.
void applyBackend(const BackendChoice& choice, SessionConfig& config);

// Sets width and height from --resolution, --width, --height; 0 if not given. Throws badUsage.
void resolveResolution(SceneOptions& options);

// Returns a validated configuration. completeConfig() adds what comes from the scene: the camera,
// and the size and the bounces where none are given. Throws badUsage.
SessionConfig makeConfig(const SceneOptions& scene, const MethodOptions& method);
void completeConfig(const PreparedScene& prepared, const SceneOptions& options,
                    SessionConfig& config);

struct OutputFile {
  std::string option;  // as the user named it, for error messages
  std::filesystem::path file;
  std::string extension;  // required, in either case
  std::string hint = {};  // ends the error on another extension
};

// Throws badUsage if an output has another extension, or is the same file as another output, the
// scene or the environment.
void checkOutputs(const std::vector<OutputFile>& outputs, const SceneRequest& request);

// Splits "a,b" into {"a", "b"}. Empty items are an error naming `option`.
std::vector<std::string> splitList(const std::string& text, const std::string& option);

}  // namespace restlab
