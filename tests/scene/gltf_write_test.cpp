// Scenes written as glTF and read again: the same meshes, materials, lights, cameras and image.
#include "core/scene/gltf_write/gltf_write.h"
#include "core/scene/shapes/fine_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/scene/mesh_checks.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab {
namespace {

class GltfWrite : public ::testing::Test {
 protected:
  Scene again(const Scene& scene, const std::string& name = "out.gltf") {
    notes_ = writeGltf(scene, folder_.path() / "out.gltf");
    return loadScene((folder_.path() / name).string());
  }
  test::MitsubaFolder folder_;
  std::vector<std::string> notes_;
};

Image imageOf(const Scene& scene, uint32_t frames) {
  SessionConfig config;
  config.integrator = "path";
  config.width = 40;
  config.height = 25;
  Session session(CompiledScene::build(scene), config);
  Image sum(config.width, config.height);
  for (uint32_t i = 0; i < frames; ++i) {
    session.frame();
    const Image frame = session.radiance();
    for (size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += frame.pixels[p] / float(frames);
  }
  return sum;
}

// The same random numbers meet the same scene: images differ where rounding sends a path elsewhere.
void expectSameImage(const Scene& a, const Scene& b) {
  const Image first = imageOf(a, 4), second = imageOf(b, 4);
  double mean = 0.0;
  size_t different = 0;
  for (size_t p = 0; p < first.pixels.size(); ++p) {
    const glm::vec3 d = glm::abs(first.pixels[p] - second.pixels[p]);
    const glm::vec3 most = glm::max(first.pixels[p], second.pixels[p]);
    for (int c = 0; c < 3; ++c) different += d[c] > 1e-3f * most[c] + 1e-6f;
    mean += double(first.pixels[p].x + first.pixels[p].y + first.pixels[p].z);
  }
  EXPECT_GT(mean, 0.0);
  EXPECT_LT(double(different), 0.01 * 3.0 * double(first.pixels.size()));
}

void expectSameTriangles(const Scene& a, const Scene& b) {
  const auto first = test::worldTriangles(a), second = test::worldTriangles(b);
  ASSERT_EQ(first.size(), second.size());
  double most = 0.0;
  for (size_t i = 0; i < first.size(); ++i) {
    most = std::max(most, glm::length(first[i].p0 - second[i].p0));
    most = std::max(most, glm::length(first[i].p1 - second[i].p1));
    most = std::max(most, glm::length(first[i].p2 - second[i].p2));
  }
  EXPECT_LT(most, 1e-5);
}

void expectSameMaterials(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (size_t i = 0; i < a.materials.size(); ++i) {
    const SceneMaterial &x = a.materials[i], &y = b.materials[i];
    EXPECT_EQ(x.data.closure, y.data.closure) << x.name;
    EXPECT_EQ(x.data.flags, y.data.flags) << x.name;
    EXPECT_EQ(x.data.alpha, y.data.alpha) << x.name;
    EXPECT_NEAR(glm::length(x.data.emission - y.data.emission), 0.0f,
                1e-6f * glm::length(x.data.emission))
        << x.name;
    ASSERT_EQ(x.closure.size(), y.closure.size()) << x.name;
    for (size_t p = 0; p < x.closure.size(); ++p) {
      EXPECT_EQ(x.closure[p].texture == rl::RL_INVALID, y.closure[p].texture == rl::RL_INVALID);
      if (x.data.closure == rl::RL_CLOSURE_MIXTURE) continue;  // parts have other indices
      EXPECT_EQ(x.closure[p].words, y.closure[p].words) << x.name << " " << p;
    }
    if (x.data.closure != rl::RL_CLOSURE_GLTF) continue;
    EXPECT_EQ(x.data.baseColor, y.data.baseColor) << x.name;
    EXPECT_EQ(x.data.roughness, y.data.roughness) << x.name;
    EXPECT_EQ(x.data.metallic, y.data.metallic) << x.name;
    EXPECT_EQ(x.data.specular, y.data.specular) << x.name;
    EXPECT_EQ(x.data.ior, y.data.ior) << x.name;
    EXPECT_EQ(x.data.transmission, y.data.transmission) << x.name;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(x.data.sigmaAbsorption[c], y.data.sigmaAbsorption[c],
                  1e-5f * (x.data.sigmaAbsorption[c] + 1e-3f))
          << x.name;
  }
}

TEST_F(GltfWrite, TheMitsubaSceneLooksTheSame) {
  Scene scene = loadScene(std::string(RESTLAB_SOURCE_DIR) + "/experiments/scenes/mitsuba.xml");
  const Scene read = again(scene);
  for (MeshGeometry& geometry : scene.geometries)  // as they are written
    if (geometry.shape != nullptr) geometry = fineMesh(*geometry.shape);
  for (const std::string& note : notes_)
    EXPECT_NE(note.find("are written as triangles"), std::string::npos) << note;
  EXPECT_TRUE(scene.maxBounces.has_value());
  EXPECT_EQ(read.maxBounces, scene.maxBounces);
  EXPECT_EQ(suggestedBounces((folder_.path() / "out.gltf").string()), scene.maxBounces);
  EXPECT_GT(scene.cameras[0].film.x, 0u);
  EXPECT_EQ(read.cameras[0].film, scene.cameras[0].film);
  for (const std::string& warning : read.warnings) ADD_FAILURE() << warning;
  EXPECT_EQ(read.geometries.size(), scene.geometries.size()) << "instances share their mesh";
  expectSameTriangles(scene, read);
  ASSERT_EQ(read.cameras.size(), 1u);
  EXPECT_EQ(read.cameras[0].yfov, scene.cameras[0].yfov);
  EXPECT_EQ(read.cameras[0].aspect, scene.cameras[0].aspect);
  expectSameImage(scene, read);
}

TEST_F(GltfWrite, BuiltInScenesKeepTheirMaterials) {
  for (const char* name : {"cornell-box", "door-ajar", "glossy-gallery", "glass"}) {
    const Scene scene = makeBuiltinScene(name), read = again(scene);
    expectSameTriangles(scene, read);
    expectSameMaterials(scene, read);
    expectSameImage(scene, read);
  }
}

TEST_F(GltfWrite, SceneFilesKeepTheirKinds) {
  for (const char* name : {"candle", "painted-box"}) {
    const Scene scene =
        loadScene(std::string(RESTLAB_SOURCE_DIR) + "/experiments/scenes/" + name + ".scene.toml");
    const Scene read = again(scene);
    expectSameImage(scene, read);
    for (size_t i = 0; i < scene.materials.size(); ++i) {
      const glm::vec3 &a = scene.materials[i].sigmaScattering,
                      &b = read.materials[i].sigmaScattering;
      EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-5f * glm::length(a)) << scene.materials[i].name;
      EXPECT_EQ(scene.materials[i].phase, read.materials[i].phase);
    }
  }
  try {
    again(loadScene(std::string(RESTLAB_SOURCE_DIR) + "/experiments/scenes/materials.scene.toml"));
    FAIL() << "a table was written";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("has a table, which glTF files do not hold"),
              std::string::npos)
        << error.what();
  }
}

