// Broken glTF files: each gives one line that names the file, the place and the fault.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/base/error.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::glb;
using test::GltfBuilder;
using test::placeAndText;

// Returns the error of loading a file with these bytes.
std::string errorOf(const std::string& name, const std::string& content) {
  test::TempDirectory directory;
  const std::filesystem::path file = directory.write(name, content);
  try {
    loadGltf(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    return placeAndText(error.what(), file);
  }
  return "";
}

void expectError(GltfBuilder& file, const std::string& expected) {
  const std::string error = file.error();
  EXPECT_NE(error.find(expected), std::string::npos) << "found: " << error;
}

TEST(GltfErrors, Files) {
  EXPECT_EQ(errorOf("a.gltf", ""), "the file is empty");
  EXPECT_EQ(errorOf("a.obj", "v 0 0 0"),
            "not a scene file; .gltf, .glb, .scene.toml or .xml expected");
  EXPECT_NE(errorOf("a.gltf", "{\"asset\": \n {\"version\" 2}}").find("line 2, column 13"),
            std::string::npos);
  EXPECT_NE(errorOf("a.gltf", "{\"asset\": {\"version\": \"2.0\"}").find("not valid JSON"),
            std::string::npos);
  EXPECT_EQ(errorOf("a.gltf", "[]"), "the document is a JSON array; an object expected");
  EXPECT_NE(errorOf("a.gltf", std::string(100000, '[')).find("nested deeper than"),
            std::string::npos);
  EXPECT_NE(
      errorOf("a.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"x\": 1e+}").find("not valid JSON"),
      std::string::npos);
  EXPECT_NE(errorOf("a.gltf", "{\"asset\": {\"version\": \"1.0\"}}").find("glTF 2.0 expected"),
            std::string::npos);
  EXPECT_THROW(loadGltf("/nonexistent/a.gltf"), Error);
  EXPECT_THROW(loadGltf("/dev/zero"), Error);
  test::TempDirectory directory;
  EXPECT_THROW(loadGltf(directory.path()), Error);
}

TEST(GltfErrors, Glb) {
  const std::string positions(36, '\0');
  json doc = {{"asset", {{"version", "2.0"}}}, {"buffers", json::array({{{"byteLength", 36}}})}};
  const std::string good = glb(doc.dump(), positions);
  EXPECT_EQ(errorOf("a.glb", good), "");
  EXPECT_NE(errorOf("a.glb", good.substr(0, good.size() - 4)).find("truncated"), std::string::npos);
  EXPECT_NE(errorOf("a.glb", good.substr(0, 10)).find("truncated"), std::string::npos);
  EXPECT_NE(errorOf("a.glb", "{}").find("not a GLB"), std::string::npos);
  EXPECT_EQ(errorOf("a.glb", glb(doc.dump(), "")),
            "buffers[0]: has no uri, and there is no GLB binary chunk");
  // The end of the file is cut off, and the chunk with it.
  EXPECT_EQ(
      errorOf("a.glb", good.substr(0, good.size() - 36 - 5)),
      "buffers[0]: has no uri, and there is no GLB binary chunk; the file ends 41 bytes before "
      "the length in its header");
  std::string version3 = good;
  version3[4] = 3;
  EXPECT_EQ(errorOf("a.glb", version3), "GLB version 3; 2 expected");
  doc["buffers"][0]["byteLength"] = 40;
  EXPECT_NE(errorOf("a.glb", glb(doc.dump(), positions)).find("40 declared"), std::string::npos);
}

TEST(GltfErrors, TypesAndReferences) {
  {
    GltfBuilder file;
    file.node({{"mesh", 3}});
    expectError(file, "nodes[0].mesh: 3 does not exist; the file has no meshes");
  }
  {
    GltfBuilder file;
    file.triangle({{"material", 1}});
    file.add("materials", json::object());
    expectError(file,
                "meshes[0].primitives[0].material: 1 does not exist; the file has "
                "materials[0] to [0]");
  }
  {
    GltfBuilder file;
    file.node({{"mesh", file.triangle()}});
    file.doc["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1;
    expectError(file, "meshes[0].primitives[0].attributes.POSITION: -1 does not exist");
  }
  {
    GltfBuilder file;
    file.node({{"translation", "up"}});
    expectError(file, "nodes[0].translation: is a string; an array of numbers expected");
  }
  {
    GltfBuilder file;
    file.node({{"rotation", {0, 0, 1}}});
    expectError(file, "nodes[0].rotation: has 3 elements; 4 expected");
  }
  {
    GltfBuilder file;
    file.add("meshes", json::object());
    expectError(file, "meshes[0]: 'primitives' is missing");
  }
  {
    GltfBuilder file;
    file.add("materials", {{"alphaMode", "MASKED"}});
    expectError(file,
                "materials[0].alphaMode: 'MASKED' is not valid; one of OPAQUE, MASK, BLEND "
                "expected; did you mean 'MASK'?");
  }
  {
    GltfBuilder file;
    file.node({{"translation", {0, 1e200, 0}}});
    expectError(file, "nodes[0].translation[1]: 1e+200 is too large for a 32-bit float");
  }
  {
    GltfBuilder file;
    file.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    expectError(file, "nodes[0].extensions.KHR_lights_punctual.light: 0 does not exist");
  }
  {
    GltfBuilder file;
    file.doc["scene"] = 2;
    file.node({{"name", "a"}});
    expectError(file, "scene: 2 does not exist");
  }
}

TEST(GltfErrors, RequiredExtensions) {
  for (const auto& [name, remedy] :
       {std::pair("KHR_texture_basisu", "PNG or JPEG expected; 'ktx extract' makes PNG of KTX2"),
        std::pair("EXT_texture_webp", "'dwebp' makes PNG of WebP"),
        std::pair("EXT_texture_avif", "'avifdec' makes PNG of AVIF"),
        std::pair("KHR_material_ior", "did you mean 'KHR_materials_ior'?"),
        std::pair("VENDOR_teapot", "without it")}) {
    GltfBuilder file;
    file.doc["extensionsUsed"] = {name};
    file.doc["extensionsRequired"] = {name};
    const std::string error = file.error();
    EXPECT_EQ(error.find(std::string("extensionsRequired[0]: ") + name + " is required"), 0u)
        << error;
    EXPECT_NE(error.find(remedy), std::string::npos) << error;
    file.doc.erase("extensionsRequired");
    EXPECT_TRUE(test::warns(file.load(), std::string(name) + " is not supported and not read"));
  }
}

// Textures of other formats: the PNG or JPEG beside them is drawn, where there is one.
TEST(GltfErrors, TexturesOfOtherFormats) {
  for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif"}) {
    GltfBuilder file;
    file.doc["extensionsUsed"] = {name};
    file.directory().write("a.png", test::tinyPng());
    file.directory().write("a.other", "another format");
    file.doc["images"] = {{{"uri", "a.png"}}, {{"uri", "a.other"}}};
    file.doc["textures"] = {{{"source", 0}, {"extensions", {{name, {{"source", 1}}}}}}};
    file.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    file.node({{"mesh", file.triangle({{"material", 0}})}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_TRUE(test::warns(scene, std::string(name) + " is not supported and not read; the PNG or "
                                                       "JPEG beside its images is drawn"));
    file.doc["textures"][0].erase("source");
    EXPECT_EQ(file.error(), std::string("textures[0].source: is missing (") + name +
                                " is not read); a PNG or JPEG expected (used by "
                                "materials[0].emissiveTexture)");
  }
}

TEST(GltfErrors, BuffersViewsAccessors) {
  const auto triangleFile = [](auto change) {
    GltfBuilder file;
    file.node({{"mesh", file.triangle()}});
    file.write();  // makes the buffer, so that `change` can modify it
    change(file.doc);
    return file.error();
  };
  EXPECT_NE(triangleFile([](json& d) {
              d["buffers"][0]["byteLength"] = 400;
            }).find("buffers[0].byteLength: 400 declared, but file 'test.bin' holds 36 bytes"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["buffers"][0]["uri"] = "tset.bin";
            }).find("did you mean 'test.bin'?"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["buffers"][0]["byteLength"] = uint64_t(1) << 50;
            }).find("declared, but"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["bufferViews"][0]["byteLength"] = 40;
            }).find("bufferViews[0]: bytes 0 to 40 reach beyond buffers[0], which has 36 bytes"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["bufferViews"][0]["byteOffset"] = 9007199254740991;
            }).find("reach beyond buffers[0]"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["count"] = 0;
            }).find("accessors[0].count: 0; at least 1 expected"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["count"] = 4;
            }).find("accessors[0]: 4 elements of 12 bytes"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["count"] = 9007199254740991;
            }).find("reach beyond bufferViews[0]"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["byteOffset"] = 4;
            }).find("reach beyond bufferViews[0]"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["bufferViews"][0]["byteStride"] = 8;
            }).find("whose byteStride is 8"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["componentType"] = 5130;
            }).find("accessors[0].componentType: 5130 is not valid"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0].erase("bufferView");
              d["accessors"][0].erase("byteOffset");
              d["accessors"][0]["count"] = 4000000000;
            }).find("4000000000 elements without a bufferView"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["type"] = "VEC4";
              d["accessors"][0]["count"] = 2;
            }).find("attributes.POSITION: accessors[0] is {VEC4, FLOAT}; {VEC3, FLOAT} expected"),
            std::string::npos);
  EXPECT_NE(triangleFile([](json& d) {
              d["accessors"][0]["sparse"] = {
                  {"count", 4},
                  {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                  {"values", {{"bufferView", 0}}}};
            }).find("accessors[0].sparse.count: 4 elements are replaced, but the accessor has 3"),
            std::string::npos);
}

