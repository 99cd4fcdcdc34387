// GLB files with inconsistent lengths: chunks are read one by one, with a warning for each broken
// rule.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::warns;

std::string u32(size_t number) {
  const auto value = static_cast<uint32_t>(number);
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

// Makes a GLB of both chunks; each has `inLength` bytes of padding within its length and `behind`
// bytes after it.
std::string glbWith(const std::string& text, const std::string& binary, size_t inLength,
                    size_t behind, int lengthError = 0) {
  std::string body;
  for (const auto& [type, data] : {std::pair(size_t(0x4e4f534a), text), {0x004e4942, binary}}) {
    const char pad = type == 0x4e4f534a ? ' ' : '\0';
    body += u32(data.size() + inLength) + u32(type) + data + std::string(inLength + behind, pad);
  }
  return "glTF" + u32(2) + u32(size_t(12 + int(body.size()) + lengthError)) + body;
}

// A document with a triangle in the binary chunk of a GLB.
json triangleDocument() {
  return {
      {"asset", {{"version", "2.0"}}},
      {"buffers", json::array({{{"byteLength", 36}}})},
      {"bufferViews", json::array({{{"buffer", 0}, {"byteLength", 36}}})},
      {"accessors",
       json::array({{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}})},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"nodes", json::array({{{"mesh", 0}}})},
      {"scenes", json::array({{{"nodes", {0}}}})}};
}

std::string triangleBytes() {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return std::string(reinterpret_cast<const char*>(corners), sizeof corners);
}

TEST(GltfGlb, ChunksOfAnyLength) {
  const json doc = triangleDocument();
  const std::string binary = triangleBytes();
  test::TempDirectory directory;
  const auto load = [&](const std::string& bytes) {
    return loadGltf(directory.write("a.glb", bytes));
  };
  for (size_t blanks = 0; blanks < 4; ++blanks) {
    const std::string text = doc.dump() + std::string(blanks, ' ');
    const size_t missing = (4 - text.size() % 4) % 4;
    const bool isWhole = missing == 0;
    // Without padding; with padding that the length does not count.
    for (const size_t behind : {size_t(0), missing}) {
      const Scene scene = load(glbWith(text, binary, 0, behind));
      ASSERT_EQ(scene.instances.size(), 1u);
      EXPECT_EQ(scene.geometries[0].positions[1].x, 1.0f);
      EXPECT_EQ(warns(scene, "a multiple of 4 expected"), !isWhole);
    }
    const Scene scene = load(glbWith(text, binary, missing, 0));
    EXPECT_EQ(warns(scene, "GLB chunk 0: has"), false);
  }
  EXPECT_THROW(load(glbWith(doc.dump(), binary, 40, 0).substr(0, 400)), Error);
}

// The lengths of the chunks decide; the length in the header does not matter.
TEST(GltfGlb, HeadersOfAnyLengthAndBytesBehindTheChunks) {
  const std::string binary = triangleBytes();
  std::string text = triangleDocument().dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  test::TempDirectory directory;
  const auto expectDrawn = [&](const std::string& bytes, const std::string& warning) {
    const Scene scene = loadGltf(directory.write("a.glb", bytes));
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.geometries[0].positions[1].x, 1.0f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find(warning), std::string::npos) << scene.warnings[0];
  };
  const int size = int(glbWith(text, binary, 0, 0).size());
  for (const int error : {-size, 12 - size, -100, -20, -3, -1, 2, 3, 4, 100, 1'000'000})
    expectDrawn(glbWith(text, binary, 0, 0, error), "the GLB header declares");
  for (const std::string& junk : {std::string("\x05"), std::string("ab"), std::string(3, '\0'),
                                  std::string("junk of 20 characters"), std::string(9, '\xff')}) {
    const std::string count =
        std::to_string(junk.size()) + (junk.size() == 1 ? " byte " : " bytes ");
    expectDrawn(glbWith(text, binary, 0, 0, int(junk.size())) + junk,
                count + "behind the last GLB chunk");
    expectDrawn(glbWith(text, binary, 0, 0) + junk, "the GLB header declares");
  }
}

}  // namespace
}  // namespace restlab
