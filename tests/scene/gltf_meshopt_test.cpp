// EXT_meshopt_compression: modes, filters, and streams that lie.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <random>

#include "core/base/error.h"
#include "tests/scene/corpus.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
const std::string kMeshoptStream = std::string("bufferViews[0].extensions.") + kMeshopt;

std::string attributesStream(const void* values, size_t count, size_t stride) {
  meshopt_encodeVertexVersion(0);
  std::string stream(meshopt_encodeVertexBufferBound(count, stride), '\0');
  stream.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(stream.data()),
                                           stream.size(), values, count, stride));
  return stream;
}

std::string indexStream(const std::vector<uint32_t>& indices, bool isTriangles, uint32_t vertices) {
  meshopt_encodeIndexVersion(1);
  std::string stream(isTriangles ? meshopt_encodeIndexBufferBound(indices.size(), vertices)
                                 : meshopt_encodeIndexSequenceBound(indices.size(), vertices),
                     '\0');
  auto* bytes = reinterpret_cast<unsigned char*>(stream.data());
  const size_t size = stream.size(), count = indices.size();
  stream.resize(isTriangles ? meshopt_encodeIndexBuffer(bytes, size, indices.data(), count)
                            : meshopt_encodeIndexSequence(bytes, size, indices.data(), count));
  return stream;
}

const std::vector<float> kSquareCorners = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<uint32_t> kSquareIndices = {0, 1, 2, 0, 2, 3};

// A square with compressed views. The decoded bytes would lie in buffers[1], which has no data.
class MeshoptFile {
 public:
  MeshoptFile() {
    file.doc["extensionsUsed"] = {kMeshopt};
    file.doc["extensionsRequired"] = {kMeshopt};
  }

  int view(const std::string& stream, size_t count, size_t stride, const char* mode,
           const char* filter = nullptr) {
    const int packed = file.bufferView(stream.data(), stream.size());
    json& view = file.doc["bufferViews"][size_t(packed)];
    json extension = view;
    extension["byteStride"] = stride;
    extension["count"] = count;
    extension["mode"] = mode;
    if (filter) extension["filter"] = filter;
    view = {{"buffer", 1},
            {"byteOffset", fallback_},
            {"byteLength", count * stride},
            {"extensions", {{kMeshopt, extension}}}};
    fallback_ += (count * stride + 3) / 4 * 4;
    return packed;
  }

  int accessor(int view, size_t count, int componentType, const char* type,
               bool normalized = false) {
    return file.addAccessor(view, 0, count, componentType, type, normalized);
  }