// Exporters leave empty accessors behind.
TEST(GltfErrors, AccessorsWithoutElements) {
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}});
  file.doc["accessors"].push_back({{"componentType", 5126}, {"count", 0}, {"type", "SCALAR"}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("accessors[1].count: is 0"), std::string::npos)
      << scene.warnings[0];
}

TEST(GltfErrors, KeysThatStandTwice) {
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}, {"name", "one"}});
  const std::filesystem::path written = file.write();
  std::ifstream in(written);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const size_t at = text.find("\"name\":\"one\"");
  ASSERT_NE(at, std::string::npos) << text;
  text.insert(at, "\"name\":\"two\",");
  std::ofstream(written) << text;
  const Scene scene = loadGltf(written);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("name: stands twice in one object"), std::string::npos)
      << scene.warnings[0];
}

TEST(GltfErrors, IndicesOutOfRange) {
  GltfBuilder file;
  const int indices = file.accessor<uint16_t>({0, 1, 2, 0, 3, 1}, "SCALAR");
  file.triangle({{"indices", indices}});
  // Check the mesh although no node draws it.
  expectError(file,
              "meshes[0].primitives[0].indices: element 4 of accessors[0] is 3, but the "
              "primitive has 3 vertices");
}

TEST(GltfErrors, NonFiniteVerticesNameTheVertex) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  {
    GltfBuilder file;
    const int positions = file.accessor<float>({0, 0, 0, 1, 0, 0, 0, nan, 0}, "VEC3");
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}})}});
    expectError(file,
                "meshes[0].primitives[0].attributes.POSITION: component y of vertex 2 is nan");
  }
  for (const char* name : {"NORMAL", "TEXCOORD_1"}) {
    GltfBuilder file;
    const int bad = std::strcmp(name, "NORMAL") == 0
                        ? file.accessor<float>({0, 0, 1, 0, 0, infinity, 0, 0, 1}, "VEC3")
                        : file.accessor<float>({0, 0, 1, infinity, 0, 0}, "VEC2");
    file.node({{"mesh", file.triangle({{"attributes", {{name, bad}}}})}});
    expectError(file, std::string("attributes.") + name + ": component ");
    expectError(file, "of vertex 1 is inf; finite numbers expected");
  }
}

