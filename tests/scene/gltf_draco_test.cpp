// KHR_draco_mesh_compression: what is decoded, and streams that lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "core/base/error.h"
#include "tests/scene/corpus.h"
#include "tests/scene/draco_encode.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::DracoInput;
using test::GltfBuilder;

constexpr const char* kDraco = "KHR_draco_mesh_compression";
const std::string kDracoPlace = std::string("meshes[0].primitives[0].extensions.") + kDraco;

// A file whose only primitive is the compressed mesh.
struct DracoFile {
  explicit DracoFile(const std::string& stream, const DracoInput& input) {
    file.doc["extensionsUsed"] = {kDraco};
    file.doc["extensionsRequired"] = {kDraco};
    const int view = file.bufferView(stream.data(), stream.size());
    const size_t vertices = input.positions.size() / 3;
    const auto accessor = [&](int componentType, size_t count, const char* type, bool normalized) {
      return file.add("accessors", {{"componentType", componentType},
                                    {"count", count},
                                    {"type", type},
                                    {"normalized", normalized}});
    };
    const int indices = accessor(5125, input.triangles.size(), "SCALAR", false);
    primitive = {
        {"indices", indices},
        {"attributes", {{"POSITION", accessor(5126, vertices, "VEC3", false)}}},
        {"extensions", {{kDraco, {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}};
    if (!input.normals.empty()) {
      primitive["attributes"]["NORMAL"] = accessor(5126, vertices, "VEC3", false);
      extension()["attributes"]["NORMAL"] = 1;
    }
    if (!input.colors.empty()) {
      primitive["attributes"]["COLOR_0"] = accessor(5123, vertices, "VEC4", true);
      extension()["attributes"]["COLOR_0"] = 2;
    }
  }

  json& extension() { return primitive["extensions"][kDraco]; }
  json& accessorOf(const char* attribute) {
    return file.doc["accessors"][primitive["attributes"][attribute].get<size_t>()];
  }
  json& indices() { return file.doc["accessors"][primitive["indices"].get<size_t>()]; }

  Scene load() {
    place();
    return file.load();
  }
  std::string error() {
    place();
    return file.error();
  }
  void place() {
    if (file.doc.contains("meshes")) file.doc.erase("meshes");
    file.mesh(primitive);
    if (!file.doc.contains("nodes")) file.node({{"mesh", 0}});
  }

  GltfBuilder file;
  json primitive;
};

DracoFile gridFile(bool isSequential) {
  const DracoInput grid = test::dracoGrid(4);
  return DracoFile(test::dracoMesh(grid, isSequential), grid);
}

// Corners of every triangle, each triangle beginning with its smallest corner.
std::set<std::array<std::array<int, 3>, 3>> cornersOf(const std::vector<glm::vec3>& positions,
                                                      const std::vector<glm::uvec3>& triangles) {
  std::set<std::array<std::array<int, 3>, 3>> all;
  for (const glm::uvec3& triangle : triangles) {
    std::array<std::array<int, 3>, 3> corners;
    for (int c = 0; c < 3; ++c) {
      for (int axis = 0; axis < 3; ++axis)
        corners[size_t(c)][size_t(axis)] = int(std::lround(256 * positions[triangle[c]][axis]));
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.insert(corners);
  }
  return all;
}

TEST(GltfDraco, SequentialMeshesKeepEveryBit) {
  DracoFile file = gridFile(true);
  const Scene scene = file.load();
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  const MeshGeometry& mesh = scene.geometries.at(0);
  const DracoInput grid = test::dracoGrid(4);
  ASSERT_EQ(mesh.positions.size(), 25u);
  ASSERT_EQ(mesh.triangles.size(), 32u);
  for (size_t i = 0; i < 25; ++i) {
    EXPECT_EQ(mesh.positions[i], glm::vec3(grid.positions[3 * i], grid.positions[3 * i + 1], 0.0f));
    EXPECT_EQ(mesh.normals[i], glm::vec3(0, 0, 1));
    EXPECT_NEAR(mesh.colors[i].x, grid.colors[4 * i] / 65535.0f, 1e-6f);
  }
  for (size_t i = 0; i < 32; ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(mesh.triangles[i][c], grid.triangles[3 * i + size_t(c)]) << i;
  }
}

TEST(GltfDraco, EdgebreakerMeshesKeepTheirTriangles) {
  DracoFile file = gridFile(false);
  const Scene scene = file.load();
  const MeshGeometry& mesh = scene.geometries.at(0);
  const DracoInput grid = test::dracoGrid(4);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (size_t i = 0; i < grid.positions.size(); i += 3)
    positions.emplace_back(grid.positions[i], grid.positions[i + 1], grid.positions[i + 2]);
  for (size_t i = 0; i < grid.triangles.size(); i += 3)
    triangles.emplace_back(grid.triangles[i], grid.triangles[i + 1], grid.triangles[i + 2]);
  EXPECT_EQ(cornersOf(mesh.positions, mesh.triangles), cornersOf(positions, triangles));
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    // Colours are the position: attributes of a vertex stay together.
    EXPECT_NEAR(mesh.colors[i].x, mesh.positions[i].x, 1e-3f);
    EXPECT_NEAR(mesh.colors[i].y, mesh.positions[i].y, 1e-3f);
    EXPECT_NEAR(mesh.normals[i].z, 1.0f, 1e-2f);
  }
}

TEST(GltfDraco, PrimitivesShareStreamsAndFallBackToNothing) {
  // Two primitives of one stream are one geometry; accessors with data of their own keep it.
  DracoFile file = gridFile(true);
  const int fallback = file.file.accessor<float>(std::vector<float>(75, 5.0f), "VEC3");
  file.primitive["attributes"]["POSITION"] = fallback;
  json other = file.primitive;
  other["material"] = 0;
  json plain = {{"attributes", {{"POSITION", fallback}}}};
  file.file.add("materials", json::object());
  file.file.add("meshes", {{"primitives", {file.primitive, other, plain}}});
  file.file.node({{"mesh", 0}});
  const Scene scene = file.file.load();
  ASSERT_EQ(scene.geometries.size(), 2u);
  EXPECT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.geometries[0].positions[1], glm::vec3(0.25f, 0.0f, 0.0f));
  EXPECT_EQ(scene.geometries[1].positions[0], glm::vec3(5.0f)) << "not compressed";
}

TEST(GltfDraco, CountsAreThoseOfTheStream) {
  for (const bool isSequential : {true, false}) {
    DracoFile file = gridFile(isSequential);
    file.indices()["count"] = 93;
    EXPECT_EQ(file.error(),
              "meshes[0].primitives[0].indices: accessors[0] has 93 elements, but the Draco mesh "
              "has 96 indices; the same number expected");
    file.indices()["count"] = 96;
    file.accessorOf("NORMAL")["count"] = 24;
    EXPECT_EQ(file.error(), kDracoPlace +
                                ".attributes.NORMAL: accessors[2] has 24 elements, but the Draco "
                                "mesh has 25 vertices; the same number expected");
  }
}

TEST(GltfDraco, AttributesAreThoseOfTheStream) {
  {
    DracoFile file = gridFile(false);
    file.extension()["attributes"]["NORMAL"] = 7;
    EXPECT_EQ(file.error(), kDracoPlace +
                                ".attributes.NORMAL: 7 is not the id of an attribute of the Draco "
                                "mesh; one of 0, 1, 2 expected");
  }
  {
    DracoFile file = gridFile(false);
    file.extension()["attributes"]["NORMAL"] = 2;
    EXPECT_EQ(file.error(), kDracoPlace +
                                ".attributes.NORMAL: accessors[2] has 3 components, but "
                                "attribute 2 of the Draco mesh has 4");
  }
  {
    DracoFile file = gridFile(false);
    file.accessorOf("COLOR_0")["componentType"] = 5126;
    file.accessorOf("COLOR_0")["normalized"] = false;
    EXPECT_NE(file.error().find("COLOR_0: accessors[3] cannot hold attribute 2 of the Draco mesh"),
              std::string::npos)
        << file.error();
  }
  {
    DracoFile file = gridFile(false);
    file.accessorOf("COLOR_0")["componentType"] = 5121;
    EXPECT_NE(file.error().find("(integer of 2 bytes)"), std::string::npos) << file.error();
  }
  {
    DracoFile file = gridFile(false);
    file.primitive["attributes"].erase("NORMAL");
    EXPECT_NE(file.error().find(".attributes.NORMAL: is not an attribute of the primitive"),
              std::string::npos)
        << file.error();
  }
  {
    DracoFile file = gridFile(false);
    file.extension()["attributes"]["NORMAL"] = -1;
    EXPECT_NE(file.error().find("NORMAL: -1 is out of range"), std::string::npos) << file.error();
  }
  {
    DracoFile file = gridFile(false);
    file.extension()["attributes"] = json::object();
    EXPECT_NE(file.error().find(".attributes: is empty"), std::string::npos) << file.error();
  }
}

TEST(GltfDraco, PrimitivesAreListsOfIndexedTriangles) {
  DracoFile file = gridFile(false);
  file.primitive["mode"] = 5;
  EXPECT_NE(file.error().find("meshes[0].primitives[0].mode: 5 is not read beside"),
            std::string::npos)
      << file.error();
  file.primitive["mode"] = 4;
  file.primitive.erase("indices");
  EXPECT_NE(file.error().find("meshes[0].primitives[0]: has no indices"), std::string::npos)
      << file.error();
  DracoFile real = gridFile(false);
  real.indices()["componentType"] = 5126;
  EXPECT_NE(real.error().find("unsigned integer scalars expected"), std::string::npos)
      << real.error();
  DracoInput large = test::dracoGrid(16);  // 289 vertices do not fit into bytes
  DracoFile narrow(test::dracoMesh(large, true), large);
  narrow.indices()["componentType"] = 5121;
  EXPECT_NE(narrow.error().find("cannot hold the index 256 of the Draco mesh"), std::string::npos)
      << narrow.error();
}

TEST(GltfDraco, OtherStreams) {
  const DracoInput grid = test::dracoGrid(4);
  EXPECT_EQ(DracoFile(test::dracoPointCloud(grid), grid).error(),
            kDracoPlace + ": bufferViews[0] holds a Draco point cloud; a mesh expected");
  EXPECT_NE(DracoFile("no mesh of Draco", grid).error().find("is damaged (it does not begin with"),
            std::string::npos);
  std::string old = test::dracoMesh(grid, false);
  old[6] = 1;
  EXPECT_NE(DracoFile(old, grid).error().find("has version 2.1 of the bitstream; 2.2 expected"),
            std::string::npos);
  std::string other = test::dracoMesh(grid, false);
  other[8] = 9;
  EXPECT_NE(DracoFile(other, grid).error().find("an encoding that does not exist"),
            std::string::npos);
}

// A stream that claims so many triangles, and accessors that agree: nothing may be allocated for
// them.
TEST(GltfDraco, ClaimsAreBoundedBeforeMemoryIsTaken) {
  DracoInput grid = test::dracoGrid(4);
  std::string stream = test::dracoMesh(grid, false);
  // Behind the header of 11 bytes and the kind of traversal: vertices, triangles.
  ASSERT_EQ(stream[12], 25);
  ASSERT_EQ(stream[13], 32);
  stream.replace(13, 1, "\xff\xff\xff\x7f", 4);  // 2^28 - 1 triangles
  DracoFile file(stream, grid);
  file.indices()["count"] = 3u * ((1u << 28) - 1);
  EXPECT_NE(file.error().find("decoding the Draco mesh in bufferViews[0] takes"), std::string::npos)
      << file.error();
}

TEST(GltfDraco, DamagedStreamsBringOneLine) {
  std::mt19937 random(1);
  for (const bool isSequential : {true, false}) {
    const DracoInput grid = test::dracoGrid(8);
    const std::string stream = test::dracoMesh(grid, isSequential);
    for (size_t cut = 0; cut < stream.size(); cut += 7) {
      DracoFile file(stream.substr(0, cut + 1), grid);
      const std::string error = file.error();
      EXPECT_NE(error, "") << cut;
      EXPECT_EQ(error.find("wrong exit code"), std::string::npos) << error;
    }
    for (int i = 0; i < 300; ++i) {
      std::string wrong = stream;
      for (int n = 0; n <= i % 4; ++n) wrong[random() % wrong.size()] = char(random());
      DracoFile file(wrong, grid);
      EXPECT_EQ(file.error().find("wrong exit code"), std::string::npos) << file.error();
    }
  }
}

TEST(GltfDraco, AFileOfAnotherProgram) {
  const std::filesystem::path file = test::sceneFolder() / "loader/heart-draco/heart_draco.glb";
  SKIP_WITHOUT(file.parent_path());
  const Scene scene = loadGltf(file);
  EXPECT_EQ(scene.geometries.at(0).triangles.size(), 180u);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

}  // namespace
}  // namespace restlab
