// Meshes of Mitsuba's scenes: what is read of OBJ, PLY and serialized files, and which are refused.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "core/scene/mitsuba/mesh_files.h"
#include "core/scene/shapes/fine_meshes.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/scene/mesh_checks.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab {
namespace {

class MitsubaMeshes : public ::testing::Test {
 protected:
  Scene loadMesh(const std::string& type, const std::string& content,
                 const std::string& more = "") {
    folder_.write("m." + type, content);
    return folder_.load(shapeOf(type, more));
  }
  std::string errorOf(const std::string& type, const std::string& content,
                      const std::string& more = "") {
    folder_.write("m." + type, content);
    return folder_.error(shapeOf(type, more));
  }
  static std::string shapeOf(const std::string& type, const std::string& more) {
    return "<shape type=\"" + type + "\"><string name=\"filename\" value=\"m." + type + "\"/>" +
           more + "</shape>";
  }
  test::MitsubaFolder folder_;
};

constexpr const char* kObj = R"(# a square
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
)";

const MeshGeometry& first(const Scene& scene) {
  return scene.geometries.at(scene.instances.at(0).geometry);
}

TEST_F(MitsubaMeshes, ObjPolygonsBecomeTriangles) {
  const Scene scene = loadMesh("obj", kObj);
  const MeshGeometry& mesh = first(scene);
  EXPECT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  EXPECT_EQ(mesh.normals.at(0), glm::vec3(0, 0, 1));
  // The first row of an image is at v = 0 in Mitsuba, and at v = 1 of OBJ files.
  EXPECT_EQ(mesh.uvs[0].at(0), glm::vec2(0, 1));
  EXPECT_EQ(mesh.uvs[0].at(2), glm::vec2(1, 0));
  const Scene same = loadMesh("obj", kObj, "<boolean name=\"flip_tex_coords\" value=\"false\"/>");
  EXPECT_EQ(first(same).uvs[0].at(0), glm::vec2(0, 0));
  const Scene backwards = loadMesh("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
  EXPECT_EQ(first(backwards).triangles.at(0), glm::uvec3(0, 1, 2));
}

TEST_F(MitsubaMeshes, NormalsAreMadeTurnedAndLeftOut) {
  const std::string roof = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n";
  const MeshGeometry smooth = first(loadMesh("obj", roof));
  ASSERT_EQ(smooth.normals.size(), 4u);
  EXPECT_NEAR(smooth.normals[0].y, smooth.normals[0].z, 1e-6) << "the mean of two faces";
  EXPECT_EQ(smooth.normals[2], glm::vec3(0, 0, 1));
  const Scene flat = loadMesh("obj", roof, "<boolean name=\"face_normals\" value=\"true\"/>");
  EXPECT_TRUE(first(flat).normals.empty());
  const Scene flipped = loadMesh("obj", kObj, "<boolean name=\"flip_normals\" value=\"true\"/>");
  EXPECT_EQ(first(flipped).normals.at(0), glm::vec3(0, 0, -1));
  EXPECT_LT(test::worldTriangles(flipped).at(0).areaNormal().z, 0.0);
  // Faces whose normals point to their back turn over: lamps shine where normals point.
  const Scene turned = loadMesh("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n");
  EXPECT_LT(test::worldTriangles(turned).at(0).areaNormal().z, 0.0);
  const Scene wound = loadMesh("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n",
                               "<boolean name=\"face_normals\" value=\"true\"/>");
  EXPECT_GT(test::worldTriangles(wound).at(0).areaNormal().z, 0.0) << "without normals";
}

TEST_F(MitsubaMeshes, DamagedObj) {
  EXPECT_EQ(errorOf("obj", "v 0 0 0\nf 1 2 3\n"),
            "m.obj:2:5: vertex 2 does not exist; there are 1");
  EXPECT_EQ(errorOf("obj", "v 0 0\n"), "m.obj:1:6: the line ends early; a number expected");
  EXPECT_EQ(errorOf("obj", "v 0 0 nan\n"), "m.obj:1:7: 'nan' is not a finite number");
  EXPECT_EQ(errorOf("obj", "v 0 0 1e39\n"), "m.obj:1:7: '1e39' is not a finite number");
  EXPECT_EQ(errorOf("obj", "v 0 0 0\nv 1 0 0\nf 1 2\n").substr(0, 26),
            "m.obj:3:6: a face of 2 cor");
  EXPECT_NE(errorOf("obj", "v 0 0 0\nf 4294967297 1 1\n").find("does not exist"),
            std::string::npos);
  EXPECT_NE(errorOf("obj", "v 0 0 0\nf 1/1 1/1 1/1\n").find("texture coordinate 1 does not exist"),
            std::string::npos);
  EXPECT_TRUE(test::warns(loadMesh("obj", "v 0 0 0\n"), "holds no triangle"));
}

std::string plyText(const std::string& counts = "4", const std::string& faces = "1") {
  return "ply\nformat ascii 1.0\ncomment a square\nelement vertex " + counts +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float u\n"
         "property float v\nelement face " +
         faces + "\nproperty list uchar int vertex_indices\nend_header\n";
}
const std::string kPlyBody = "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n";

// The same square in binary.
std::string plyBinary(bool isBig) {
  std::string text = plyText();
  text.replace(text.find("ascii"), 5, isBig ? "binary_big_endian" : "binary_little_endian");
  const auto put = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (isBig) std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
  };
  const float corners[4][5] = {{0, 0, 0, 0, 0}, {1, 0, 0, 1, 0}, {1, 1, 0, 1, 1}, {0, 1, 0, 0, 1}};
  for (const auto& corner : corners)
    for (const float v : corner) put(v);
  put(uint8_t(4));
  for (int32_t i = 0; i < 4; ++i) put(i);
  return text;
}