// A scene with each way to give a value to a closure.
TEST_F(GltfWrite, ClosuresAndTheirTextures) {
  const std::string checks =
      "<texture name=\"base_color\" type=\"checkerboard\"><rgb name=\"color0\" value=\"0.2 0.4 "
      "0.8\"/><rgb name=\"color1\" value=\"0.8 0.4 0.2\"/><transform name=\"to_uv\"><scale x=\"3\" "
      "y=\"2\"/><translate x=\"0.25\"/></transform></texture>";
  const Scene scene = folder_.load(
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/><transform "
      "name=\"to_world\"><lookat origin=\"0,0,2\" target=\"0,0,0\" up=\"0,1,0\"/></transform>"
      "</sensor><emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"1\" z=\"2\"/><rgb "
      "name=\"intensity\" value=\"4 5 6\"/></emitter>" +
      test::rectangleWith("<bsdf type=\"principled\">" + checks + "</bsdf>"));
  const Scene read = again(scene);
  expectSameMaterials(scene, read);
  const TextureUse &a = scene.textureUses.at(0), &b = read.textureUses.at(0);
  EXPECT_EQ(a.uvRow0, b.uvRow0);
  EXPECT_EQ(a.uvRow1, b.uvRow1);
  EXPECT_EQ(a.nearest, b.nearest);
  EXPECT_EQ(scene.images.at(0).texels, read.images.at(0).texels);
  ASSERT_EQ(read.lights.size(), 1u);
  EXPECT_NEAR(glm::length(read.lights[0].intensity - glm::vec3(4, 5, 6)), 0.0f, 1e-5f);
  EXPECT_EQ(read.lights[0].posW, glm::dvec3(0, 1, 2));
  expectSameImage(scene, read);
}

