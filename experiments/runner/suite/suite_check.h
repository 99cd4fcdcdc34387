// What can be found wrong with a suite before its first frame: a run of hours does not end at the
// camera of its last scene.
#pragma once

#include <map>
#include <optional>

#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// The size of a scene's images, from its own settings, the suite's or the camera.
void sceneResolution(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                     uint32_t& width, uint32_t& height);

// What the truth of a scene is known of: the scene without its relations, with its camera and in
// the light of the measured frame. `prepared`: the scene itself. Gives `config` the camera of that
// frame where it moves. Throws Error (badUsage) at the place where the suite asks for a truth that
// this view does not have.
PreparedScene plainOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                      ReferenceConfig& config);

// What every method of a block, and its reference, must agree in; on the reference's backend.
SessionConfig pictureOf(const Suite& suite, uint32_t width, uint32_t height, uint32_t component);

// The suite's camera path in the scene; nothing where the camera is the scene's in every frame.
// Throws Error (badUsage) at the place of what is wrong.
std::optional<CameraMotion> motionOf(const Suite& suite, const SuiteScene& scene,
                                     const PreparedScene& prepared);

// What the check found out on its way.
struct SuiteCheck {
  std::optional<PreparedScene> only;  // the first point's, where there is one scene: loaded once
  std::map<std::string, std::vector<double>> startupMs;  // by scene: of each method's kernels
  std::vector<DeviceUse> devices;                        // of the methods, each once
};

// Loads every scene that is here, one after the other (they are the same at every point of a
// sweep), and checks for each point files, cameras, given references, the sizes of the files to
// write and the memory. Throws Error that starts with the place in the suite. Kernels are made
// ready on the way: a device that is absent is known before the first frame.
std::vector<SuiteCheck> checkSuites(const std::vector<Suite>& points);

}  // namespace restlab
