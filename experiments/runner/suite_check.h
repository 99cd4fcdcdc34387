// What can be found wrong with a suite before its first frame: a run of hours does not end at the
// camera of its last scene.
#pragma once

#include <optional>

#include "experiments/runner/suite.h"

namespace restlab {

// The size of a scene's images, from its own settings, the suite's or the camera.
void sceneResolution(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                     uint32_t& width, uint32_t& height);

// What every method of a block, and its reference, must agree in.
SessionConfig pictureOf(const Suite& suite, uint32_t width, uint32_t height, uint32_t component);

// Loads every scene that is here, one after the other, and checks files, cameras, given references,
// the sizes of the files to write and the memory. Throws Error that starts with the place in the
// suite. Returns the scene of a suite that has only one, so that it is not loaded twice.
std::optional<PreparedScene> checkSuite(const Suite& suite);

}  // namespace restlab
