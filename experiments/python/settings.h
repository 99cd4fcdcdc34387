// Settings of a session as keyword arguments of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "experiments/runner/suite/prepare.h"

namespace restlab::python {

struct Settings {
  SceneRequest request;
  SessionConfig config;
  bool hasBounces = false;  // max_bounces was given
};

// Parameters of a method by name.
ParameterMap parametersOf(const pybind11::dict& given);

// Reads a scene's name, or its path, and keywords: names of the method's parts, size, seed, device,
// camera, environment and light transport; every other keyword is a parameter of the method. Throws
// Error (badUsage) with one line naming the keyword.
Settings settingsOf(const pybind11::handle& scene, const pybind11::kwargs& keywords);

// Loads the scene and completes the settings from it: camera, size, bounces. Touches no Python
// object.
PreparedScene prepare(Settings& settings);

// Returns the settings as typed values under the names of the keywords, without parameters.
pybind11::dict settingsDict(const SessionConfig& config);

}  // namespace restlab::python
