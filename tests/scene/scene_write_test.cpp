// Scene files that name the materials of a scene: what they hold is what they were made from.
#include "core/scene/scene_write/scene_write.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/shading/bsdf.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

class SceneWrite : public ::testing::Test {
 protected:
  // Adds a triangle of its own to each material.
  void add(nlohmann::json material) {
    const size_t index = file_.doc.contains("materials") ? file_.doc["materials"].size() : 0;
    file_.add("materials", std::move(material));
    const int corners = file_.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const nlohmann::json attributes = {{"POSITION", corners}};
    file_.node({{"mesh", file_.mesh({{"attributes", attributes}, {"material", index}})}});
  }
  SceneFileText written() {
    file_.write();
    scene_ = loadScene((file_.directory().path() / "test.gltf").string());
    const SceneFileText text = sceneFileOf(scene_, baseNameOf(scene_, file_.directory().path()));
    file_.directory().write("named.scene.toml", text.text);
    named_ = loadScene((file_.directory().path() / "named.scene.toml").string());
    return text;
  }
  void expectSameMaterials() const {
    ASSERT_EQ(scene_.instances.size(), named_.instances.size());
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      const SceneMaterial &a = scene_.materials[scene_.instances[i].material],
                          &b = named_.materials[named_.instances[i].material];
      EXPECT_EQ(a.data.flags, b.data.flags) << a.name;
      EXPECT_EQ(a.data.closure, b.data.closure) << a.name;
      EXPECT_NEAR(a.data.roughness, b.data.roughness, 1e-6) << a.name;
      EXPECT_EQ(a.data.baseColor, b.data.baseColor) << a.name;
      EXPECT_EQ(a.data.emission, b.data.emission) << a.name;
      EXPECT_EQ(a.data.metallic, b.data.metallic) << a.name;
      EXPECT_EQ(a.data.transmission, b.data.transmission) << a.name;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a.data.sigmaAbsorption[c], b.data.sigmaAbsorption[c], 1e-6) << a.name;
      for (size_t t = 0; t < std::size(a.data.textures); ++t)
        EXPECT_EQ(a.data.textures[t], b.data.textures[t]) << a.name;
      ASSERT_EQ(a.closure.size(), b.closure.size()) << a.name;
      // Layers without a factor have numbers that nothing looks at.
      const size_t count = a.data.closure == rl::RL_CLOSURE_GLTF && !a.closure.empty()
                               ? size_t(rl::RL_LAYER_CLEARCOAT) + 1
                               : a.closure.size();
      for (size_t k = 0; k < count; ++k)
        EXPECT_EQ(a.closure[k].words.x, b.closure[k].words.x) << a.name << " " << k;
    }
  }
  static nlohmann::json plain(const std::string& name, double metallic, double roughness) {
    return {{"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {0.5, 0.25, 0.125, 1.0}},
              {"metallicFactor", metallic},
              {"roughnessFactor", roughness}}}};
  }

  test::GltfBuilder file_;
  Scene scene_, named_;
};

TEST_F(SceneWrite, EveryKindIsNamed) {
  add(plain("lacquer", 0.0, 0.5));
  add(plain("steel \"polished\"", 1.0, 0.25));
  nlohmann::json glass = plain("glass", 0.0, 0.0);
  glass["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
                         {"KHR_materials_volume",
                          {{"thicknessFactor", 1.0},
                           {"attenuationDistance", 2.0},
                           {"attenuationColor", {0.5, 0.9, 0.9}}}}};
  add(glass);
  nlohmann::json pane = plain("pane", 0.0, 0.0);
  pane["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}};
  add(pane);
  nlohmann::json coated = plain("coated", 0.5, 0.5);
  coated["extensions"] = {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}}}};
  coated["emissiveFactor"] = {1.0, 0.5, 0.25};
  coated["doubleSided"] = true;
  add(coated);
  nlohmann::json gold = plain("gold", 0.0, 0.0);
  gold["extras"] = {{"restlab", {{"kind", "conductor"}, {"metal", "Au"}, {"alpha", 0.2}}}};
  add(gold);
  const SceneFileText text = written();
  EXPECT_EQ(text.named, 6u) << text.text;
  EXPECT_EQ(text.commentary, 0u) << text.text;
  for (const char* part : {"kind = \"plastic\"", "kind = \"gltf\"", "kind = \"dielectric\"",
                           "kind = \"thin_dielectric\"", "clearcoat = 0.75", "kind = \"conductor\"",
                           "material = \"steel \\\"polished\\\"\""})
    EXPECT_NE(text.text.find(part), std::string::npos) << part << "\n" << text.text;
  expectSameMaterials();
}

