// Layers that extensions of glTF add to a material, as they are imported.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/dialect/features.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/shading/bsdf.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

Scene loadLayers(GltfBuilder& file, const json& extensions, json material = json::object()) {
  std::vector<std::string> used;
  for (const auto& [name, value] : extensions.items()) used.push_back(name);
  file.doc["extensionsUsed"] = used;
  const int uv = file.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  material["extensions"] = extensions;
  file.add("materials", material);
  file.node({{"mesh", file.triangle({{"material", 0}, {"attributes", {{"TEXCOORD_0", uv}}}})}});
  return file.load();
}

Scene loadLayers(const json& extensions, json material = json::object()) {
  GltfBuilder file;
  return loadLayers(file, extensions, std::move(material));
}

glm::vec3 valueOf(const Scene& scene, uint32_t layer) {
  const glm::uvec3& words = scene.materials.at(0).closure.at(layer).words;
  return {std::bit_cast<float>(words.x), std::bit_cast<float>(words.y),
          std::bit_cast<float>(words.z)};
}

TEST(GltfLayers, ValuesAndFlags) {
  const Scene scene = loadLayers(
      {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}}},
       {"KHR_materials_sheen",
        {{"sheenColorFactor", {0.1, 0.2, 0.3}}, {"sheenRoughnessFactor", 0.75}}},
       {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.0}}},
       {"KHR_materials_iridescence",
        {{"iridescenceFactor", 0.5},
         {"iridescenceIor", 1.5},
         {"iridescenceThicknessMinimum", 200},
         {"iridescenceThicknessMaximum", 600}}},
       {"KHR_materials_diffuse_transmission",
        {{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", {0.25, 0.5, 1.0}}}},
       {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
       {"KHR_materials_volume", {{"thicknessFactor", 1.0}}},
       {"KHR_materials_dispersion", {{"dispersion", 0.5}}}});
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.at(0);
  EXPECT_EQ(scene.materials[0].data.flags & rl::RL_MATERIAL_LAYERS, rl::RL_MATERIAL_LAYERS);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_CLEARCOAT).x, 0.5f);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_CLEARCOAT_ROUGHNESS).x, 0.25f);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_SHEEN_COLOR), glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_SHEEN_ROUGHNESS).x, 0.75f);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_ANISOTROPY),
            glm::vec3(0.5f, float(std::cos(1.0)), float(std::sin(1.0))));
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_IRIDESCENCE).x, 0.5f);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_FILM), glm::vec3(200.0f, 600.0f, 1.5f));
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_DIFFUSE_TRANSMISSION).x, 0.5f);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR), glm::vec3(0.25f, 0.5f, 1.0f));
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_DISPERSION).x, 0.5f);
  EXPECT_EQ(CompiledScene::build(scene)->features() & rl::RL_FEATURE_LAYERS, rl::RL_FEATURE_LAYERS);
}

// Defaults leave a layer out; each extension needs its own feature alone.
TEST(GltfLayers, EachNeedsItsFeature) {
  const std::vector<std::tuple<std::string, json, rl::FeatureMask>> cases = {
      {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}, rl::RL_FEATURE_CLEARCOAT},
      {"KHR_materials_sheen", {{"sheenColorFactor", {1, 0, 0}}}, rl::RL_FEATURE_SHEEN},
      {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}, rl::RL_FEATURE_ANISOTROPY},
      {"KHR_materials_iridescence", {{"iridescenceFactor", 1}}, rl::RL_FEATURE_IRIDESCENCE},
      {"KHR_materials_diffuse_transmission",
       {{"diffuseTransmissionFactor", 1}},
       rl::RL_FEATURE_DIFFUSE_TRANSMISSION}};
  for (const auto& [name, values, feature] : cases) {
    const Scene none = loadLayers({{name, json::object()}});
    EXPECT_EQ(none.materials[0].data.flags & rl::RL_MATERIAL_LAYERS, 0u) << name;
    EXPECT_TRUE(none.materials[0].closure.empty()) << name;
    EXPECT_EQ(scanFeatures(none) & rl::RL_FEATURE_LAYERS, 0u) << name;
    const Scene scene = loadLayers({{name, values}});
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.at(0);
    EXPECT_EQ(scanFeatures(scene) & rl::RL_FEATURE_LAYERS, feature) << name;
    EXPECT_NE(scanFeatures(scene) & rl::RL_FEATURE_GLOSSY, 0u) << name;
    // An unlit material scatters nothing.
    const Scene unlit = loadLayers({{name, values}, {"KHR_materials_unlit", json::object()}});
    EXPECT_EQ(scanFeatures(unlit) & rl::RL_FEATURE_LAYERS, 0u) << name;
  }
}

