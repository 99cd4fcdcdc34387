// Feeds the committed seeds, crashes found by fuzzing among them, to the fuzz targets. Files whose
// name begins with 'read' must be read, all others refused with a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/entries.h"

namespace restlab::fuzz {
namespace {

namespace fs = std::filesystem;

struct Target {
  const char* name;
  Entry entry;
};

class Seeds : public ::testing::TestWithParam<Target> {};

TEST_P(Seeds, AreReadOrRefused) {
  const fs::path folder = fs::path(RESTLAB_SOURCE_DIR) / "tests/fuzz/seeds" / GetParam().name;
  size_t read = 0, refused = 0;
  for (const auto& seed : fs::directory_iterator(folder)) {
    std::ifstream in(seed.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    const bool expected = seed.path().filename().string().rfind("read", 0) == 0;
    bool found = !expected;
    EXPECT_NO_THROW(
        found = GetParam().entry(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()))
        << seed.path();
    EXPECT_EQ(found, expected) << seed.path();
    ++(found ? read : refused);
  }
  EXPECT_GT(read, 0u);
  EXPECT_GT(refused, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    All, Seeds,
    ::testing::Values(Target{"gltf", readGltf}, Target{"suite", readSuite}, Target{"hdr", readHdr},
                      Target{"draco", readDraco}, Target{"meshopt", readMeshopt},
                      Target{"exr", readExr}, Target{"texture", readTexture},
                      Target{"command", readCommand}, Target{"scene_file", readSceneFile},
                      Target{"mitsuba", readMitsuba}, Target{"obj", readObjMesh},
                      Target{"ply", readPlyMesh}, Target{"serialized", readSerializedMesh},
                      Target{"field", readField}, Target{"curves", readCurves},
                      Target{"grid", readGridFile}),
    [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace restlab::fuzz
