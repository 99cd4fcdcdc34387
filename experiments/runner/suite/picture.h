// Size, settings and camera path that all images of a block share.
#pragma once

#include <optional>

#include "core/scene/camera_path/camera_path.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Returns the size of a scene's images, from its own settings, the suite's or the camera.
void sceneResolution(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                     uint32_t& width, uint32_t& height);

// Returns the settings that all methods of a block and its reference share, with the reference's
// backend.
SessionConfig pictureOf(const Suite& suite, uint32_t width, uint32_t height, uint32_t component);

// Resolves the suite's camera path in the scene; nothing if the camera never differs from the
// scene's. Throws Error (badUsage) at the place of the mistake.
std::optional<CameraMotion> motionOf(const Suite& suite, const SuiteScene& scene,
                                     const PreparedScene& prepared);
// Resolves a path over that many frames.
CameraMotion motionOf(const CameraPath& path, uint32_t frames, const PreparedScene& prepared);

}  // namespace restlab