TEST_F(MitsubaMeshes, PlyAsTextAndInBothOrdersOfBytes) {
  for (const std::string& content : {plyText() + kPlyBody, plyBinary(false), plyBinary(true)}) {
    const Scene scene = loadMesh("ply", content);
    const MeshGeometry& mesh = first(scene);
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh.uvs[0].at(1), glm::vec2(1, 0)) << "not turned over";
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
    EXPECT_EQ(mesh.normals.at(0), glm::vec3(0, 0, 1));
  }
}

TEST_F(MitsubaMeshes, DamagedPly) {
  EXPECT_EQ(errorOf("ply", "obj\n"), "m.ply:1:1: does not begin with 'ply'");
  EXPECT_NE(errorOf("ply", "ply\nformat ascii 1.0\n").find("'end_header' expected"),
            std::string::npos);
  EXPECT_EQ(errorOf("ply", "ply\nformat pdf 1.0\nend_header\n").substr(0, 25),
            "m.ply:2:1: format 'pdf'; ");
  EXPECT_NE(errorOf("ply", plyText("2147483648") + kPlyBody).find("2147483648 elements 'vertex'"),
            std::string::npos);
  EXPECT_NE(errorOf("ply", plyText("18446744073709551615") + kPlyBody).find("need at least"),
            std::string::npos);
  EXPECT_NE(
      errorOf("ply", plyText("99999999999999999999") + kPlyBody).find("no number of elements"),
      std::string::npos);
  EXPECT_NE(errorOf("ply", plyText("4", "2") + kPlyBody).find("the file ends early"),
            std::string::npos);
  EXPECT_EQ(errorOf("ply", plyText() + "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 4\n"),
            "m.ply:17:8: vertex 4 does not exist; there are 4");
  EXPECT_NE(errorOf("ply", plyText() + "0 0 nan 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n")
                .find("vertex 0 has a position that is not finite"),
            std::string::npos);
  EXPECT_NE(
      errorOf("ply", plyText() + "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n999999999 0 1 4\n")
          .find("a list of 1e+09 values"),
      std::string::npos);
  std::string cut = plyBinary(false);
  cut.resize(cut.size() - 3);
  EXPECT_NE(errorOf("ply", cut).find("m.ply: byte"), std::string::npos);
}