  // Adds the square, drawn from compressed positions and indices.
  void square(bool isTriangles = true) {
    const int positions = accessor(
        view(attributesStream(kSquareCorners.data(), 4, 12), 4, 12, "ATTRIBUTES"), 4, 5126, "VEC3");
    const int indices = accessor(view(indexStream(kSquareIndices, isTriangles, 4), 6, 2,
                                      isTriangles ? "TRIANGLES" : "INDICES"),
                                 6, 5123, "SCALAR");
    file.node(
        {{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  }

  json& extension(size_t view = 0) { return file.doc["bufferViews"][view]["extensions"][kMeshopt]; }

  void finish() {
    if (file.doc.contains("buffers")) return;
    file.doc["buffers"] = {
        {{"byteLength", file.bytes().size()}, {"uri", "test.bin"}},
        {{"byteLength", fallback_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}}};
  }
  Scene load() {
    finish();
    return file.load();
  }
  std::string error() {
    finish();
    return file.error();
  }

  GltfBuilder file;

 private:
  size_t fallback_ = 0;
};

TEST(GltfMeshopt, AttributesAndBothKindsOfIndices) {
  for (const bool isTriangles : {true, false}) {
    MeshoptFile file;
    file.square(isTriangles);
    const Scene scene = file.load();
    const MeshGeometry& mesh = scene.geometries.at(0);
    ASSERT_EQ(mesh.positions.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(mesh.positions[i], glm::vec3(kSquareCorners[3 * i], kSquareCorners[3 * i + 1],
                                             kSquareCorners[3 * i + 2]));
    }
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  }
}

TEST(GltfMeshopt, Filters) {
  MeshoptFile file;
  file.file.doc["extensionsUsed"].push_back("KHR_mesh_quantization");
  file.file.doc["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
  const std::vector<float> normals = {0, 0, 1, 0, 0.6f, 0, 0.8f, 0, 0, -1, 0, 0, 0, 0, -1, 0};
  std::vector<int8_t> packed(16);
  meshopt_encodeFilterOct(packed.data(), 4, 4, 8, normals.data());
  const int normalView =
      file.view(attributesStream(packed.data(), 4, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
  file.file.doc["bufferViews"][size_t(normalView)]["byteStride"] = 4;
  // A mantissa of 24 bits and an exponent of 8: 3 x 2^-2 and so on.
  std::vector<uint32_t> exponential;
  for (const float value : kSquareCorners)
    exponential.push_back((uint32_t(uint8_t(-2)) << 24) | uint32_t(4.0f * value));
  const int positions = file.accessor(
      file.view(attributesStream(exponential.data(), 4, 12), 4, 12, "ATTRIBUTES", "EXPONENTIAL"), 4,
      5126, "VEC3");
  const std::vector<float> turns = {0, 0, 0, 1, 0, 0, 0.7071068f, 0.7071068f};
  std::vector<int16_t> quaternions(8);
  meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turns.data());
  const int rotations = file.accessor(
      file.view(attributesStream(quaternions.data(), 2, 8), 2, 8, "ATTRIBUTES", "QUATERNION"), 2,
      5122, "VEC4", true);
  const int mesh = file.file.mesh(
      {{"attributes",
        {{"POSITION", positions}, {"NORMAL", file.accessor(normalView, 4, 5120, "VEC3", true)}}},
       {"mode", 6}});
  file.file.node(
      {{"mesh", mesh},
       {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", rotations}}}}}}}});
  const Scene scene = file.load();
  const MeshGeometry& square = scene.geometries.at(0);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(square.positions[i], glm::vec3(kSquareCorners[3 * i], kSquareCorners[3 * i + 1],
                                             kSquareCorners[3 * i + 2]));
    EXPECT_GT(glm::dot(glm::normalize(square.normals[i]),
                       glm::vec3(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2])),
              0.999f)
        << i;
  }
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_NEAR(scene.instances[0].objectToWorld[0].x, 1.0, 1e-3);
  EXPECT_NEAR(scene.instances[1].objectToWorld[0].y, 1.0, 1e-3) << "a quarter turn about z";
}

TEST(GltfMeshopt, FallbacksAreNotLoaded) {
  MeshoptFile file;
  file.square();
  file.finish();
  file.file.doc["buffers"][1]["uri"] = "absent.bin";
  EXPECT_EQ(file.error(), "");
  file.file.doc["bufferViews"][1].erase("extensions");
  EXPECT_EQ(file.error(),
            "bufferViews[1]: lies in buffers[1], a fallback, which is not loaded, but has no "
            "EXT_meshopt_compression");
  MeshoptFile other;
  other.square();
  other.extension()["buffer"] = 1;
  EXPECT_NE(other.error().find(kMeshoptStream + ".buffer: buffers[1] is a fallback"),
            std::string::npos)
      << other.error();
}

TEST(GltfMeshopt, RulesOfModesAndFilters) {
  const auto errorOf = [](auto change) {
    MeshoptFile file;
    file.square();
    change(file);
    return file.error();
  };
  const auto expect = [&](const std::string& line, auto change) {
    EXPECT_NE(errorOf(change).find(line), std::string::npos) << errorOf(change);
  };
  expect(
      kMeshoptStream + ".byteStride: 6 is not valid for mode ATTRIBUTES; a multiple of 4 up to 256",
      [](MeshoptFile& file) { file.extension()["byteStride"] = 6; });
  expect(kMeshoptStream + ".byteStride: 260 is out of range; 1 to 256 expected",
         [](MeshoptFile& file) { file.extension()["byteStride"] = 260; });
  expect(".byteStride: 8 is not valid for mode TRIANGLES; 2 or 4 expected",
         [](MeshoptFile& file) { file.extension(1)["byteStride"] = 8; });
  expect(".count: 5 is not valid for mode TRIANGLES; a multiple of 3 expected",
         [](MeshoptFile& file) { file.extension(1)["count"] = 5; });
  expect(".filter: OCTAHEDRAL is not valid for mode TRIANGLES; NONE expected",
         [](MeshoptFile& file) { file.extension(1)["filter"] = "OCTAHEDRAL"; });
  expect(".byteStride: 12 is not valid for filter OCTAHEDRAL; 4 or 8 expected",
         [](MeshoptFile& file) { file.extension()["filter"] = "OCTAHEDRAL"; });
  expect(".byteStride: 12 is not valid for filter QUATERNION; 8 expected",
         [](MeshoptFile& file) { file.extension()["filter"] = "QUATERNION"; });
  expect(".filter: 'OKTAHEDRAL' is not valid; one of",
         [](MeshoptFile& file) { file.extension()["filter"] = "OKTAHEDRAL"; });
  expect(
      "bufferViews[0].byteLength: 48, but its compressed bytes are 5 elements of 12 bytes; 60 "
      "expected",
      [](MeshoptFile& file) { file.extension()["count"] = 5; });
  expect("bufferViews[0].byteStride: 16, but its compressed elements have 12 bytes; the same",
         [](MeshoptFile& file) { file.file.doc["bufferViews"][0]["byteStride"] = 16; });
  expect(kMeshoptStream + ": bytes 0 to 4096 reach beyond buffers[0]",
         [](MeshoptFile& file) { file.extension()["byteLength"] = 4096; });
}

TEST(GltfMeshopt, DecodedSizesAreBoundedBeforeMemoryIsTaken) {
  MeshoptFile file;
  file.square();
  const uint64_t count = uint64_t(1) << 40;
  file.extension()["count"] = count;
  file.file.doc["bufferViews"][0]["byteOffset"] = 0;
  file.file.doc["bufferViews"][0]["byteLength"] = 12 * count;
  file.finish();
  file.file.doc["buffers"][1]["byteLength"] = 12 * count;
  EXPECT_NE(file.error().find("at most 64 times as many fit into this format"), std::string::npos)
      << file.error();

  // A stream that is as dense as can be, in many views.
  const std::vector<uint8_t> zeros(size_t(1) << 20);
  MeshoptFile many;
  many.square();
  const std::string stream = attributesStream(zeros.data(), zeros.size() / 16, 16);
  ASSERT_LT(64 * stream.size(), 2 * zeros.size());
  const int view = many.view(stream, zeros.size() / 16, 16, "ATTRIBUTES");
  EXPECT_EQ(many.error(), "");
  for (int i = 0; i < 70; ++i)
    many.file.add("bufferViews", json(many.file.doc["bufferViews"][size_t(view)]));
  EXPECT_NE(many.error().find("with those before it decodes to"), std::string::npos)
      << many.error();
}

TEST(GltfMeshopt, DamagedStreamsBringOneLine) {
  {
    MeshoptFile file;
    file.square();
    file.extension()["byteLength"] = file.extension()["byteLength"].get<size_t>() - 1;
    EXPECT_NE(
        file.error().find(
            "bytes, which are not a stream of 4 elements of 12 bytes in mode ATTRIBUTES; the file"),
        std::string::npos)
        << file.error();
  }
  {
    MeshoptFile file;  // a stream of indices where attributes should be
    const std::string stream = indexStream(kSquareIndices, true, 4);
    file.view(stream, 4, 4, "ATTRIBUTES");
    EXPECT_EQ(file.error(), kMeshoptStream +
                                ": the stream begins with the byte 0xe1; 0xa0 expected for "
                                "mode ATTRIBUTES");
  }
  for (const bool isTriangles : {true, false}) {
    MeshoptFile file;  // an index that two bytes would cut to 4
    file.view(indexStream({0, 1, 65540}, isTriangles, 65541), 3, 2,
              isTriangles ? "TRIANGLES" : "INDICES");
    EXPECT_EQ(file.error(), kMeshoptStream +
                                ": holds an index above 65535, in elements of 2 bytes; 4 bytes "
                                "expected");
  }
  std::mt19937 random(1);
  std::vector<float> many(3000);
  for (float& number : many) number = float(random() % 1000);
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < 998; ++i) indices.insert(indices.end(), {i, i + 1, i + 2});
  const std::string streams[] = {attributesStream(many.data(), 1000, 12),
                                 indexStream(indices, true, 1000),
                                 indexStream(indices, false, 1000)};
  for (int i = 0; i < 300; ++i) {
    std::string wrong[3] = {streams[0], streams[1], streams[2]};
    for (int n = 0; n <= i % 4; ++n) {
      std::string& one = wrong[random() % 3];
      one[random() % one.size()] = char(random());
    }
    MeshoptFile file;
    const int positions =
        file.accessor(file.view(wrong[0], 1000, 12, "ATTRIBUTES"), 1000, 5126, "VEC3");
    for (const int mode : {1, 2}) {
      const int index = file.accessor(
          file.view(wrong[size_t(mode)], indices.size(), 4, mode == 1 ? "TRIANGLES" : "INDICES"),
          indices.size(), 5125, "SCALAR");
      file.file.node({{"mesh", file.file.mesh({{"attributes", {{"POSITION", positions}}},
                                               {"indices", index}})}});
    }
    EXPECT_EQ(file.error().find("wrong exit code"), std::string::npos) << file.error();
  }
}

TEST(GltfMeshopt, AFileOfAnotherProgram) {
  const std::filesystem::path folder = test::sceneFolder() / "loader/BoxMeshopt";
  SKIP_WITHOUT(folder);
  for (const char* name : {"BoxMeshopt.gltf", "BoxMeshopt.glb"}) {
    const Scene scene = loadGltf(folder / name);
    const MeshGeometry& box = scene.geometries.at(0);
    EXPECT_EQ(box.triangles.size(), 12u);
    glm::vec3 centre(0.0f);
    for (const glm::vec3& position : box.positions) centre += position / 24.0f;
    for (const glm::uvec3& triangle : box.triangles) {
      // Each face points away from the centre, as its corners' normals do.
      const glm::vec3 a = box.positions[triangle.x], b = box.positions[triangle.y],
                      c = box.positions[triangle.z];
      const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
      EXPECT_GT(glm::dot(normal, a - centre), 0.0f);
      EXPECT_GT(glm::dot(normal, glm::normalize(box.normals[triangle.x])), 0.99f);
    }
  }
}

}  // namespace
}  // namespace restlab
