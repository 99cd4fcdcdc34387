// Triangles and vertex attributes of glTF primitives.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0};

TEST(GltfGeometry, ListWithEachIndexType) {
  for (int type = 0; type < 3; ++type) {
    GltfBuilder file;
    const int positions = file.accessor(kSquare, "VEC3");
    const int indices = type == 0   ? file.accessor<uint8_t>({0, 1, 2, 1, 3, 2}, "SCALAR")
                        : type == 1 ? file.accessor<uint16_t>({0, 1, 2, 1, 3, 2}, "SCALAR")
                                    : file.accessor<uint32_t>({0, 1, 2, 1, 3, 2}, "SCALAR");
    file.node(
        {{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
    const Scene scene = file.load();
    ASSERT_EQ(scene.geometries.size(), 1u);
    const MeshGeometry& geometry = scene.geometries[0];
    EXPECT_EQ(geometry.positions.size(), 4u) << "the vertex that no triangle uses is left out";
    ASSERT_EQ(geometry.triangles.size(), 2u);
    EXPECT_EQ(geometry.triangles[1], glm::uvec3(1, 3, 2));
    EXPECT_TRUE(geometry.normals.empty()) << "flat";
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  }
}

// All triangles of a strip or fan in the plane z = 0 must face +Z if the first one does.
void expectFacing(const MeshGeometry& geometry, size_t count) {
  ASSERT_EQ(geometry.triangles.size(), count);
  for (const glm::uvec3& t : geometry.triangles) {
    const glm::vec3 normal = glm::cross(geometry.positions[t.y] - geometry.positions[t.x],
                                        geometry.positions[t.z] - geometry.positions[t.x]);
    EXPECT_GT(normal.z, 0.0f) << t.x << " " << t.y << " " << t.z;
  }
}

TEST(GltfGeometry, StripKeepsItsWinding) {
  GltfBuilder file;
  const int positions =
      file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, "VEC3");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}})}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.geometries.size(), 1u);
  expectFacing(scene.geometries[0], 4);
  EXPECT_EQ(scene.geometries[0].triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(scene.geometries[0].triangles[1], glm::uvec3(1, 3, 2));
}

TEST(GltfGeometry, StitchedStripLeavesOutEmptyTriangles) {
  GltfBuilder file;
  const int positions = file.accessor(kSquare, "VEC3");
  const int indices = file.accessor<uint16_t>({0, 1, 2, 2, 1, 1, 3, 4}, "SCALAR");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}},
                                 {"indices", indices},
                                 {"mode", 5}})}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.geometries.size(), 1u);
  expectFacing(scene.geometries[0], 2);
}

TEST(GltfGeometry, FanEndsAtItsFirstVertex) {
  GltfBuilder file;
  const int positions =
      file.accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0}, "VEC3");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 6}})}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.geometries.size(), 1u);
  expectFacing(scene.geometries[0], 3);
  EXPECT_EQ(scene.geometries[0].triangles[2], glm::uvec3(3, 4, 0));
}

TEST(GltfGeometry, PointsAndLinesAreSkippedAndCounted) {
  GltfBuilder file;
  const int positions = file.accessor(kSquare, "VEC3");
  const json attributes = {{"POSITION", positions}};
  json primitives = json::array();
  for (int mode = 0; mode < 4; ++mode)
    primitives.push_back({{"attributes", attributes}, {"mode", mode}});
  file.node({{"mesh", file.add("meshes", {{"primitives", primitives}})}});
  file.node({{"mesh", file.triangle()}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.skippedPrimitives, 4u);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(warns(scene, "meshes[0].primitives[0]: points are not drawn"));
  EXPECT_TRUE(warns(scene, "meshes[0].primitives[3]: lines are not drawn"));
}

TEST(GltfGeometry, InterleavedAttributes) {
  GltfBuilder file;
  // Position, normal, uv: 32 bytes per vertex.
  const std::vector<float> vertices = {0, 0, 0, 0, 0, 1, 0.0f, 0.0f,   //
                                       1, 0, 0, 0, 1, 0, 0.5f, 0.25f,  //
                                       0, 1, 0, 1, 0, 0, 0.0f, 0.75f};
  const int view = file.bufferView(vertices.data(), vertices.size() * sizeof(float));
  file.doc["bufferViews"][size_t(view)]["byteStride"] = 32;
  const int position = file.addAccessor(view, 0, 3, 5126, "VEC3");
  const int normal = file.addAccessor(view, 12, 3, 5126, "VEC3");
  const int uv = file.addAccessor(view, 24, 3, 5126, "VEC2");
  file.node({{"mesh", file.mesh({{"attributes",
                                  {{"POSITION", position},
                                   {"NORMAL", normal},
                                   {"TEXCOORD_0", uv},
                                   {"TEXCOORD_1", uv}}}})}});
  const Scene scene = file.load();
  const MeshGeometry& geometry = scene.geometries.at(0);
  EXPECT_EQ(geometry.positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(geometry.normals[1], glm::vec3(0, 1, 0));
  EXPECT_EQ(geometry.uvs[0][2], glm::vec2(0, 0.75f));
  EXPECT_EQ(geometry.uvs[1][1], glm::vec2(0.5f, 0.25f));
  EXPECT_TRUE(geometry.uvs[2].empty());
}

TEST(GltfGeometry, SparseWithAndWithoutBufferView) {
  for (const bool withView : {true, false}) {
    GltfBuilder file;
    const int base = file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const std::vector<uint16_t> indices = {1, 2};
    const std::vector<float> values = {5, 0, 0, 0, 7, 0};
    json& accessor = file.doc["accessors"][size_t(base)];
    accessor["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", file.bufferView(indices.data(), 4)}, {"componentType", 5123}}},
        {"values", {{"bufferView", file.bufferView(values.data(), 24)}}}};
    if (!withView) {
      accessor.erase("bufferView");
      accessor.erase("byteOffset");
    }
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", base}}}})}});
    const Scene scene = file.load();
    const MeshGeometry& geometry = scene.geometries.at(0);
    EXPECT_EQ(geometry.positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(geometry.positions[1], glm::vec3(5, 0, 0));
    EXPECT_EQ(geometry.positions[2], glm::vec3(0, 7, 0));
  }
}

