#include "experiments/view/view_exposure.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "experiments/runner/tables/preview.h"

namespace restlab {

namespace {

constexpr uint32_t kBlockSide = 8;
constexpr uint64_t kFewSamples = 32;

// Returns the largest channel of each mean over `side` x `side` pixels within blocks that have
// light. Black means within such blocks count as 0: few samples left them black.
std::vector<float> brightestOf(const Image& image, uint32_t side, const Image& blocks) {
  const Image small = blockMeans(image, side);
  std::vector<float> brightest;
  for (uint32_t y = 0; y < small.height; ++y) {
    for (uint32_t x = 0; x < small.width; ++x) {
      const size_t block = size_t(y * side / kBlockSide) * blocks.width + x * side / kBlockSide;
      if (previewLuminance(blocks.pixels[block]) == 0.0) continue;
      const glm::vec3& mean = small.pixels[size_t(y) * small.width + x];
      const bool isLit = previewLuminance(mean) > 0.0;
      brightest.push_back(isLit ? std::max({mean.x, mean.y, mean.z}) : 0.0f);
    }
  }
  return brightest;
}

}  // namespace

Image blockMeans(const Image& image, uint32_t side) {
  const uint32_t width = (image.width + side - 1) / side, height = (image.height + side - 1) / side;
  Image means(width, height);
  std::vector<uint32_t> counts(means.pixels.size(), 0);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const size_t block = size_t(y / side) * width + x / side;
      means.pixels[block] += image.pixels[size_t(y) * image.width + x];
      ++counts[block];
    }
  }
  for (size_t i = 0; i < counts.size(); ++i) means.pixels[i] /= float(counts[i]);
  return means;
}

float exposureOfNoise(const Image& image) {
  const Image means = blockMeans(image, kBlockSide);
  std::vector<double> luminances;
  for (const glm::vec3& mean : means.pixels)
    if (const double luminance = previewLuminance(mean); luminance > 0.0)
      luminances.push_back(luminance);
  // Noise makes single pixels too bright, means of 2x2 make lamps too large: take the larger
  // exposure.
  return std::max(previewExposure(luminances, brightestOf(image, 1, means)),
                  previewExposure(luminances, brightestOf(image, 2, means)));
}

double exposureOf(const LiveView& view) {
  const LiveReference& reference = view.reference();
  if (reference.hasImage()) {
    const Image& mean = reference.mean();
    return reference.spp() >= kFewSamples ? previewExposure(mean) : exposureOfNoise(mean);
  }
  const Image* first = view.picture(0);
  return first != nullptr ? exposureOfNoise(*first) : 1.0;
}

bool isNothingLit(const LiveView& view) {
  std::vector<const Image*> pictures;
  for (size_t i = 0; i < view.panes(); ++i) pictures.push_back(view.picture(i));
  if (view.reference().hasImage()) pictures.push_back(&view.reference().mean());
  std::erase(pictures, nullptr);
  return !pictures.empty() && std::all_of(pictures.begin(), pictures.end(), [](const Image* one) {
    return std::all_of(one->pixels.begin(), one->pixels.end(),
                       [](const glm::vec3& pixel) { return pixel == glm::vec3(0.0f); });
  });
}

}  // namespace restlab