// A file of `count` squares, the one of index i at z = i.
std::string serialized(uint16_t version, uint32_t count, uint64_t claimedVertices = 4,
                       uint32_t lastIndex = 3, const std::string& name = "square") {
  std::string file;
  std::vector<uint64_t> offsets;
  const auto put = [](std::string& into, auto value) {
    into.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (uint32_t i = 0; i < count; ++i) {
    offsets.push_back(file.size());
    std::string data;
    put(data, uint32_t(0x1000 | 2));
    if (version == 4) data += name + '\0';
    put(data, claimedVertices);
    put(data, uint64_t(2));
    const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const auto& c : corners) put(data, c[0]), put(data, c[1]), put(data, float(i));
    for (const auto& c : corners) put(data, c[0]), put(data, c[1]);
    for (const uint32_t index : {0u, 1u, 2u, 0u, 2u, lastIndex}) put(data, index);
    std::vector<Bytef> packed(compressBound(data.size()));
    uLongf size = packed.size();
    compress(packed.data(), &size, reinterpret_cast<const Bytef*>(data.data()), data.size());
    put(file, uint16_t(0x041c));
    put(file, version);
    file.append(reinterpret_cast<const char*>(packed.data()), size);
  }
  for (const uint64_t offset : offsets) {
    if (version == 4) put(file, offset);
    if (version == 3) put(file, uint32_t(offset));
  }
  put(file, count);
  return file;
}

TEST_F(MitsubaMeshes, SerializedOfBothVersions) {
  for (const uint16_t version : {uint16_t(3), uint16_t(4)}) {
    const Scene scene = loadMesh("serialized", serialized(version, 3),
                                 "<integer name=\"shape_index\" value=\"2\"/>");
    const MeshGeometry& mesh = first(scene);
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 2));
    EXPECT_EQ(mesh.uvs[0].at(2), glm::vec2(1, 1));
    EXPECT_EQ(mesh.triangles.at(1), glm::uvec3(0, 2, 3));
    EXPECT_EQ(mesh.normals.at(0), glm::vec3(0, 0, 1));
  }
}

TEST_F(MitsubaMeshes, DamagedSerialized) {
  const std::string good = serialized(4, 2);
  EXPECT_EQ(errorOf("serialized", good, "<integer name=\"shape_index\" value=\"2\"/>"),
            "m.serialized: shape 2: does not exist; the file has 2");
  EXPECT_NE(
      errorOf("serialized", serialized(4, 1, uint64_t(1) << 31)).find("claims 2147483648 vertices"),
      std::string::npos);
  EXPECT_NE(errorOf("serialized", serialized(4, 1, 5)).find("end early"), std::string::npos);
  EXPECT_NE(errorOf("serialized", serialized(4, 1, 40)).find("end early"), std::string::npos);
  EXPECT_NE(errorOf("serialized", serialized(4, 1, 4, 9)).find("triangle 1 names vertex 9"),
            std::string::npos);
  EXPECT_NE(errorOf("serialized", serialized(4, 1, 4, 3, std::string(100000, 'a')))
                .find("its name has more than 65536 bytes"),
            std::string::npos);
  EXPECT_NE(errorOf("serialized", "abc").find("ends within its header"), std::string::npos);
  std::string damaged = good;
  damaged[8] = char(damaged[8] ^ 0x55);
  damaged[9] = char(damaged[9] ^ 0x55);
  EXPECT_NE(errorOf("serialized", damaged).find("m.serialized: shape 0"), std::string::npos);
  std::string version = good;
  version[2] = 5;
  EXPECT_NE(errorOf("serialized", version).find("m.serialized: shape 0"), std::string::npos);
  std::string claims = good;
  claims.replace(claims.size() - 4, 4, "\xff\xff\xff\x7f");
  EXPECT_NE(errorOf("serialized", claims).find("claims 2147483647 shapes"), std::string::npos);
}

