#include "experiments/runner/run/block.h"

#include "experiments/runner/base/files.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

ReferenceConfig configOfBlock(const Suite& suite, const BlockResult& block) {
  return referenceOfSuite(suite, pictureOf(suite, block.width, block.height, block.component));
}

}  // namespace

BlockResult blockOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                    uint32_t component) {
  BlockResult block;
  block.scene = scene.name;
  block.camera = prepared.cameraName;
  block.component = component;
  sceneResolution(suite, scene, prepared, block.width, block.height);
  block.motion = motionOf(suite, scene, prepared);
  block.lights = lightPhases(suite, prepared);
  return block;
}

std::vector<NeededReference> renderedReferences(const Suite& suite, const SuiteScene& scene,
                                                const PreparedScene& prepared,
                                                const BlockResult& block) {
  if (!scene.reference.empty() || scene.truth == Truth::exact) return {};
  ReferenceConfig config = configOfBlock(suite, block);
  if (scene.truth == Truth::same) {
    const PreparedScene plain = plainOf(suite, scene, prepared, config);
    return {{plain, config, plainLabel(scene.request, suite.cameraPathName, plain, config)}};
  }
  const std::string label = referenceLabel(suite, block);
  if (block.motion) config.camera = cameraAt(*block.motion, suite.warmupFrames);
  std::vector<NeededReference> needed = {
      {sceneAt(block.lights, prepared, suite.warmupFrames), config, label}};
  if (block.motion && suite.temporal && suite.warmupFrames > 0) {
    config.camera = cameraAt(*block.motion, suite.warmupFrames - 1);
    needed.push_back(
        {sceneAt(block.lights, prepared, suite.warmupFrames - 1), config, label + "-before"});
  }
  return needed;
}

fs::path referenceFileNamed(const SuiteScene& scene) {
  const fs::path found = findAsset(scene.reference);
  return found.empty() ? fs::path(scene.reference) : found;
}

void takeReferences(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                    const std::function<Reference(const NeededReference&)>& obtain,
                    BlockResult& block) {
  if (!scene.reference.empty()) {
    // checkSuites() has checked its configuration.
    const fs::path file = referenceFileNamed(scene);
    block.reference = readReference(file);
    block.referenceFile = fs::absolute(file).string();
    return;
  }
  block.referenceFile = "references/" + referenceLabel(suite, block) + ".exr";
  if (scene.truth == Truth::exact) {
    ReferenceConfig config = configOfBlock(suite, block);
    const PreparedScene plain = plainOf(suite, scene, prepared, config);
    block.reference = exactReference(scene.request, plain, config);
    return;
  }
  const std::vector<NeededReference> needed = renderedReferences(suite, scene, prepared, block);
  block.reference = obtain(needed.front());
  if (scene.truth == Truth::same)
    block.reference = multiplied(std::move(block.reference), radianceFactor(scene.request.scene));
  if (needed.size() > 1) block.referenceBefore = obtain(needed[1]);
}

}  // namespace restlab