TEST_F(GltfWrite, LightsCamerasAndSurroundings) {
  const Scene scene = folder_.load(
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/><transform "
      "name=\"to_world\"><scale x=\"-1\"/><lookat origin=\"0,1,4\" target=\"0,0,0\" "
      "up=\"0,1,0\"/></transform></sensor>"
      "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"1,2,3\" "
      "target=\"0,0,0\" up=\"0,1,0\"/></transform></emitter>"
      "<emitter type=\"directional\"><vector name=\"direction\" x=\"1\" y=\"-2\" z=\"0.5\"/>"
      "</emitter><emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.5 0.25 "
      "1\"/></emitter>" +
      test::rectangleWith(""));
  const Scene read = again(scene, "out.scene.toml");
  ASSERT_EQ(read.lights.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(glm::length(read.lights[i].dirW - scene.lights[i].dirW), 0.0, 1e-6);
    EXPECT_EQ(read.lights[i].kind, scene.lights[i].kind);
    EXPECT_EQ(read.lights[i].outerConeAngle, scene.lights[i].outerConeAngle);
  }
  ASSERT_TRUE(read.environment.has_value());
  EXPECT_EQ(read.environment->radiance, scene.environment->radiance);
  ASSERT_EQ(read.cameras.size(), 1u);
  EXPECT_TRUE(read.cameras[0].isMirrored);
  for (int axis = 0; axis < 4; ++axis)
    EXPECT_NEAR(
        glm::length(read.cameras[0].cameraToWorld[axis] - scene.cameras[0].cameraToWorld[axis]),
        0.0, 1e-6);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_NE(notes_[0].find("out.scene.toml"), std::string::npos);
  expectSameImage(scene, read);
}

// A solid's edges stay sharp: normals are those of the field on each triangle's side.
TEST_F(GltfWrite, ShapesBecomeTrianglesWithALine) {
  folder_.write("solid.scene.toml",
                "[[shape]]\nkind = \"sdf\"\ntree = \"box(1, 0.8, 0.6)\"\n"
                "[[shape]]\nkind = \"implicit\"\nexpression = \"x^2 + y^2 + z^2 - 0.5\"\n"
                "[[shape]]\nkind = \"cube\"\n");
  const Scene read = again(loadScene((folder_.path() / "solid.scene.toml").string()));
  ASSERT_EQ(notes_.size(), 2u) << "a cube is made of triangles";
  EXPECT_NE(notes_[0].find("out.gltf: shapes of kind 'implicit'"), std::string::npos) << notes_[0];
  EXPECT_NE(notes_[1].find("kind 'sdf'"), std::string::npos) << notes_[1];
  ASSERT_EQ(read.geometries.size(), 3u);
  const MeshGeometry &box = read.geometries[0], &ball = read.geometries[1];
  ASSERT_EQ(box.normals.size(), box.positions.size());
  ASSERT_EQ(ball.normals.size(), ball.positions.size());
  for (size_t i = 0; i < ball.normals.size(); ++i)
    EXPECT_LT(glm::distance(ball.normals[i], glm::normalize(ball.positions[i])), 0.02f);
  size_t flat = 0;
  for (const glm::vec3& n : box.normals)
    flat += std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 0.999f;
  EXPECT_GT(double(flat), 0.97 * double(box.normals.size()));
}

std::string refusal(const Scene& scene, const std::filesystem::path& file) {
  try {
    writeGltf(scene, file);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    return error.what();
  }
  return "";
}

TEST_F(GltfWrite, NothingIsWrittenOverTheSceneItself) {
  const std::string text =
      "[[shape]]\nkind = \"cube\"\n[[light]]\nkind = \"ambient\"\nradiance = 1\n";
  folder_.write("room.scene.toml", text);
  const auto file = folder_.path() / "room.scene.toml";
  const Scene scene = loadScene(file.string());
  EXPECT_NE(refusal(scene, folder_.path() / "room.gltf").find("that the scene is made from"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "room.bin"));
  EXPECT_EQ(loadScene(file.string()).contentHash, scene.contentHash);
  // Surroundings of an earlier run are replaced, edits of the user are not.
  EXPECT_EQ(refusal(scene, folder_.path() / "other.gltf"), "");
  EXPECT_EQ(refusal(scene, folder_.path() / "other.gltf"), "");
  folder_.write("other.scene.toml", "base = \"other.gltf\"\n[camera]\nyfov = 30\n");
  EXPECT_NE(refusal(scene, folder_.path() / "other.gltf").find("more than what surrounds"),
            std::string::npos);
  folder_.write("other.scene.toml", "base = \"room.gltf\"\n");
  EXPECT_NE(refusal(scene, folder_.path() / "other.gltf").find("more than what surrounds"),
            std::string::npos);
  // A base is written over as little as the file that begins with it.
  folder_.write("child.scene.toml", "base = \"other.gltf\"\n");
  EXPECT_NE(refusal(loadScene((folder_.path() / "child.scene.toml").string()),
                    folder_.path() / "other.gltf")
                .find("that the scene is made from"),
            std::string::npos);
}

TEST_F(GltfWrite, FilesThatCannotBeWritten) {
  try {
    writeGltf(makeBuiltinScene("cornell-box"), folder_.path() / "none/out.gltf");
    FAIL() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    EXPECT_NE(std::string(error.what()).find("out.bin"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace restlab
