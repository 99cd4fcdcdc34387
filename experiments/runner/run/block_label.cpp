#include "experiments/runner/run/block_label.h"

#include <fmt/format.h>

#include "experiments/runner/base/files.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

std::string blockLabel(const Suite& suite, const BlockResult& block) {
  const std::string path = suite.cameraPathName == "still" ? "" : "-" + suite.cameraPathName;
  // A swept path is already named in the point.
  const bool isNamed = suite.point.find("camera_path=") != std::string::npos;
  const std::string point = suite.point.empty() ? "" : "-" + suite.point;
  return safeFileName(block.scene + "-" + componentName(block.component) + (isNamed ? "" : path) +
                      point);
}

std::string referenceLabel(const Suite& suite, const BlockResult& block) {
  return safeFileName(fmt::format("{}-{}-{}x{}", blockLabel(suite, block), block.camera,
                                  block.width, block.height));
}

}  // namespace restlab
