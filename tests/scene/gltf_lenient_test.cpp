// Files that break a rule of glTF but have a clear meaning are drawn, with a warning.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

// Adds a material that shows the image of this URI.
void addImageTexture(GltfBuilder& file, const std::string& uri) {
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
    addImageTexture(file, uri);
    const Scene scene = file.load();
    EXPECT_EQ(scene.images.size(), 1u) << uri;
    EXPECT_TRUE(warns(scene, "a percent sign that is not escaped")) << uri;
  }
  // A correctly escaped name is tried first, without a warning.
  GltfBuilder file;
  file.directory().write("50%.png", test::tinyPng());
  addImageTexture(file, "50%25.png");
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
    addImageTexture(file, uri);
    const Scene scene = file.load();
    ASSERT_EQ(scene.images.size(), 1u) << uri;
    EXPECT_EQ(scene.images[0].texels.at(0), 0xff0000ffu) << uri;
    EXPECT_TRUE(warns(scene, "base64")) << uri;
  }
  GltfBuilder file;
  addImageTexture(file, label + text);
  EXPECT_FALSE(warns(file.load(), "base64"));
  ASSERT_EQ(text.back(), '=');
  file.doc["images"][0]["uri"] = label + text.substr(0, text.find('='));
  const Scene unpadded = file.load();
  EXPECT_EQ(unpadded.images.at(0).texels.at(0), 0xff0000ffu);
  EXPECT_TRUE(warns(unpadded, "images[0].uri: data URI's base64 is not padded"));
  file.doc["images"][0]["uri"] = label + "%00" + text;
  EXPECT_NE(file.error().find("invalid base64"), std::string::npos);
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
  // A null number that is read stays an error.
  file.doc["cameras"][0]["orthographic"]["ymag"] = nullptr;
  EXPECT_EQ(file.error(), "cameras[0].orthographic.ymag: is null; a number expected");
  file.doc["cameras"][0]["orthographic"]["ymag"] = 1;
  file.doc["nodes"][0]["translation"] = {0, nullptr, 0};
  EXPECT_EQ(file.error(), "nodes[0].translation[1]: is null; a number expected");
}

TEST(GltfLenient, WhatNoImageDependsOnMayBeOfAnyType) {
  struct Case {
    const char* place;  // place in the file, as a JSON pointer
    json value;
    const char* warning;
  };
  const json texture99 = {{"index", 99}};
  for (const Case& c : {
           Case{"/materials/0/occlusionTexture", texture99, "occlusionTexture.index: 99"},
           Case{"/materials/0/occlusionTexture", json::object(), "occlusionTexture: 'index'"},
           Case{"/materials/0/occlusionTexture", 5, "occlusionTexture: is an integer"},
           Case{"/materials/0/occlusionTexture",
                {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", 1}}}}}},
                "KHR_texture_transform.scale: is an integer"},
           Case{"/materials/0/extensions/KHR_materials_volume/thicknessTexture", texture99,
                "thicknessTexture.index: 99"},
           Case{"/materials/0/extensions/KHR_materials_ior", nullptr, "KHR_materials_ior: is null"},
           Case{"/materials/0/alphaCutoff", "a", "alphaCutoff: is a string"},
           Case{"/asset/minVersion", nullptr, "asset.minVersion: is null"},
           Case{"/nodes/0/skin", 3, "nodes[0].skin: 3"},
           Case{"/nodes/0/translation", "far", "nodes[0].translation: is a string"},
           Case{"/extensions/KHR_lights_punctual/lights/0/spot", 1, "spot: is an integer"},
           Case{"/extensions/SOME_other", 1, "SOME_other is not supported"},
       }) {
    GltfBuilder file;
    file.doc["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_ior",
                                  "KHR_materials_volume", "KHR_texture_transform"};
    file.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    file.add("images", {{"uri", "data:image/png;base64," + test::base64(test::tinyPng())}});
    file.add("textures", {{"source", 0}});
    file.add("materials", {{"extensions", {{"KHR_materials_volume", json::object()}}},
                           {"emissiveTexture", {{"index", 0}}}});
    const int mesh = file.triangle({{"material", 0}});
    const json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1};
    file.node({{"mesh", mesh}, {"matrix", identity}});
    file.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const size_t before = file.load().warnings.size();
    file.doc[json::json_pointer(c.place)] = c.value;
    const Scene scene = file.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].objectToWorld[3].x, 2.0);
    EXPECT_EQ(scene.materials[0].data.ior, 1.5f);
    EXPECT_TRUE(warns(scene, c.warning)) << c.place;
    EXPECT_EQ(scene.warnings.size(), before + 1) << c.place;
  }
  // The same values are errors if something reads them.
  GltfBuilder file;
  file.add("materials", {{"alphaMode", "MASK"}, {"alphaCutoff", "a"}});
  EXPECT_EQ(file.error(), "materials[0].alphaCutoff: is a string; a number expected");
  file.doc["materials"][0] = {{"normalTexture", texture99}};
  EXPECT_EQ(file.error(),
            "materials[0].normalTexture.index: 99 does not exist; the file has no textures");
  file.doc["materials"][0] = {{"extensions", {{"KHR_materials_ior", 5}}}};
  EXPECT_EQ(file.error(),
            "materials[0].extensions.KHR_materials_ior: is an integer; an object expected");
  file.doc["materials"][0] = json::object();
  file.node({{"translation", "far"}});
  EXPECT_EQ(file.error(), "nodes[0].translation: is a string; an array of numbers expected");
}

// JSON numbers beyond a double are refused if something reads them.
TEST(GltfLenient, NumbersBeyondADouble) {
  test::TempDirectory directory;
  const auto document = [&](const std::string& yfov, const std::string& zfar) {
    return directory.write("a.gltf",
                           R"({"asset": {"version": "2.0", "generator": "1e999, \"-1e999"},
  "cameras": [{"type": "perspective", "extras": {"a": [1e999, -2e999, 3]},
               "perspective": {"yfov": )" +
                               yfov + R"(, "znear": 1e-999, "zfar": )" + zfar +
                               R"(}}], "nodes": [{"camera": 0}], "scenes": [{"nodes": [0]}]})");
  };
  const std::string digits(400, '9');
  for (const std::string& zfar : {std::string("1e400"), std::string("-12.5E+00999"), digits,
                                  "-" + digits + ".5", "0.1" + digits + "e310"}) {
    const Scene scene = loadGltf(document("0.5", zfar));
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].yfov, 0.5);
    EXPECT_TRUE(warns(scene, "perspective.zfar: a number of 1e308 or more is too large")) << zfar;
  }
  const auto errorOf = [&](const std::string& yfov) {
    const auto file = document(yfov, "1");
    try {
      loadGltf(file);
    } catch (const Error& error) {
      return test::placeAndText(error.what(), file);
    }
    return std::string();
  };
  EXPECT_EQ(
      errorOf("1e400"),
      "cameras[0].perspective.yfov: a number of 1e308 or more is too large for a 32-bit float");
  for (const char* wrong : {"1e", "1e999.5", "01e999", "NaN", "Infinity", "- 1e999"})
    EXPECT_NE(errorOf(wrong).find("not valid JSON"), std::string::npos) << wrong;
}

}  // namespace
}  // namespace restlab
