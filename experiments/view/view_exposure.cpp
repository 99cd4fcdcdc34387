#include "experiments/view/view_exposure.h"

#include "experiments/runner/summary/report_document.h"

namespace restlab {

namespace {

constexpr uint32_t kBlockSide = 8;

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

double exposureOf(const LiveView& view) {
  if (view.reference().isThere())
    return previewExposure(blockMeans(view.reference().mean(), kBlockSide));
  const Image* first = view.picture(0);
  return first != nullptr ? previewExposure(blockMeans(*first, kBlockSide)) : 1.0;
}

}  // namespace restlab