TEST_F(MitsubaMeshes, AnalyticShapesAreClosedAndTurnOutwards) {
  const auto volumeOf = [&](const std::string& type) {
    const Scene scene = folder_.load("<shape type=\"" + type + "\"/>");
    EXPECT_EQ(test::openEdge(test::worldTriangles(scene)), "") << type;
    return test::signedVolume(test::worldTriangles(scene));
  };
  EXPECT_NEAR(volumeOf("cube"), 8.0, 1e-6);
  EXPECT_NEAR(volumeOf("sphere"), 4.18879, 0.2);  // of what stands in for it
  for (const char* type : {"rectangle", "disk"}) {
    const Scene scene = folder_.load("<shape type=\"" + std::string(type) + "\"/>");
    double area = 0.0;
    for (const test::WorldTriangle& t : test::worldTriangles(scene)) {
      EXPECT_GT(t.areaNormal().z, 0.0);
      area += t.areaNormal().z;
    }
    EXPECT_NEAR(area, type == std::string("disk") ? 3.14159 : 4.0, 0.01) << type;
  }
  const MeshGeometry sphere = fineMesh({findShape("sphere"), {}});
  for (size_t i = 0; i < sphere.positions.size(); ++i)
    EXPECT_NEAR(glm::length(sphere.positions[i] - sphere.normals[i]), 0.0f, 1e-6f);
}

TEST_F(MitsubaMeshes, SpheresAndCylindersArePlaced) {
  const Scene scene = folder_.load(
      "<shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"2\" z=\"3\"/><float "
      "name=\"radius\" value=\"0.5\"/></shape><shape type=\"cylinder\"><point name=\"p0\" "
      "value=\"0 0 0\"/><point name=\"p1\" value=\"0 4 0\"/><float name=\"radius\" "
      "value=\"0.25\"/></shape>");
  const glm::dmat4& ball = scene.instances.at(0).objectToWorld;
  EXPECT_NEAR(glm::length(glm::dvec3(ball * glm::dvec4(0, 0, 1, 1)) - glm::dvec3(1, 2, 3.5)), 0.0,
              1e-9);
  const auto bounds = worldBounds(scene);
  EXPECT_NEAR(bounds[1].y, 4.0, 1e-6);
  EXPECT_NEAR(bounds[0].x, -0.25, 1e-3);
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& geometry = scene.geometries.at(instance.geometry);
    ASSERT_NE(geometry.shape, nullptr);
    EXPECT_EQ(geometry.shape->info->name, geometry.name);
  }
  EXPECT_FALSE(test::notes(scene, "meshes of 128 segments"));
  for (const test::WorldTriangle& t : test::worldTriangles(scene, "cylinder")) {
    const glm::dvec3 middle = (t.p0 + t.p1 + t.p2) / 3.0;
    EXPECT_GT(glm::dot(t.areaNormal(), glm::dvec3(middle.x, 0.0, middle.z)), 0.0) << "inwards";
  }
}

// Groups are drawn where they are instanced, and share a mesh.
TEST_F(MitsubaMeshes, InstancesOfGroups) {
  const std::string group =
      "<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\"><transform "
      "name=\"to_world\"><translate x=\"1\"/></transform></shape><shape type=\"rectangle\"/>"
      "</shape>";
  const Scene scene = folder_.load(
      group +
      "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\"><scale "
      "value=\"2\"/></transform></shape><shape type=\"instance\"><ref id=\"g\"/></shape>");
  ASSERT_EQ(scene.instances.size(), 4u);
  EXPECT_EQ(scene.geometries.size(), 2u);
  EXPECT_EQ(glm::dvec3(scene.instances[0].objectToWorld[3]), glm::dvec3(2, 0, 0));
  EXPECT_EQ(glm::dvec3(scene.instances[2].objectToWorld[3]), glm::dvec3(1, 0, 0));
  EXPECT_TRUE(folder_.load(group).instances.empty());
  EXPECT_NE(folder_.error("<shape type=\"instance\"/>").find("names one shapegroup"),
            std::string::npos);
}

// Light on a normal map: tangents along u, the bitangent to their left.
TEST_F(MitsubaMeshes, TangentsFollowU) {
  MeshGeometry mesh = fineMesh({findShape("rectangle"), {}});
  mitsuba::addTangents(mesh);
  ASSERT_EQ(mesh.tangents.size(), 4u);
  for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));
}

}  // namespace
}  // namespace restlab