TEST(GltfErrors, AttributeCounts) {
  GltfBuilder file;
  const int normals = file.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC3");
  file.node({{"mesh", file.triangle({{"attributes", {{"NORMAL", normals}}}})}});
  expectError(file, "attributes.NORMAL: accessors[0] has 2 elements, but POSITION has 3");
}

TEST(GltfErrors, NodeTrees) {
  {
    GltfBuilder file;
    file.add("nodes", {{"children", {1}}});
    file.add("nodes", {{"children", {0}}});
    expectError(file, "the node is its own descendant; nodes form a tree");
  }
  {
    GltfBuilder file;
    file.add("nodes", {{"children", {0}}});
    expectError(file, "nodes[0].children: the node is its own descendant");
  }
  {
    GltfBuilder file;
    file.add("nodes", {{"children", {2}}});
    file.add("nodes", {{"children", {2}}});
    file.add("nodes", json::object());
    expectError(file, "nodes[1].children[0]: node 2 is already a child of nodes[0]");
  }
  {
    GltfBuilder file;
    file.node({{"children", {1}}});
    file.node({{"name", "child"}});
    expectError(file, "scenes[0].nodes[1]: node 1 is a child of nodes[0]; a root expected");
  }
  {
    GltfBuilder file;
    file.node({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1}}, {"name", "skew"}});
    expectError(file, "nodes[0] ('skew').matrix: the last row is (0, 0, 0.5, 1)");
  }
  {
    GltfBuilder file;
    file.node({{"rotation", {0, 0, 0, 0}}});
    expectError(file, "nodes[0].rotation: the quaternion has no length");
  }
  {
    GltfBuilder file;
    const int leaf = file.add("nodes", {{"scale", {1e30, 1, 1}}});
    file.node({{"children", {leaf}}, {"scale", {1e30, 1, 1}}});
    expectError(file, "nodes[0]: its transform to the world is not finite");
  }
}

