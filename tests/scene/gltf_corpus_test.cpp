// Every glTF of the scene collection, if present: valid files load with the numbers that the table
// states, and broken files cause at most an Error.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "tests/scene/corpus.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;

using test::gltfsBelow;
using test::sceneFolder;

size_t instancedTriangles(const Scene& scene) {
  size_t triangles = 0;
  for (const MeshInstance& instance : scene.instances) {
    triangles += scene.geometries.at(instance.geometry).triangles.size();
    EXPECT_LT(instance.material, scene.materials.size());
  }
  return triangles;
}

// The import guarantees that indices inside a scene are valid.
void expectConsistent(const Scene& scene, const fs::path& file) {
  for (const MeshGeometry& geometry : scene.geometries) {
    for (const glm::uvec3& t : geometry.triangles) {
      ASSERT_LT(std::max({t.x, t.y, t.z}), geometry.positions.size()) << file;
    }
    const size_t count = geometry.positions.size();
    ASSERT_TRUE(geometry.normals.empty() || geometry.normals.size() == count) << file;
    ASSERT_TRUE(geometry.tangents.empty() || geometry.tangents.size() == count) << file;
    ASSERT_TRUE(geometry.colors.empty() || geometry.colors.size() == count) << file;
    for (const auto& uvs : geometry.uvs) ASSERT_TRUE(uvs.empty() || uvs.size() == count) << file;
  }
  for (const SceneMaterial& material : scene.materials) {
    for (const uint32_t texture : material.data.textures) {
      ASSERT_TRUE(texture == rl::RL_INVALID || texture < scene.textureUses.size()) << file;
    }
  }
  for (const TextureUse& use : scene.textureUses) ASSERT_LT(use.image, scene.images.size()) << file;
  for (const TextureImage& image : scene.images) {
    ASSERT_EQ(image.texels.size(), size_t(image.width) * image.height) << file;
  }
  ASSERT_FALSE(scene.cameras.empty()) << file;
  ASSERT_NE(scene.contentHash, 0u) << file;
  instancedTriangles(scene);
}

TEST(GltfCorpus, ScenesLoadOrAreRefusedForTheirExtension) {
  size_t loaded = 0, refused = 0;
  for (const char* part : {"rooms", "gates", "materials", "loader"}) {
    const fs::path folder = sceneFolder() / part;
    SKIP_WITHOUT(folder);
    for (const fs::path& file : gltfsBelow(folder)) {
      try {
        expectConsistent(loadGltf(file), file);
        ++loaded;
      } catch (const Error& error) {
        const std::string line = error.what();
        EXPECT_NE(line.find(" is required, but not supported"), std::string::npos) << line;
        ++refused;
      }
    }
  }
  std::cout << loaded << " scenes loaded, " << refused << " refused\n";
  EXPECT_GT(loaded, 0u);
}

struct Expected {
  const char* path;
  size_t triangles, images, lights, skipped;
};

class GltfCorpusScene : public testing::TestWithParam<Expected> {};

TEST_P(GltfCorpusScene, HasWhatTheTableSays) {
  const Expected& expected = GetParam();
  const fs::path file = sceneFolder() / expected.path;
  SKIP_WITHOUT(file.parent_path());
  const Scene scene = loadGltf(file);
  EXPECT_EQ(instancedTriangles(scene), expected.triangles);
  EXPECT_EQ(scene.images.size(), expected.images);
  EXPECT_EQ(scene.lights.size(), expected.lights);
  EXPECT_EQ(scene.skippedPrimitives, expected.skipped);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, GltfCorpusScene,
    testing::Values(Expected{"gates/cornell-box/cornell-box.gltf", 36, 0, 0, 0},
                    Expected{"gates/mi-directional/mi-directional.gltf", 9026, 0, 1, 0},
                    Expected{"rooms/dining-room/dining-room.gltf", 269538, 3, 1, 0},
                    Expected{"rooms/living-room/living-room.gltf", 143163, 4, 0, 0},
                    Expected{"rooms/sponza-dabrovic/sponza-dabrovic.gltf", 70413, 10, 0, 0},
                    Expected{"rooms/veach-mis/veach-mis.gltf", 19852, 0, 0, 0},
                    Expected{"rooms/nvpro-cornell-box/cornellBox.gltf", 16732, 0, 0, 0},
                    Expected{"materials/MetalRoughSpheresNoTextures/glTF/"
                             "MetalRoughSpheresNoTextures.gltf",
                             1040409, 0, 0, 0},
                    Expected{"loader/bio-22_vertex_color/22_vertex_color.gltf", 5, 0, 0, 7},
                    Expected{"loader/pc-lights/Lights.glb", 12, 0, 4, 0}));

TEST(GltfCorpus, BrokenFilesBringOneLineAndNothingElse) {
  const fs::path folder = sceneFolder() / "bad-gltf";
  SKIP_WITHOUT(folder);
  size_t loaded = 0, refused = 0;
  for (const fs::path& file : gltfsBelow(folder)) {
    try {
      expectConsistent(loadGltf(file), file);
      ++loaded;
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_EQ(error.code(), ExitCode::badInput) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
      EXPECT_EQ(line.find(file.string() + ": "), 0u) << line;
      ++refused;
    }
  }
  std::cout << loaded << " files loaded, " << refused << " refused\n";
  EXPECT_GT(refused, 0u);
  const fs::path base = folder / "validator/base/data";
  const auto errorOf = [](const fs::path& file) -> std::string {
    try {
      loadGltf(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "loaded";
  };
  EXPECT_NE(errorOf(base / "mesh_data/index_buffer_oob.gltf").find("is 5, but the primitive has 4"),
            std::string::npos);
  EXPECT_NE(errorOf(base / "node/node_loop.gltf").find("its own descendant"), std::string::npos);
}

struct ExpectedMap {
  const char* path;
  uint32_t width, height;
  float peakLow, peakHigh;  // largest luminance
};

class EnvironmentCorpus : public testing::TestWithParam<ExpectedMap> {};

TEST_P(EnvironmentCorpus, HasItsSizeAndPeak) {
  const ExpectedMap& expected = GetParam();
  const fs::path file = sceneFolder() / expected.path;
  SKIP_WITHOUT(file.parent_path());
  const EnvironmentMap map = loadEnvironment(file);
  EXPECT_EQ(map.width, expected.width);
  EXPECT_EQ(map.height, expected.height);
  ASSERT_EQ(map.radiance.size(), size_t(map.width) * map.height);
  float peak = 0.0f;
  for (const glm::vec3& texel : map.radiance) {
    peak = std::max(peak, glm::dot(texel, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
  }
  EXPECT_GE(peak, expected.peakLow);
  EXPECT_LE(peak, expected.peakHigh);
}

INSTANTIATE_TEST_SUITE_P(
    Maps, EnvironmentCorpus,
    testing::Values(ExpectedMap{"environments/kloppenheim_05_1k/kloppenheim_05_1k.hdr", 1024, 512,
                                78800, 79300},
                    ExpectedMap{"environments/studio_small_05_1k/studio_small_05_1k.hdr", 1024, 512,
                                86, 88},
                    ExpectedMap{"environments/std_env/std_env.hdr", 1500, 750, 9.5f, 10.5f},
                    ExpectedMap{"environments/museum/museum.exr", 512, 256, 0.1f, 1e5f},
                    ExpectedMap{"rooms/living-room/env/Sky_19.exr", 2048, 1024, 0.1f, 1e6f}));

}  // namespace
}  // namespace restlab
