// Files that break a rule of glTF and leave no doubt about what they mean are drawn, with a
// warning.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

std::string u32(size_t number) {
  const auto value = static_cast<uint32_t>(number);
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

// A material that shows the image of this URI.
void addTexture(GltfBuilder& file, const std::string& uri) {
  file.add("images", {{"uri", uri}});
  file.add("textures", {{"source", 0}});
  file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
}

TEST(GltfLenient, RawPercentSignsOfNames) {
  for (const auto& [name, uri] : {std::pair("50%.png", "50%.png"),
                                  {"%.png", "%.png"},
                                  {"a%2.png", "a%2.png"},
                                  {"100%", "100%"},
                                  {"5%zz b.png", "5%zz%20b.png"},
                                  {"50%25.png", "50%25.png"}}) {
    GltfBuilder file;
    file.directory().write(name, test::tinyPng());
    addTexture(file, uri);
    const Scene scene = file.load();
    EXPECT_EQ(scene.images.size(), 1u) << uri;
    EXPECT_TRUE(warns(scene, "a percent sign that is not escaped")) << uri;
  }
  // A name that is escaped by the rules is tried first, and without a word.
  GltfBuilder file;
  file.directory().write("50%.png", test::tinyPng());
  addTexture(file, "50%25.png");
  EXPECT_FALSE(warns(file.load(), "percent"));
}

TEST(GltfLenient, Base64AsBrowsersTakeIt) {
  const std::string text = test::base64(test::tinyPng());
  std::string escaped, urlSafe, broken = text;
  for (const char c : text) {
    escaped += c == '+' ? "%2B" : c == '/' ? "%2f" : c == '=' ? "%3D" : std::string(1, c);
    urlSafe += c == '+' ? '-' : c == '/' ? '_' : c;
  }
  ASSERT_NE(escaped, text);
  broken.insert(40, "\r\n  ");
  const std::string label = "data:image/png;base64,";
  for (const std::string& uri :
       {label + escaped, label + urlSafe, label + broken, "data:image/png;BASE64," + text,
        "DATA:image/png; Base64," + text}) {
    GltfBuilder file;
    addTexture(file, uri);
    const Scene scene = file.load();
    ASSERT_EQ(scene.images.size(), 1u) << uri;
    EXPECT_EQ(scene.images[0].texels.at(0), 0xff0000ffu) << uri;
    EXPECT_TRUE(warns(scene, "base64")) << uri;
  }
  GltfBuilder file;
  addTexture(file, label + text);
  EXPECT_FALSE(warns(file.load(), "base64"));
  file.doc["images"][0]["uri"] = label + "%00" + text;
  EXPECT_NE(file.error().find("invalid base64"), std::string::npos);
}

// A GLB of both chunks; each with as many bytes of padding in its length and behind it.
std::string glbWith(const std::string& text, const std::string& binary, size_t inLength,
                    size_t behind, int lengthError = 0) {
  std::string body;
  for (const auto& [type, data] : {std::pair(size_t(0x4e4f534a), text), {0x004e4942, binary}}) {
    const char pad = type == 0x4e4f534a ? ' ' : '\0';
    body += u32(data.size() + inLength) + u32(type) + data + std::string(inLength + behind, pad);
  }
  return "glTF" + u32(2) + u32(size_t(12 + int(body.size()) + lengthError)) + body;
}

TEST(GltfLenient, GlbChunksOfAnyLength) {
  const json doc = {
      {"asset", {{"version", "2.0"}}},
      {"buffers", json::array({{{"byteLength", 36}}})},
      {"bufferViews", json::array({{{"buffer", 0}, {"byteLength", 36}}})},
      {"accessors",
       json::array({{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}})},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"nodes", json::array({{{"mesh", 0}}})},
      {"scenes", json::array({{{"nodes", {0}}}})}};
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string binary(reinterpret_cast<const char*>(corners), sizeof corners);
  test::TempDirectory directory;
  const auto load = [&](const std::string& bytes) {
    return loadGltf(directory.write("a.glb", bytes));
  };
  for (size_t blanks = 0; blanks < 4; ++blanks) {
    const std::string text = doc.dump() + std::string(blanks, ' ');
    const size_t missing = (4 - text.size() % 4) % 4;
    const bool isWhole = missing == 0;
    // Without padding; with the padding behind the length.
    for (const size_t behind : {size_t(0), missing}) {
      const Scene scene = load(glbWith(text, binary, 0, behind));
      ASSERT_EQ(scene.instances.size(), 1u);
      EXPECT_EQ(scene.geometries[0].positions[1].x, 1.0f);
      EXPECT_EQ(warns(scene, "a multiple of 4 expected"), !isWhole);
    }
    const Scene scene = load(glbWith(text, binary, missing, 0));
    EXPECT_EQ(warns(scene, "GLB chunk 0: has"), false);
  }
  // Lengths of the header that count the padding in or leave it out.
  for (const int error : {-3, -1, 2, 3}) {
    std::string text = doc.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const Scene scene = load(glbWith(text, binary, 0, 0, error));
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(warns(scene, "the GLB header declares")) << error;
  }
  EXPECT_THROW(load(glbWith(doc.dump(), binary, 40, 0).substr(0, 400)), Error);
}

