#include "experiments/runner/run/block_masks.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "experiments/runner/run/light_mask.h"
#include "experiments/runner/run/object_mask.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace {

PixelMask pixelsOf(const SuiteMask& mask, const PreparedScene& prepared,
                   const SessionConfig& picture, const BlockResult& block,
                   const std::optional<SceneCamera>& camera) {
  const auto at = [&](const std::string& place, const auto& step) {
    return atPlace(fmt::format("{}: mask '{}'", place, mask.name), step);
  };
  PixelMask pixels;
  if (!mask.rectangles.empty())
    pixels = at(mask.rectanglePlace,
                [&] { return maskOfRectangles(picture.width, picture.height, mask.rectangles); });
  if (!mask.objects.empty())
    pixels = at(mask.objectsPlace, [&] {
      return intersection(pixels, pixelsOfObjects(prepared, picture, mask.objects, camera));
    });
  if (mask.withoutLights) pixels = intersection(pixels, block.withoutLights);
  at(mask.place, [&] { countSelected(pixels, size_t(picture.width) * picture.height); });
  return pixels;
}

}  // namespace

std::optional<SceneCamera> measuredCamera(const Suite& suite, const BlockResult& block) {
  if (!block.motion) return std::nullopt;
  return cameraAt(*block.motion, suite.warmupFrames);
}

void prepareMasks(const Suite& suite, const PreparedScene& scene, BlockResult& block) {
  if (!block.withoutLights.empty()) return;
  const PreparedScene& prepared = sceneAt(block.lights, scene, suite.warmupFrames);
  SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  picture.camera = prepared.camera;
  const std::optional<SceneCamera> camera = measuredCamera(suite, block);
  block.withoutLights = pixelsWithoutLights(prepared, picture, camera);
  for (const SuiteMask& mask : suite.masks) {
    PixelMask& pixels = block.masks.emplace_back();
    if (!mask.scene.empty() && mask.scene != block.scene) continue;
    pixels = pixelsOf(mask, prepared, picture, block, camera);
  }
}

}  // namespace restlab
