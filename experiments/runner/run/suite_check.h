// Checks a suite before its first frame, so that no run ends after hours at the camera of its last
// scene.
#pragma once

#include <map>
#include <optional>

#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Results of the check that are used later.
struct SuiteCheck {
  std::optional<PreparedScene> only;  // scene of the first point, if the suite has only one scene
  std::map<std::string, std::vector<double>> startupMs;  // by scene: time of each method's kernels
  std::vector<DeviceUse> devices;                        // of the methods, each once
};

// Loads every available scene once (all points of a sweep have the same ones), and checks for each
// point files, cameras, given references, sizes of the files to write, and memory. Throws Error
// that starts with the place in the suite. Makes kernels ready: an absent device is found before
// the first frame.
std::vector<SuiteCheck> checkSuites(const std::vector<Suite>& points);

}  // namespace restlab