// A wrong value in the place of one that cannot be written would change the image.
TEST_F(SceneWrite, MaterialsThatWouldChangeAreComments) {
  file_.directory().write("tiny.png", test::tinyPng());
  file_.add("images", {{"uri", "tiny.png"}});
  file_.add("textures", {{"source", 0}});
  nlohmann::json wood = plain("wood", 0.0, 0.5);
  wood["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  add(wood);
  nlohmann::json sign = plain("sign", 0.0, 0.5);
  sign["extensions"] = {{"KHR_materials_unlit", nlohmann::json::object()}};
  add(sign);
  add(plain("twice", 0.0, 0.5));
  add(plain("twice", 0.0, 0.75));
  add(plain("all*", 0.0, 0.5));
  add(plain("wall[1]", 0.0, 0.5));
  add(plain("a\\b", 0.0, 0.5));
  add(plain("alike", 0.0, 0.5));
  add(plain("alike", 0.0, 0.5));
  nlohmann::json tinted = plain("tinted", 0.0, 0.5);
  tinted["extensions"] = {{"KHR_materials_specular", {{"specularColorFactor", {1.0, 0.5, 0.5}}}}};
  add(tinted);
  // The texture of coverage stays, so this one can be named.
  nlohmann::json leaf = wood;
  leaf["name"] = "leaf";
  leaf["alphaMode"] = "MASK";
  add(leaf);
  const SceneFileText text = written();
  EXPECT_EQ(text.named, 2u) << text.text;
  EXPECT_EQ(text.commentary, 8u) << text.text;
  EXPECT_NE(text.text.find("# The base has textures for it"), std::string::npos) << text.text;
  EXPECT_NE(text.text.find("# Unlit in the base"), std::string::npos) << text.text;
  EXPECT_NE(text.text.find("# Several materials have this name."), std::string::npos) << text.text;
  expectSameMaterials();
}

TEST_F(SceneWrite, BasesAreNamedFromTheFoldersOfTheirFiles) {
  Scene scene;
  scene.name = "a";
  scene.source = "/scenes/one/a.gltf";
  scene.variant = "night";
  EXPECT_EQ(baseNameOf(scene, "/scenes/two"), "../one/a.gltf?variant=night");
  scene = makeBuiltinScene("furnace?albedo=0.25");
  EXPECT_EQ(baseNameOf(scene, "/scenes/two"), "furnace?albedo=0.25");
}

// Names of files without their extension may be those of built-in scenes.
TEST_F(SceneWrite, SettingsOfFilesNamedAsBuiltInScenes) {
  file_.directory().write("furnace.scene.toml", "base = \"cornell-box\"\n[camera]\nyfov = 40\n");
  const std::string file = (file_.directory().path() / "furnace.scene.toml").string();
  const Scene scene = loadScene(file + "?camera.yfov=60");
  ASSERT_TRUE(isBuiltinScene(scene.name)) << scene.name;
  EXPECT_EQ(settingsOfScene(scene), "camera.yfov=60");
  EXPECT_EQ(baseNameOf(scene, file_.directory().path()), "furnace.scene.toml?camera.yfov=60");
  EXPECT_EQ(settingsOfScene(loadScene(file)), "");
  EXPECT_EQ(settingsOfScene(makeBuiltinScene("furnace?albedo=0.25")), "");
  file_.directory().write("glass.xml",
                          "<scene version=\"3.0.0\"><default name=\"a\" value=\"1\"/>"
                          "<shape type=\"sphere\"><float name=\"radius\" value=\"$a\"/></shape>"
                          "</scene>");
  const std::string xml = (file_.directory().path() / "glass.xml").string();
  EXPECT_EQ(settingsOfScene(loadScene(xml + "?a=2")), "a=2");
}

TEST_F(SceneWrite, NamesThatAreNotUtf8AreComments) {
  Scene scene = makeBuiltinScene("furnace");
  scene.materials.at(0).name = "caf\xe9";
  const SceneFileText text = sceneFileOf(scene, "furnace");
  EXPECT_EQ(text.text.find('\xe9'), std::string::npos) << text.text;
  EXPECT_NE(text.text.find("# A name that is not UTF-8"), std::string::npos) << text.text;
  file_.directory().write("named.scene.toml", text.text);
  EXPECT_NO_THROW(loadScene((file_.directory().path() / "named.scene.toml").string()));
  EXPECT_THROW(sceneFileOf(scene, "caf\xe9.gltf"), Error);
}

}  // namespace
}  // namespace restlab