TEST(GltfGeometry, QuantizedAndNormalized) {
  GltfBuilder file;
  file.doc["extensionsUsed"] = {"KHR_mesh_quantization"};
  file.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
  // Vertex data must begin at multiples of four bytes.
  const std::vector<int16_t> positions = {0, 0, 0, 0, 100, 0, 0, 0, -32768, 32767, 0, 0};
  const std::vector<int8_t> normals = {0, 0, 127, 0, 0, 127, 0, 0, -128, 0, 0, 0};
  const std::vector<uint8_t> uvs = {0, 255, 0, 0, 51, 0, 0, 0, 255, 102, 0, 0};
  const auto strided = [&](const void* bytes, size_t size, int stride) {
    const int view = file.bufferView(bytes, size);
    file.doc["bufferViews"][size_t(view)]["byteStride"] = stride;
    return view;
  };
  const int p = file.addAccessor(strided(positions.data(), 24, 8), 0, 3, 5122, "VEC3");
  const int n = file.addAccessor(strided(normals.data(), 12, 4), 0, 3, 5120, "VEC3", true);
  const int t = file.addAccessor(strided(uvs.data(), 12, 4), 0, 3, 5121, "VEC2", true);
  const int t1 = file.addAccessor(strided(uvs.data(), 12, 4), 0, 3, 5121, "VEC2");
  file.node(
      {{"mesh",
        file.mesh({{"attributes",
                    {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", t}, {"TEXCOORD_1", t1}}}})}});
  const Scene scene = file.load();
  const MeshGeometry& geometry = scene.geometries.at(0);
  EXPECT_EQ(geometry.positions[1], glm::vec3(100, 0, 0));
  EXPECT_EQ(geometry.positions[2], glm::vec3(-32768, 32767, 0));
  EXPECT_EQ(geometry.normals[1], glm::vec3(0, 1, 0));
  EXPECT_EQ(geometry.normals[2], glm::vec3(-1, 0, 0)) << "-128 is -1 as -127 is";
  EXPECT_FLOAT_EQ(geometry.uvs[0][1].x, 0.2f);
  EXPECT_FLOAT_EQ(geometry.uvs[0][2].y, 0.4f);
  EXPECT_EQ(geometry.uvs[1][2], glm::vec2(255, 102)) << "not normalised";
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfGeometry, ColorsWithAndWithoutAlpha) {
  GltfBuilder file;
  const int rgb = file.accessor<float>({0.25f, 0.5f, 1, 0, 0, 0, 1, 1, 1.5f}, "VEC3");
  const int rgba =
      file.accessor<uint16_t>({65535, 0, 0, 32768, 0, 0, 0, 0, 0, 0, 0, 65535}, "VEC4", true);
  file.node({{"mesh", file.triangle({{"attributes", {{"COLOR_0", rgb}}}})}});
  file.node({{"mesh", file.triangle({{"attributes", {{"COLOR_0", rgba}}}})}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.geometries.size(), 2u);
  EXPECT_EQ(scene.geometries[0].colors[0], glm::vec4(0.25f, 0.5f, 1, 1));
  EXPECT_EQ(scene.geometries[0].colors[2], glm::vec4(1)) << "clamped";
  EXPECT_TRUE(warns(scene, "COLOR_0: 1 of 3 colours are outside 0 to 1"));
  EXPECT_FLOAT_EQ(scene.geometries[1].colors[0].a, 32768.0f / 65535.0f);
}

TEST(GltfGeometry, NormalsAndTangentsAreMadeUnit) {
  GltfBuilder file;
  const int normals = file.accessor<float>({0, 0, 2, 0, 0, 0, 0, 0, 1}, "VEC3");
  const int tangents = file.accessor<float>({3, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0, 0}, "VEC4");
  file.node(
      {{"mesh", file.triangle({{"attributes", {{"NORMAL", normals}, {"TANGENT", tangents}}}})}});
  const Scene scene = file.load();
  const MeshGeometry& geometry = scene.geometries.at(0);
  for (const glm::vec3& normal : geometry.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(geometry.tangents[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(geometry.tangents[1].w, -1.0f);
  EXPECT_TRUE(warns(scene, "NORMAL: 1 of 3 normals have no length"));
  EXPECT_TRUE(warns(scene, "NORMAL: 1 of 3 normals are not of unit length"));
  EXPECT_TRUE(warns(scene, "TANGENT: 1 of 3 handedness values"));
}

TEST(GltfGeometry, TangentsWithoutDirectionAreLeftOut) {
  GltfBuilder file;
  const int tangents = file.accessor<float>({1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
  const int normals = file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.node(
      {{"mesh", file.triangle({{"attributes", {{"NORMAL", normals}, {"TANGENT", tangents}}}})}});
  const Scene scene = file.load();
  EXPECT_TRUE(scene.geometries.at(0).tangents.empty());
  EXPECT_TRUE(warns(scene, "TANGENT: vertex 1 has no tangent direction"));
}

TEST(GltfGeometry, TangentsWithoutNormalsAreIgnored) {
  GltfBuilder file;
  const int tangents = file.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
  file.node({{"mesh", file.triangle({{"attributes", {{"TANGENT", tangents}}}})}});
  EXPECT_TRUE(file.load().geometries.at(0).tangents.empty());
}

TEST(GltfGeometry, SharedMeshesAreInstanced) {
  GltfBuilder file;
  const int mesh = file.triangle({{"material", 0}});
  file.add("materials", {{"name", "a"}});
  file.add("materials", {{"name", "b"}});
  // Another mesh of the same accessors with another material also shares the geometry.
  json same = file.doc["meshes"][size_t(mesh)]["primitives"][0];
  same["material"] = 1;
  const int other = file.mesh(same);
  file.node({{"mesh", mesh}});
  file.node({{"mesh", mesh}, {"translation", {0, 0, 5}}});
  file.node({{"mesh", other}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.geometries.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[1].objectToWorld[3], glm::dvec4(0, 0, 5, 1));
  EXPECT_EQ(scene.instances[1].material, 0u);
  EXPECT_EQ(scene.instances[2].material, 1u);
}

TEST(GltfGeometry, BinaryChunkAndDataUriHoldTheSameBuffer) {
  GltfBuilder file;
  file.node({{"mesh", file.triangle()}});
  const std::string escaped = [&] {  // every byte as %XX
    std::string text;
    for (const unsigned char c : file.bytes()) {
      text += std::string("%") + "0123456789abcdef"[c >> 4] + "0123456789abcdef"[c & 15];
    }
    return text;
  }();
  json buffer = {{"byteLength", file.bytes().size()}};
  file.doc["buffers"] = json::array({buffer});
  // A binary chunk may be padded beyond the buffer.
  file.directory().write("a.glb", test::glb(file.doc.dump(), file.bytes() + "pad"));
  const Scene binary = loadGltf(file.directory().path() / "a.glb");
  EXPECT_EQ(binary.geometries.at(0).positions[1], glm::vec3(1, 0, 0));
  for (const std::string& data : {";base64," + test::base64(file.bytes()), "," + escaped}) {
    file.doc["buffers"][0]["uri"] = "data:application/octet-stream" + data;
    const Scene embedded = file.load();
    EXPECT_EQ(embedded.geometries.at(0).positions, binary.geometries[0].positions);
    EXPECT_TRUE(embedded.warnings.empty()) << embedded.warnings[0];
  }
}

TEST(GltfGeometry, ManyLikeWarningsBecomeOneLine) {
  GltfBuilder file;
  const int positions = file.accessor(kSquare, "VEC3");
  for (int i = 0; i < 10; ++i) {
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 0}})}});
  }
  file.node({{"mesh", file.triangle()}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.warnings.size(), 5u);
  EXPECT_TRUE(warns(scene, "... and 6 more like the line before"));
}

TEST(GltfGeometry, IncompleteTrianglesWarn) {
  GltfBuilder file;
  const int positions = file.accessor(kSquare, "VEC3");  // five vertices
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}})}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.geometries.at(0).triangles.size(), 1u);
  EXPECT_TRUE(warns(scene, "5 vertices do not make whole triangles; the last 2 are left out"));
}

}  // namespace
}  // namespace restlab
