#include "experiments/runner/suite_check.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/image/exr_limits.h"
#include "core/memory.h"
#include "experiments/runner/experiment.h"
#include "experiments/runner/files.h"
#include "experiments/runner/interrupt.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Runs `check`; its error is said at `place`.
template <class Check>
auto at(const std::string& place, const Check& check) {
  try {
    return check();
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", place, error.what()));
  }
}

// The reference given as a file must be of exactly the suite's configuration.
void checkReference(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                    uint32_t width, uint32_t height) {
  const std::string& file = scene.reference;
  const fs::path found = findAsset(file);
  const Reference reference = readReference(found.empty() ? fs::path(file) : found);
  if (reference.mean.width != width || reference.mean.height != height) {
    failInput(fmt::format("{}: the reference is {}x{}, the suite renders {}x{}", file,
                          reference.mean.width, reference.mean.height, width, height));
  }
  for (const uint32_t component : suite.components) {
    requireSameConfiguration(file, reference.metadata,
                             describe(prepared, pictureOf(suite, width, height, component)));
  }
}

// All methods of a block are there at once, as their frames take turns.
void checkMemory(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                 uint32_t width, uint32_t height) {
  size_t bytesPerPixel = 0;
  for (const SuiteMethod& method : suite.methods) {
    // A session of one pixel knows the bytes of every pixel.
    const SessionConfig config =
        methodConfig(suite, method, prepared, pictureOf(suite, 1, 1, suite.components.front()));
    bytesPerPixel +=
        Session(prepared.scene, config).bytesPerPixel() + hostBytesPerPixelOfMethod(suite);
  }
  requireMemory(fmt::format("scene {}", scene.name), width, height,
                std::max(bytesPerPixel, kReferenceBytesPerPixel));
}

PreparedScene checkScene(const Suite& suite, const SuiteScene& scene) {
  SceneRequest request = scene.request;
  request.camera.clear();  // looked for below, at a place of its own
  PreparedScene prepared = at(scene.place, [&] { return prepareScene(request); });
  if (!scene.request.camera.empty()) {
    at(scene.cameraPlace, [&] { chooseCamera(prepared, scene.request.camera); });
  }
  uint32_t width = 0, height = 0;
  at(scene.place, [&] { sceneResolution(suite, scene, prepared, width, height); });
  if (scene.reference.empty()) {
    at(scene.place, [&] { requireExrSize("its reference", width, height, kReferenceLayers); });
  } else {
    at(scene.referencePlace, [&] { checkReference(suite, scene, prepared, width, height); });
  }
  at(scene.place, [&] { checkMemory(suite, scene, prepared, width, height); });
  return prepared;
}

}  // namespace

void sceneResolution(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                     uint32_t& width, uint32_t& height) {
  const bool own = scene.width || scene.height;
  width = own ? scene.width : suite.width;
  height = own ? scene.height : suite.height;
  completeResolution(prepared, width, height);
}

SessionConfig pictureOf(const Suite& suite, uint32_t width, uint32_t height, uint32_t component) {
  SessionConfig config;
  config.width = width;
  config.height = height;
  config.maxBounces = suite.maxBounces;
  config.components = component;
  config.pixelFilter = suite.pixelFilter;
  config.multiscatter = suite.multiscatter;
  config.seed = suite.seed;
  config.threads = suite.threads;
  return config;
}

std::optional<PreparedScene> checkSuite(const Suite& suite) {
  std::string missing;
  for (const SuiteScene& scene : suite.scenes) {
    if (scene.optional || !assetsMissing(scene.request, missing)) continue;
    failInput(
        fmt::format("{}: scene {}: '{}' is neither a built-in scene nor a file here, in "
                    "RESTLAB_SCENES or in ../shared/scenes{}",
                    scene.place, scene.name, missing, didYouMean(missing, builtinSceneNames())));
  }
  for (const SuiteScene& scene : suite.scenes) {
    if (scene.optional && assetsMissing(scene.request, missing)) continue;
    throwIfInterrupted("nothing was rendered");
    PreparedScene prepared = checkScene(suite, scene);
    if (suite.scenes.size() == 1) return prepared;
  }
  return std::nullopt;
}

}  // namespace restlab
