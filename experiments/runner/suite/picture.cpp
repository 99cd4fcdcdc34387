#include "experiments/runner/suite/picture.h"

namespace restlab {

void sceneResolution(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                     uint32_t& width, uint32_t& height) {
  const bool own = scene.width || scene.height;
  width = own ? scene.width : suite.width;
  height = own ? scene.height : suite.height;
  completeResolution(prepared, width, height);
}

std::optional<CameraMotion> motionOf(const Suite& suite, const SuiteScene& scene,
                                     const PreparedScene& prepared) {
  if (!suite.hasMovingCamera()) return std::nullopt;
  CameraPath path = suite.cameraPath;
  if (scene.reverseTurns) {
    path.degreesPerFrame = -path.degreesPerFrame;
    path.cutDegrees = -path.cutDegrees;
  }
  return motionOf(path, suite.warmupFrames + suite.timedFrames, prepared);
}

CameraMotion motionOf(const CameraPath& path, uint32_t frames, const PreparedScene& prepared) {
  CameraMotion motion = resolveCameraPath(path, prepared.scene->source(), prepared.camera);
  // Compute every frame's camera to detect a path through its target before rendering.
  for (uint32_t frame = 0; frame < frames; ++frame) cameraAt(motion, frame);
  return motion;
}

SessionConfig pictureOf(const Suite& suite, uint32_t width, uint32_t height, uint32_t component) {
  SessionConfig config;
  config.width = width;
  config.height = height;
  static_cast<TransportSettings&>(config) = suite;
  config.components = component;
  config.seed = suite.seed;
  config.threads = suite.threads;
  config.backend = suite.referenceBackend;
  suite.chooseDevice(config);
  return config;
}

}  // namespace restlab
