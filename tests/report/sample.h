// Small report that has every part of a report: known numbers, known pixels.
#pragma once

#include <filesystem>
#include <string>

#include "core/image/image.h"
#include "experiments/report/report_model.h"

namespace restlab::report_test {

// RAII: a temporary folder.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& file);

void writeImage(const std::filesystem::path& file, const Image& image);

// Smooth image with a bright corner; every pixel differs.
Image sampleReference(uint32_t width, uint32_t height);
// Returns the image with noise of `strength`, identical for the same seed.
Image noisy(const Image& image, float strength, uint32_t seed);

// Pixels of the sample's third image that hold NaN, +Inf, -Inf, a negative and a denormal number,
// -0 and the largest float: pixel i is at x = 3 + i, y = 5.
std::vector<glm::vec3> specialPixels();

constexpr uint32_t kSampleWidth = 64, kSampleHeight = 36;

// Model of two blocks, "first" and "second"; the first has every part. Writes images/*.exr below
// `folder`.
ReportModel sampleModel(const std::filesystem::path& folder);

}  // namespace restlab::report_test
