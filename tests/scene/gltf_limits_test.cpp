// Sizes that a glTF file claims are checked before memory is allocated for them.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;
using test::GltfBuilder;

constexpr uint64_t kHuge = (uint64_t(1) << 53) - 1;  // the largest size that JSON holds exactly

nlohmann::json zeros(uint64_t count) {
  return {{"componentType", 5126}, {"count", count}, {"type", "VEC3"}};
}

TEST(GltfLimits, CountsBeyondTheirData) {
  {
    GltfBuilder file;
    file.triangle();
    file.doc["accessors"][0]["count"] = kHuge;
    EXPECT_EQ(file.error().find("accessors[0]"), 0u) << file.error();
  }
  {
    GltfBuilder file;
    file.triangle();
    file.doc["accessors"][0]["byteOffset"] = kHuge;
    EXPECT_EQ(file.error().find("accessors[0]"), 0u) << file.error();
  }
  for (const char* key : {"byteOffset", "byteLength"}) {
    GltfBuilder file;
    file.triangle();
    file.doc["bufferViews"][0][key] = kHuge;
    EXPECT_EQ(file.error().find("bufferViews[0]"), 0u) << key << ": " << file.error();
  }
  {
    GltfBuilder file;
    file.triangle();
    file.write();
    file.doc["buffers"][0]["byteLength"] = kHuge;
    EXPECT_NE(file.error().find("buffers[0].byteLength: 9007199254740991 declared"),
              std::string::npos)
        << file.error();
  }
  for (const uint64_t count : {uint64_t(4), uint64_t(0x7fffffff)}) {  // the accessor has 3 elements
    GltfBuilder file;
    file.triangle();
    const uint16_t indices[] = {0, 1, 2};
    const int view = file.bufferView(indices, sizeof indices);
    file.doc["accessors"][0]["sparse"] = {
        {"count", count},
        {"indices", {{"bufferView", view}, {"componentType", 5123}}},
        {"values", {{"bufferView", 0}}}};
    EXPECT_EQ(file.error().find("accessors[0].sparse.count"), 0u) << file.error();
  }
}

// Limits time, not memory: each accessor is read whole.
TEST(GltfLimits, OverlappingAccessorsCountTogether) {
  GltfBuilder file;
  file.triangle();
  const std::vector<float> data(size_t(1) << 20);  // 4 MiB
  const int view = file.bufferView(data.data(), data.size() * sizeof(float));
  for (int i = 0; i < 70; ++i) {
    file.doc["accessors"].push_back({{"bufferView", view},
                                     {"componentType", 5126},
                                     {"count", data.size()},
                                     {"type", "SCALAR"}});
  }
  EXPECT_EQ(file.error(), "");
  for (int i = 0; i < 20; ++i) file.doc["accessors"].push_back(file.doc["accessors"].back());
  EXPECT_NE(file.error().find("accessors[81]: with those before it names"), std::string::npos)
      << file.error();
}

TEST(GltfLimits, ElementsWithoutDataCountTogether) {
  GltfBuilder file;
  file.add("accessors", zeros(1u << 24));
  EXPECT_EQ(file.error(), "");
  file.add("accessors", zeros(1));
  EXPECT_NE(
      file.error().find("accessors[1].count: 1 elements without a bufferView; at most 16777216 "
                        "in all accessors"),
      std::string::npos)
      << file.error();
  file.doc["accessors"] = nlohmann::json::array({zeros((1u << 24) + 1)});
  EXPECT_NE(file.error().find("accessors[0].count"), std::string::npos);
}

// Makes a file of that size without bytes on the disk; false if the disk does not support it.
bool makeSparse(const fs::path& file, uint64_t bytes) {
  std::ofstream(file, std::ios::binary) << '{';
  std::error_code error;
  fs::resize_file(file, bytes, error);
  return !error;
}

TEST(GltfLimits, FilesLargerThanAnyGlb) {
  const test::TempDirectory directory;
  const fs::path file = directory.path() / "large.gltf";
  if (!makeSparse(file, uint64_t(5) << 30)) GTEST_SKIP() << "no sparse files here";
  try {
    loadGltf(file);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    EXPECT_NE(std::string(error.what()).find("5368709120 bytes are too many"), std::string::npos)
        << error.what();
  }
}

TEST(GltfLimits, WhatDoesNotFitIntoMemoryIsRefused) {
  if (!availableMemory()) GTEST_SKIP() << "this system does not say how much memory there is";
  const uint64_t bytes = uint64_t(1) << 42;
  ASSERT_LT(*availableMemory(), bytes);
  EXPECT_THROW(MemoryGuard().take("it", bytes), Error);
  EXPECT_NO_THROW(MemoryGuard().take("it", 1));
  GltfBuilder file;
  file.add("buffers", {{"uri", "large.bin"}, {"byteLength", bytes}});
  if (!makeSparse(file.directory().path() / "large.bin", bytes)) {
    GTEST_SKIP() << "no sparse files here";
  }
  const fs::path scene = file.write();
  try {
    loadGltf(scene);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::deviceUnavailable);
    EXPECT_EQ(std::string(error.what())
                  .find(scene.string() + ": buffers[0]: file 'large.bin': "
                                         "needs 4194304 MiB of memory, "),
              0u)
        << error.what();
  }
}

}  // namespace
}  // namespace restlab
