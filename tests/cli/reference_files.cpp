#include "tests/cli/reference_files.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

namespace restlab::cli_test {

namespace fs = std::filesystem;

std::vector<fs::path> ReferenceFilesTest::states() const {
  std::vector<fs::path> files;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(path("cache/restlab/references"), status)) {
    if (entry.path().extension() == ".state") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

uint64_t ReferenceFilesTest::keptSpp() const {
  const std::vector<fs::path> files = states();
  if (files.size() != 1) return 0;
  const std::string text = read(fs::relative(files[0], folder_).string());
  constexpr size_t kPrefixBytes = 24;
  if (text.size() < kPrefixBytes) return 0;
  uint32_t count = 0;  // bytes of the header
  std::memcpy(&count, text.data() + 12, sizeof(count));
  const auto header = nlohmann::json::parse(text.substr(kPrefixBytes, count));
  return header.at("samples_half0").get<uint64_t>() + header.at("samples_half1").get<uint64_t>();
}

void ReferenceFilesTest::expectSame(const std::string& a, const std::string& b) const {
  LayeredImage first = readExr(path(a)), second = readExr(path(b));
  ASSERT_EQ(first.layers.size(), 4u);
  for (const auto& [name, layer] : first.layers) {
    EXPECT_EQ(layer.pixels, second.layers.at(name).pixels) << a << ", " << b << ": " << name;
  }
  // Metadata about how and when the image was rendered.
  for (const char* word : {"render_time_s", "utc", "command", "load_1min", "peak_resident_mib"}) {
    EXPECT_EQ(first.metadata.erase(word), 1u) << word;
    EXPECT_EQ(second.metadata.erase(word), 1u) << word;
  }
  EXPECT_EQ(first.metadata, second.metadata);
}

void ReferenceFilesTest::expectInOneGo(const std::string& file, const std::string& options) const {
  const ProgramResult result = run("reference -q --anew -o in-one-go.exr " + options);
  ASSERT_EQ(result.code, 0) << result.err;
  expectSame(file, "in-one-go.exr");
}

}  // namespace restlab::cli_test