TEST(GltfLayers, TexturesHaveTheirChannels) {
  GltfBuilder file;
  file.directory().write("tiny.png", test::tinyPng());
  file.add("images", {{"uri", "tiny.png"}});
  file.add("textures", {{"source", 0}});
  const json texture = {{"index", 0}};
  const Scene scene = loadLayers(
      file,
      {{"KHR_materials_clearcoat",
        {{"clearcoatFactor", 1},
         {"clearcoatTexture", texture},
         {"clearcoatRoughnessTexture", texture},
         {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.5}}}}},
       {"KHR_materials_sheen",
        {{"sheenColorFactor", {1, 1, 1}},
         {"sheenColorTexture", texture},
         {"sheenRoughnessTexture", texture}}},
       {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}, {"anisotropyTexture", texture}}},
       {"KHR_materials_iridescence",
        {{"iridescenceFactor", 1},
         {"iridescenceTexture", texture},
         {"iridescenceThicknessTexture", texture}}},
       {"KHR_materials_diffuse_transmission",
        {{"diffuseTransmissionFactor", 1},
         {"diffuseTransmissionTexture", texture},
         {"diffuseTransmissionColorTexture", texture}}}});
  const std::vector<std::tuple<uint32_t, uint32_t, bool>> expected = {
      {rl::RL_LAYER_CLEARCOAT, 0, false},
      {rl::RL_LAYER_CLEARCOAT_ROUGHNESS, 1, false},
      {rl::RL_LAYER_CLEARCOAT_NORMAL, 0, false},
      {rl::RL_LAYER_SHEEN_COLOR, 0, true},
      {rl::RL_LAYER_SHEEN_ROUGHNESS, 3, false},
      {rl::RL_LAYER_ANISOTROPY, 0, false},
      {rl::RL_LAYER_IRIDESCENCE, 0, false},
      {rl::RL_LAYER_FILM, 1, false},
      {rl::RL_LAYER_DIFFUSE_TRANSMISSION, 3, false},
      {rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR, 0, true}};
  for (const auto& [layer, channel, isSrgb] : expected) {
    const ClosureValue& value = scene.materials[0].closure.at(layer);
    ASSERT_NE(value.texture, rl::RL_INVALID) << layer;
    EXPECT_EQ(value.channel, channel) << layer;
    EXPECT_EQ(scene.textureUses.at(value.texture).srgb, isSrgb) << layer;
  }
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_CLEARCOAT_NORMAL).x, 0.5f);
  const rl::FeatureMask features = scanFeatures(scene);
  EXPECT_NE(features & rl::RL_FEATURE_TEXTURES, 0u);
  EXPECT_NE(features & rl::RL_FEATURE_NORMAL_MAPS, 0u) << "the coat has one";
}

TEST(GltfLayers, OutOfRangeIsDeclared) {
  const Scene scene = loadLayers(
      {{"KHR_materials_clearcoat", {{"clearcoatFactor", 2}}},
       {"KHR_materials_sheen", {{"sheenColorFactor", {-1, 0.5, 7}}}},
       {"KHR_materials_iridescence", {{"iridescenceFactor", 1}, {"iridescenceIor", 0.5}}}},
      {{"emissiveFactor", {1, 1, 1}}});
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_CLEARCOAT).x, 1.0f);
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_SHEEN_COLOR), glm::vec3(0.0f, 0.5f, 1.0f));
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_FILM).z, 1.0f);
  EXPECT_TRUE(warns(scene, "clearcoatFactor"));
  EXPECT_TRUE(warns(scene, "sheenColorFactor"));
  EXPECT_TRUE(warns(scene, "iridescenceIor"));
  EXPECT_TRUE(warns(scene, "its light is not darkened by the coat"));
}

// Beyond float32 the phase of a film has no cosine.
TEST(GltfLayers, FilmsBeyondAllMeasureAreLimited) {
  const Scene scene = loadLayers({{"KHR_materials_iridescence",
                                   {{"iridescenceFactor", 1},
                                    {"iridescenceIor", 1e20},
                                    {"iridescenceThicknessMinimum", 1e30},
                                    {"iridescenceThicknessMaximum", 1e30}}}});
  EXPECT_EQ(valueOf(scene, rl::RL_LAYER_FILM), glm::vec3(1e5f, 1e5f, 4.0f));
  for (const char* name : {"iridescenceIor: 4 is used instead of 1e+20",
                           "iridescenceThicknessMinimum: 100000 is used instead of 1e+30",
                           "iridescenceThicknessMaximum: 100000 is used instead of 1e+30"})
    EXPECT_TRUE(warns(scene, name)) << name;
}

TEST(GltfLayers, DispersionNeedsAVolume) {
  const json dispersion = {{"dispersion", 1}}, transmission = {{"transmissionFactor", 1}};
  const Scene opaque = loadLayers({{"KHR_materials_dispersion", dispersion}});
  EXPECT_TRUE(warns(opaque, "only a material that transmits and has a volume refracts"));
  EXPECT_EQ(opaque.materials[0].data.flags & rl::RL_MATERIAL_LAYERS, 0u);
  const Scene thin = loadLayers(
      {{"KHR_materials_dispersion", dispersion}, {"KHR_materials_transmission", transmission}});
  EXPECT_TRUE(warns(thin, "only a material that transmits and has a volume refracts"));
  const Scene wide = loadLayers({{"KHR_materials_dispersion", {{"dispersion", 100}}},
                                 {"KHR_materials_transmission", transmission},
                                 {"KHR_materials_volume", {{"thicknessFactor", 1}}}});
  EXPECT_TRUE(warns(wide, "39 is used instead of 100"));
  EXPECT_EQ(valueOf(wide, rl::RL_LAYER_DISPERSION).x, 39.0f);
}

}  // namespace
}  // namespace restlab
