// Checks a suite before its first frame, so that no run ends after hours at the camera of its last
// scene.
#pragma once

#include <map>
#include <optional>

#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Returns the size of a scene's images, from its own settings, the suite's or the camera.
void sceneResolution(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                     uint32_t& width, uint32_t& height);

// Returns the scene without its relations, in the light of the measured frame, for which the truth
// is known. `prepared`: the scene itself. A moving camera of that frame is set in `config`. Throws
// Error (badUsage) at the place in the suite if the requested truth is not available for this view.
PreparedScene plainOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                      ReferenceConfig& config);

// Returns the settings that all methods of a block and its reference share, with the reference's
// backend.
SessionConfig pictureOf(const Suite& suite, uint32_t width, uint32_t height, uint32_t component);

// Resolves the suite's camera path in the scene; nothing if the camera never differs from the
// scene's. Throws Error (badUsage) at the place of the mistake.
std::optional<CameraMotion> motionOf(const Suite& suite, const SuiteScene& scene,
                                     const PreparedScene& prepared);

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