TEST(GltfLenient, NullAndUselessNumbersOfWhatIsNotRead) {
  const json perspective = {{"yfov", 1.0}, {"znear", 0.1}};
  for (const auto& [key, value] : {std::pair("zfar", json()),
                                   {"zfar", json(-1)},
                                   {"zfar", json(0)},
                                   {"zfar", json(1e300)},
                                   {"zfar", json("far")},
                                   {"znear", json()},
                                   {"znear", json(0)},
                                   {"znear", json(-0.1)},
                                   {"aspectRatio", json()},
                                   {"aspectRatio", json(0)},
                                   {"aspectRatio", json(-2)}}) {
    GltfBuilder file;
    json fields = perspective;
    fields[key] = value;
    file.add("cameras", {{"type", "perspective"}, {"perspective", fields}});
    file.node({{"camera", 0}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_DOUBLE_EQ(scene.cameras[0].yfov, 1.0);
    EXPECT_TRUE(warns(scene, std::string("cameras[0].perspective.") + key)) << key << value;
  }
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}, {"camera", json()}, {"skin", json()}, {"name", 5}});
  file.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 2}}}});
  file.node({{"camera", 0}});
  file.doc["extensionsUsed"] = {"KHR_lights_punctual"};
  file.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"range", 0}, {"intensity", 2}}};
  file.add("samplers", {{"minFilter", 1}, {"name", json()}});
  file.write();  // makes the buffer and its view
  file.doc["accessors"][0]["min"] = {nullptr, 0, 0};
  file.doc["bufferViews"][0]["target"] = 7;
  const Scene scene = file.load();
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.cameras.at(0).ymag, 2.0);
  for (const char* place : {"nodes[0].camera: is null", "nodes[0].name: is an integer",
                            "cameras[0].orthographic: 'zfar' is missing", "lights[0].range: 0",
                            "samplers[0].minFilter: 1", "samplers[0].name: is null",
                            "accessors[0].min[0]: is null", "bufferViews[0].target: 7"})
    EXPECT_TRUE(warns(scene, place)) << place;
  // A number that is read is refused all the same.
  file.doc["cameras"][0]["orthographic"]["ymag"] = nullptr;
  EXPECT_EQ(file.error(), "cameras[0].orthographic.ymag: is null; a number expected");
  file.doc["cameras"][0]["orthographic"]["ymag"] = 1;
  file.doc["nodes"][0]["translation"] = {0, nullptr, 0};
  EXPECT_EQ(file.error(), "nodes[0].translation[1]: is null; a number expected");
}

}  // namespace
}  // namespace restlab
