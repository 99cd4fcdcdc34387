#include "experiments/runner/run/suite_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/image/io/exr_limits.h"
#include "core/image/metrics/window.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/run/block_masks.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/run/image_rows.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// Opens a session of one pixel. Reports device errors at the place in the suite that chooses the
// device; the error text begins with the command line option that would choose it.
Session open(const Suite& suite, const std::string& backendPlace, const PreparedScene& prepared,
             const SessionConfig& config) {
  try {
    return Session(prepared.scene, config);
  } catch (const Error& error) {
    const std::string text = error.what();
    const bool ofDevice = text.rfind("--device", 0) == 0;
    const bool ofRayTracing = text.rfind("--ray-tracing", 0) == 0;
    throw Error(error.code(), fmt::format("{}: {}",
                                          ofDevice       ? suite.devicePlace
                                          : ofRayTracing ? suite.rayTracingPlace
                                                         : backendPlace,
                                          text));
  }
}

// Throws unless the reference file has exactly the suite's configuration.
void checkReference(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                    uint32_t width, uint32_t height) {
  const std::string& file = scene.reference;
  const fs::path found = findAsset(file);
  const Reference reference = readReference(found.empty() ? fs::path(file) : found);
  const PixelWindow window = windowOf(reference.mean), wanted{{0, 0}, width, height};
  if (window != wanted) {
    failInput(fmt::format("{}: the reference is {}, the suite renders {}", file,
                          windowText(window, wanted), windowText(wanted, window)));
  }
  requireUsable(file, reference);
  for (const uint32_t component : suite.components) {
    requireSameConfiguration(file, reference.metadata,
                             describe(prepared, pictureOf(suite, width, height, component)));
  }
}

// Opens every method's device and makes its kernels ready. Returns bytes per pixel, at that size,
// of all methods of a block together: their frames are interleaved, so all are in memory at once.
size_t openMethods(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                   uint32_t width, uint32_t height, SuiteCheck& found) {
  // One pixel is enough: sessions compute the bytes per pixel of any size.
  const SessionConfig picture = pictureOf(suite, 1, 1, suite.components.front());
  StartupLog startup;
  size_t bytesPerPixel = 0;
  for (const SuiteMethod& method : suite.rendered()) {
    const Session session =
        open(suite, method.backendPlace, prepared, methodConfig(suite, method, prepared, picture));
    bytesPerPixel += session.bytesPerPixelOf(width, height) + hostBytesPerPixelOfMethod(suite);
    found.startupMs[scene.name].push_back(session.startup().timeMs);
    startup.add(session);
    const DeviceUse use = deviceUseOf(session);
    if (std::find(found.devices.begin(), found.devices.end(), use) == found.devices.end())
      found.devices.push_back(use);
  }
  if (scene.reference.empty()) {
    SessionConfig config = picture;
    config.camera = prepared.camera;
    startup.add(open(suite, suite.referenceBackendPlace, prepared, config));
  }
  startup.print();
  return bytesPerPixel;
}

PreparedScene loadScene(const SuiteScene& scene) {
  SceneRequest request = scene.request;
  request.camera.clear();  // chosen below, for errors at its own place
  std::optional<EnvironmentMap> environment =
      atPlace(scene.environmentPlace, [&] { return readEnvironment(request); });
  PreparedScene prepared =
      atPlace(scene.place, [&] { return prepareScene(request, std::move(environment)); });
  if (!scene.request.camera.empty()) {
    atPlace(scene.cameraPlace, [&] { chooseCamera(prepared, scene.request.camera); });
  }
  return prepared;
}

void checkScene(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                SuiteCheck& found) {
  const std::vector<LightPhase> lights = lightPhases(suite, prepared);
  motionOf(suite, scene, prepared);
  if (suite.hasMovingCamera() && !scene.reference.empty()) {
    failUsage(fmt::format("{}: a reference as a file is of a still camera, not of the path '{}'",
                          scene.referencePlace, suite.cameraPathName));
  }
  uint32_t width = 0, height = 0;
  atPlace(scene.place, [&] { sceneResolution(suite, scene, prepared, width, height); });
  if (scene.truth != Truth::rendered) {
    for (const uint32_t component : suite.components) {
      ReferenceConfig config = referenceOfSuite(suite, pictureOf(suite, width, height, component));
      plainOf(suite, scene, prepared, config);
    }
  }
  if (scene.reference.empty()) {
    atPlace(scene.place, [&] { requireExrSize("its reference", width, height, kReferenceLayers); });
  } else {
    const PreparedScene& measured = sceneAt(lights, prepared, suite.warmupFrames);
    atPlace(scene.referencePlace, [&] { checkReference(suite, scene, measured, width, height); });
  }
  for (const uint32_t component : suite.components) {
    std::map<std::string, std::string> words = describe(
        sceneAt(lights, prepared, suite.warmupFrames), pictureOf(suite, width, height, component));
    words.erase("reference_sources");  // images of other versions are accepted
    if (const auto motion = motionOf(suite, scene, prepared)) {
      describeCamera(cameraAt(*motion, suite.warmupFrames), words);
      words.erase("camera_index");  // its numbers identify the camera
    }
    checkImageRows(suite, scene.name, component, width, height, words);
  }
  if (!suite.masks.empty()) {
    BlockResult block;
    block.scene = scene.name;
    block.width = width;
    block.height = height;
    block.motion = motionOf(suite, scene, prepared);
    block.lights = lights;
    prepareMasks(suite, prepared, block);
  }
  const size_t bytesPerPixel = openMethods(suite, scene, prepared, width, height, found);
  atPlace(scene.place, [&] {
    requireMemory(fmt::format("scene {}", scene.name), width, height,
                  std::max(bytesPerPixel * suite.jobs, referenceBytesPerPixel(suite.target)));
  });
}

}  // namespace

std::vector<SuiteCheck> checkSuites(const std::vector<Suite>& points) {
  std::vector<SuiteCheck> found(points.size());
  const std::vector<SuiteScene>& scenes = points.front().scenes;
  std::string missing;
  for (const SuiteScene& scene : scenes) {
    if (scene.optional || !assetsMissing(scene.request, missing)) continue;
    // Loading reports the error, before the slow checks of existing scenes.
    if (missing == scene.request.environment)
      atPlace(scene.environmentPlace, [&] { return readEnvironment(scene.request); });
    atPlace(scene.place, [&] { return prepareScene(scene.request, std::nullopt); });
  }
  for (size_t s = 0; s < scenes.size(); ++s) {
    if (scenes[s].optional && assetsMissing(scenes[s].request, missing)) continue;
    throwIfInterrupted("nothing was rendered");
    const PreparedScene prepared = loadScene(scenes[s]);
    for (size_t p = 0; p < points.size(); ++p) {
      throwIfInterrupted("nothing was rendered");
      const SuiteScene& scene = points[p].scenes[s];
      checkScene(ofScene(points[p], scene), scene, prepared, found[p]);
    }
    if (scenes.size() == 1) found.front().only = prepared;
  }
  return found;
}

}  // namespace restlab
