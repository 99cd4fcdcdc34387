// Writes the images of a block, with an exposure for previews.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "experiments/runner/base/files.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/tables/report.h"

namespace restlab {

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
