// Bias of a method from independent runs.
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <map>

#include "experiments/cli/compare.h"
#include "experiments/runner/base/build_info.h"

namespace restlab {

namespace {

// Returns whether metadata may differ between runs of one method, or between machines.
bool mayDiffer(const std::string& key) {
  static const std::vector<std::string> keys = {
      "seed",        "render_time_s",     "health", "backend", "device",
      "ray_tracing", "features_left_out", "kernel", "mse",     "time_ms_median"};
  static const std::map<std::string, std::string> provenance = provenanceWords();
  return std::find(keys.begin(), keys.end(), key) != keys.end() || provenance.count(key) != 0;
}

}  // namespace

void ComparedMethod::add(const std::string& file, const LayeredImage& image) {
  const Image& pixels = image.layers.at("");
  const Run run{file, image.metadata,
                XXH3_64bits(pixels.pixels.data(), pixels.pixels.size() * sizeof(glm::vec3))};
  const auto fail = [&](const std::string& what) {
    failInput(fmt::format("{}: bias_rms needs independent runs of one method: {}", file, what));
  };
  for (const Run& other : runs_) {
    if (run.pixelHash == other.pixelHash) fail("the pixels are those of " + other.file);
    const auto seed = run.metadata.find("seed"), otherSeed = other.metadata.find("seed");
    if (seed == run.metadata.end() || otherSeed == other.metadata.end()) continue;
    if (seed->second == otherSeed->second) {
      fail(fmt::format("the seed {} is that of {}", seed->second, other.file));
    }
    for (const auto& [key, value] : run.metadata) {
      const auto found = other.metadata.find(key);
      const std::string otherValue = found == other.metadata.end() ? "absent" : found->second;
      if (!mayDiffer(key) && value != otherValue) {
        fail(fmt::format("{} is {}, not {} as in {}", key, value, otherValue, other.file));
      }
    }
  }
  pixels_.add(pixels);
  runs_.push_back(run);
}

ComparedRuns ComparedMethod::bias(const Reference& reference, const PixelMask& mask) const {
  const bool hasHalves = reference.half0.has_value();
  const Image& half0 = hasHalves ? *reference.half0 : reference.mean;
  const Image& half1 = hasHalves ? *reference.half1 : reference.mean;
  ComparedRuns runs;
  runs.count = runs_.size();
  runs.squaredBias = pixels_.squaredBias(half0, half1, mask);
  runs.biasRms = pixels_.biasRms(half0, half1, mask);
  runs.biasRms.detail += fmt::format(
      ", pairs of {} runs against {}", pixels_.count(),
      hasHalves ? "the reference's two halves" : "a reference without halves, whose noise it has");
  return runs;
}

}  // namespace restlab