TEST(GltfErrors, CamerasAndLights) {
  {
    GltfBuilder file;
    file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}});
    expectError(file, "cameras[0].perspective.yfov: 4 is out of range");
  }
  {
    GltfBuilder file;
    file.add("cameras", {{"type", "orthographic"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
    expectError(file, "cameras[0]: is of type 'orthographic', but 'orthographic' is missing");
  }
  {
    GltfBuilder file;
    file.doc["extensionsUsed"] = {"KHR_lights_punctual"};
    file.doc["extensions"]["KHR_lights_punctual"]["lights"] = json::array(
        {{{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}}});
    expectError(file, "lights[0].spot: innerConeAngle 1 exceeds outerConeAngle 0.5");
  }
}

std::string imageError(const std::string& uri, const std::string& content, bool used = true) {
  GltfBuilder file;
  if (!content.empty()) file.directory().write("image.png", content);
  file.add("images", {{"uri", uri}});
  file.add("textures", {{"source", 0}});
  if (used) {
    file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  }
  return file.error();
}

TEST(GltfErrors, Images) {
  const std::string png = test::tinyPng();
  EXPECT_EQ(imageError("image.png", png), "");
  EXPECT_NE(imageError("imge.png", png)
                .find("images[0].uri: file 'imge.png' does not exist; did you mean 'image.png'?"),
            std::string::npos);
  EXPECT_NE(imageError("image.png", png.substr(0, png.size() - 20))
                .find("images[0]: file 'image.png': truncated"),
            std::string::npos);
  EXPECT_NE(imageError("image.png", "GIF89a").find("not a PNG or JPEG image"), std::string::npos);
  EXPECT_NE(imageError("image.png", png.substr(0, 20), false).find("truncated"), std::string::npos)
      << "broken though no material uses it";
  std::string huge = png;
  huge.replace(16, 4, std::string("\x00\x01\x00\x00", 4));  // 65536 wide
  EXPECT_NE(imageError("image.png", huge).find("images[0]"), std::string::npos);
  EXPECT_NE(imageError("data:image/png;base64,!!!!", "").find("invalid base64"), std::string::npos);
  GltfBuilder file;
  file.add("textures", {{"source", 7}});
  file.add("materials", {{"emissiveTexture", {{"index", 0}}}});
  expectError(file,
              "textures[0].source: 7 does not exist; the file has 0 images (used by "
              "materials[0].emissiveTexture)");
}

}  // namespace
}  // namespace restlab
