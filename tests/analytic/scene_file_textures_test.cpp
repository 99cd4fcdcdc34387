// Textures of scene files as they are drawn: a mirror of their colour under a white sky.
#include <gtest/gtest.h>

#include <string>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

// A triangle before a camera, one texel of tinyPng() by each UV set: red by the first, green and
// half transparent by the second.
class Textured : public ::testing::Test {
 protected:
  // The pixel of the scene; `more`: keys of the glTF material.
  glm::vec3 pixelOf(const std::string& materials, const nlohmann::json& more = {}) {
    test::GltfBuilder file;
    const auto all = [&](float u) {
      return file.accessor<float>({u, 0.5f, u, 0.5f, u, 0.5f}, "VEC2");
    };
    const int corners = file.accessor<float>({-9, -9, -1, 9, -9, -1, 0, 9, -1}, "VEC3");
    nlohmann::json material = {{"name", "sheet"}};
    if (!more.empty()) {
      material.merge_patch(more);
      file.add("images", {{"uri", "tiny.png"}});
      file.add("textures", {{"source", 0}});
    }
    file.add("materials", material);
    const nlohmann::json attributes = {
        {"POSITION", corners}, {"TEXCOORD_0", all(0.25f)}, {"TEXCOORD_1", all(0.75f)}};
    file.node({{"mesh", file.mesh({{"attributes", attributes}, {"material", 0}})}});
    file.directory().write("tiny.png", test::tinyPng());
    file.write();
    const std::filesystem::path scene = file.directory().write(
        "x.scene.toml", "base = \"test.gltf\"\n" + materials +
                            "[[assign]]\nmaterial = \"sheet\"\nto = \"m\"\n[camera]\nyfov = 1.0\n"
                            "[environment]\nradiance = 1.0\n[background]\nradiance = 0.25\n");
    SessionConfig config;
    config.integrator = "path";
    config.width = config.height = 1;
    Session session(CompiledScene::build(loadScene(scene.string())), config);
    session.frame();
    return session.radiance().pixels.at(0);
  }
};

const std::string kMirror =
    "[[material]]\nname = \"m\"\nkind = \"mirror\"\ncolor = [0.5, 0.8, 0.9]\n"
    "color_texture = \"tiny.png\"\n";

void expectColor(const glm::vec3& pixel, const glm::vec3& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1e-4f) << "channel " << c;
}

TEST_F(Textured, AColourIsItsTextureTimesItsFactor) {
  expectColor(pixelOf(kMirror), {0.5f, 0.0f, 0.0f});
  expectColor(pixelOf(kMirror + "color_uv_set = 1\n"), {0.0f, 0.8f, 0.0f});
}

// The share of a mixture is the green channel: 0 at the red texel, 1 at the other.
TEST_F(Textured, ANumberIsOneChannel) {
  const std::string mixture =
      "[[material]]\nname = \"a\"\nkind = \"mirror\"\ncolor = [1.0, 0.0, 0.0]\n"
      "[[material]]\nname = \"b\"\nkind = \"mirror\"\ncolor = [0.0, 0.0, 1.0]\n"
      "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"a\"\nsecond = \"b\"\n"
      "second_share = 1.0\nsecond_share_texture = \"tiny.png\"\nsecond_share_channel = \"g\"\n";
  expectColor(pixelOf(mixture), {1.0f, 0.0f, 0.0f});
  expectColor(pixelOf(mixture + "second_share_uv_set = 1\n"), {0.0f, 0.0f, 1.0f});
}

// A kind that is assigned leaves the holes of the material that it replaces.
TEST_F(Textured, CoverageStaysThatOfTheMaterialReplaced) {
  const auto masked = [&](double cutoff) {
    const nlohmann::json texture = {{"index", 0}, {"texCoord", 1}};
    return pixelOf(kMirror, {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}},
                             {"alphaMode", "MASK"},
                             {"alphaCutoff", cutoff}});
  };
  expectColor(masked(0.4), {0.5f, 0.0f, 0.0f});
  expectColor(masked(0.6), glm::vec3(0.25f));
}

}  // namespace
}  // namespace restlab
