// Writes the images of a block, with an exposure for previews.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "experiments/runner/run/files.h"
#include "experiments/runner/summary/report.h"
#include "experiments/runner/summary/report_document.h"

namespace restlab {

double previewLuminance(const glm::vec3& pixel) {
  const double luminance = 0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z;
  return luminance > 0.0 && !std::isinf(luminance) ? luminance : 0.0;
}

float previewExposure(const Image& reference) {
  std::vector<double> luminances;
  std::vector<float> brightest;
  for (const glm::vec3& pixel : reference.pixels) {
    const double luminance = previewLuminance(pixel);
    // Black pixels do not brighten the image, such as those around a room in an empty scene.
    if (luminance == 0.0) continue;
    luminances.push_back(luminance);
    brightest.push_back(std::max({pixel.x, pixel.y, pixel.z}));
  }
  return previewExposure(std::move(luminances), std::move(brightest));
}

float previewExposure(std::vector<double> luminances, std::vector<float> brightest) {
  if (brightest.empty() || luminances.empty()) return 1.0f;
  const auto percentileOf = [](auto& values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
  };
  // Geometric mean: a lamp in view does not darken the image. Nearly black pixels count as a
  // ten-thousandth of the median.
  const double least = 1e-4 * percentileOf(luminances, 0.5);
  double sum = 0.0;
  for (const double luminance : luminances) sum += std::log(std::max(luminance, least));
  const double exposure = 0.18 / std::exp(sum / double(luminances.size()));
  // Clips at most one lit pixel in a hundred, but darkens by at most two stops for that.
  return float(std::clamp(1.0 / percentileOf(brightest, 0.99), 0.25 * exposure, exposure));
}

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

void writeBlockImages(const std::filesystem::path& folder, const Suite& suite,
                      const BlockResult& block, float exposure) {
  makeWritableDirectory(folder);
  const std::string label = blockLabel(suite, block);
  const auto write = [&](const std::string& name, const Image& image,
                         std::map<std::string, std::string> metadata) {
    LayeredImage file;
    file.layers[""] = image;
    file.metadata = std::move(metadata);
    file.metadata["preview_exposure"] = fmt::format("{:.6g}", exposure);
    const std::string stem = label + "-" + safeFileName(name);
    writeExr(folder / (stem + ".exr"), file);
    writePng(folder / (stem + ".png"), image, exposure, file.metadata);
  };
  write("reference", block.reference.mean, block.reference.metadata);
  for (size_t m = 0; m < block.methods.size(); ++m) {
    const MethodResult& method = block.methods[m];
    if (!method.runs.empty()) write(suite.methods[m].name, method.shown, method.metadata);
  }
}

}  // namespace restlab
