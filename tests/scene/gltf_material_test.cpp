// Materials, textures and images.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/dialect/features.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::warns;

// A scene with one triangle, and its material.
struct Loaded {
  Scene scene;
  rl::Material data;
};

Loaded loadMaterial(GltfBuilder& file, const json& material,
                    const std::vector<std::string>& extensions = {}) {
  if (!extensions.empty()) file.doc["extensionsUsed"] = extensions;
  const int uv = file.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  file.add("materials", material);
  file.node({{"mesh", file.triangle({{"material", 0},
                                     {"attributes", {{"TEXCOORD_0", uv}, {"TEXCOORD_2", uv}}}})}});
  Loaded loaded{file.load(), {}};
  loaded.data = loaded.scene.materials.at(0).data;
  return loaded;
}

TEST(GltfMaterial, DefaultsAreTheSpecifications) {
  GltfBuilder file;
  file.add("materials", {{"name", "empty"}});
  file.node({{"mesh", file.triangle()}});
  file.node({{"mesh", file.triangle({{"material", 0}})}});
  const Scene scene = file.load();
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.instances[0].material, 1u) << "primitives without material take the default one";
  EXPECT_EQ(scene.instances[1].material, 0u);
  for (const SceneMaterial& material : scene.materials) {
    const rl::Material& data = material.data;
    EXPECT_EQ(data.baseColor, glm::vec3(1));
    EXPECT_EQ(data.metallic, 1.0f);
    EXPECT_EQ(data.roughness, 1.0f);
    EXPECT_EQ(data.ior, 1.5f);
    EXPECT_EQ(data.specular, 1.0f);
    EXPECT_EQ(data.specularColor, glm::vec3(1));
    EXPECT_EQ(data.emission, glm::vec3(0));
    EXPECT_EQ(data.alpha, 1.0f);
    EXPECT_EQ(data.alphaCutoff, 0.5f);
    EXPECT_EQ(data.transmission, 0.0f);
    EXPECT_EQ(data.sigmaAbsorption, glm::vec3(0));
    EXPECT_EQ(data.normalScale, 1.0f);
    EXPECT_EQ(data.flags, 0u);
    for (const uint32_t texture : data.textures) EXPECT_EQ(texture, rl::RL_INVALID);
  }
}

TEST(GltfMaterial, FactorsAndFlags) {
  GltfBuilder file;
  const json material = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
        {"metallicFactor", 0},
        {"roughnessFactor", 0.25}}},
      {"emissiveFactor", {1, 0.5, 0}},
      {"alphaMode", "MASK"},
      {"alphaCutoff", 0.75},
      {"doubleSided", true},
      {"extensions",
       {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
        {"KHR_materials_ior", {{"ior", 1.33}}},
        {"KHR_materials_specular", {{"specularFactor", 0}, {"specularColorFactor", {0.5, 1, 2}}}},
        {"KHR_materials_unlit", json::object()}}}};
  const Loaded loaded = loadMaterial(file, material,
                                     {"KHR_materials_emissive_strength", "KHR_materials_ior",
                                      "KHR_materials_specular", "KHR_materials_unlit"});
  EXPECT_EQ(loaded.data.baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(loaded.data.alpha, 0.4f);
  EXPECT_EQ(loaded.data.alphaCutoff, 0.75f);
  EXPECT_EQ(loaded.data.metallic, 0.0f);
  EXPECT_EQ(loaded.data.roughness, 0.25f);
  EXPECT_EQ(loaded.data.emission, glm::vec3(8, 4, 0));
  EXPECT_EQ(loaded.data.ior, 1.33f);
  EXPECT_EQ(loaded.data.specular, 0.0f) << "exactly: this is what makes a material Lambert";
  EXPECT_EQ(loaded.data.specularColor, glm::vec3(0.5f, 1, 2));
  EXPECT_EQ(loaded.data.flags,
            rl::RL_MATERIAL_ALPHA_MASK | rl::RL_MATERIAL_DOUBLE_SIDED | rl::RL_MATERIAL_UNLIT);
  EXPECT_TRUE(loaded.scene.warnings.empty()) << loaded.scene.warnings[0];
}

TEST(GltfMaterial, OpaqueIgnoresAlphaAndBlendKeepsIt) {
  for (const char* mode : {"OPAQUE", "BLEND"}) {
    GltfBuilder file;
    const Loaded loaded = loadMaterial(
        file,
        {{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}});
    const bool blend = std::string(mode) == "BLEND";
    EXPECT_EQ(loaded.data.alpha, blend ? 0.5f : 1.0f);
    EXPECT_EQ(loaded.data.flags, blend ? rl::RL_MATERIAL_ALPHA_BLEND : 0u);
  }
}

TEST(GltfMaterial, TransmissionIsThinWithoutThickness) {
  for (const double thickness : {-1.0, 0.0, 0.2}) {  // -1: no volume extension
    GltfBuilder file;
    json extensions = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};
    if (thickness >= 0.0) {
      extensions["KHR_materials_volume"] = {{"thicknessFactor", thickness},
                                            {"attenuationDistance", 0.5},
                                            {"attenuationColor", {1, 0.5, 0.25}}};
    }
    const Loaded loaded = loadMaterial(file, {{"extensions", extensions}},
                                       {"KHR_materials_transmission", "KHR_materials_volume"});
    EXPECT_EQ(loaded.data.transmission, 1.0f);
    EXPECT_EQ((loaded.data.flags & rl::RL_MATERIAL_THIN) != 0, thickness <= 0.0);
    const glm::vec3 expected =
        thickness > 0.0 ? glm::vec3(0, 2 * std::log(2.0f), 4 * std::log(2.0f)) : glm::vec3(0);
    EXPECT_LT(glm::length(loaded.data.sigmaAbsorption - expected), 1e-5f);
  }
}

TEST(GltfMaterial, ExtremeIndicesOfRefraction) {
  for (const bool transmits : {false, true}) {
    for (const double ior : {0.0, 4.0, 1e30}) {
      GltfBuilder file;
      const Loaded loaded = loadMaterial(
          file,
          {{"extensions",
            {{"KHR_materials_ior", {{"ior", ior}}},
             {"KHR_materials_transmission", {{"transmissionFactor", transmits ? 1 : 0}}}}}},
          {"KHR_materials_transmission", "KHR_materials_ior"});
      EXPECT_EQ(loaded.data.ior, transmits && ior > 4.0 ? 4.0f : float(ior));
      EXPECT_EQ(warns(loaded.scene, "4 is used instead of 1e+30"), transmits && ior > 4.0);
      EXPECT_EQ(warns(loaded.scene, "0 stands for full reflection"), transmits && ior == 0.0);
    }
  }
}

TEST(GltfMaterial, OutOfRangeFactorsAreDeclared) {
  GltfBuilder file;
  const Loaded loaded = loadMaterial(
      file, {{"emissiveFactor", {10, 0, -1}},
             {"pbrMetallicRoughness", {{"metallicFactor", 2}, {"roughnessFactor", -0.5}}}});
  EXPECT_EQ(loaded.data.emission, glm::vec3(10, 0, 0)) << "more than 1 is kept, negative is not";
  EXPECT_EQ(loaded.data.metallic, 1.0f);
  EXPECT_EQ(loaded.data.roughness, 0.0f);
  EXPECT_TRUE(
      warns(loaded.scene, "metallicFactor: 2 is out of range (0 to 1 expected); 1 is used"));
  EXPECT_TRUE(warns(loaded.scene, "roughnessFactor: -0.5 is out of range"));
  EXPECT_TRUE(warns(loaded.scene, "emissiveFactor[2]: -1 is out of range"));
  EXPECT_TRUE(warns(loaded.scene, "emissiveFactor: (10, 0, 0) exceeds 1; used as it is"));
}

TEST(GltfMaterial, LargeIntegersInExtensionsSurvive) {
  GltfBuilder file;
  const Loaded loaded = loadMaterial(
      file,
      {{"emissiveFactor", {1, 1, 1}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5000000000}}}}}},
      {"KHR_materials_emissive_strength"});
  EXPECT_EQ(loaded.data.emission, glm::vec3(5e9f));
}

// Adds the tiny image, a sampler and a texture that uses both.
void addTexture(GltfBuilder& file, const json& sampler = json::object()) {
  file.directory().write("tiny.png", test::tinyPng());
  file.add("images", {{"uri", "tiny.png"}, {"name", "tiny"}});
  file.add("samplers", sampler);
  file.add("textures", {{"source", 0}, {"sampler", 0}});
}

TEST(GltfTexture, EverySlotWithItsColorSpace) {
  GltfBuilder file;
  addTexture(file, {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  const json use = {{"index", 0}};
  const Loaded loaded = loadMaterial(
      file,
      {{"pbrMetallicRoughness", {{"baseColorTexture", use}, {"metallicRoughnessTexture", use}}},
       {"normalTexture", {{"index", 0}, {"scale", 0.5}, {"texCoord", 2}}},
       {"emissiveTexture", use},
       {"occlusionTexture", use},
       {"extensions",
        {{"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", use}}},
         {"KHR_materials_specular",
          {{"specularTexture", use}, {"specularColorTexture", {{"index", 0}, {"texCoord", 2}}}}}}}},
      {"KHR_materials_transmission", "KHR_materials_specular"});
  ASSERT_EQ(loaded.scene.images.size(), 1u) << "decoded once";
  EXPECT_EQ(loaded.scene.images[0].name, "tiny");
  EXPECT_EQ(loaded.scene.images[0].width, 2u);
  EXPECT_EQ(loaded.scene.images[0].height, 1u);
  EXPECT_EQ(loaded.scene.images[0].texels[0], 0xff0000ffu);
  EXPECT_EQ(loaded.scene.images[0].texels[1], 0x8000ff00u);
  EXPECT_EQ(loaded.data.normalScale, 0.5f);
  for (uint32_t slot = 0; slot < rl::RL_TEX_COUNT; ++slot) {
    ASSERT_NE(loaded.data.textures[slot], rl::RL_INVALID) << slot;
    const TextureUse& texture = loaded.scene.textureUses.at(loaded.data.textures[slot]);
    const bool isColor = slot == rl::RL_TEX_BASE_COLOR || slot == rl::RL_TEX_EMISSIVE ||
                         slot == rl::RL_TEX_SPECULAR_COLOR;
    EXPECT_EQ(texture.srgb, isColor) << slot;
    EXPECT_EQ(texture.uvSet,
              slot == rl::RL_TEX_NORMAL || slot == rl::RL_TEX_SPECULAR_COLOR ? 2u : 0u);
    EXPECT_EQ(texture.wrapU, rl::RL_WRAP_CLAMP);
    EXPECT_EQ(texture.wrapV, rl::RL_WRAP_MIRROR);
    EXPECT_TRUE(texture.nearest);
  }
}

TEST(GltfTexture, TransformOffsetsRotatesAndScales) {
  GltfBuilder file;
  addTexture(file);
  const double angle = 0.39269908169872414;
  const auto info = [](const json& transform) {
    return json{{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  };
  const Loaded loaded =
      loadMaterial(file,
                   {{"pbrMetallicRoughness",
                     {{"baseColorTexture", info({{"rotation", angle}})},
                      {"metallicRoughnessTexture",
                       info({{"offset", {0.25, -1}}, {"scale", {2, 3}}, {"texCoord", 2}})}}}},
                   {"KHR_texture_transform"});
  const TextureUse& rotated =
      loaded.scene.textureUses.at(loaded.data.textures[rl::RL_TEX_BASE_COLOR]);
  // Corner that Khronos' TextureTransformTest marks as correct: (0.421, 1.016) lands on the
  // diagonal at 1.1, where the arrow points.
  const glm::vec3 corner(0.42095f, 1.01627f, 1.0f);
  EXPECT_NEAR(glm::dot(rotated.uvRow0, corner), 0.77782f, 1e-4f);
  EXPECT_NEAR(glm::dot(rotated.uvRow1, corner), 0.77782f, 1e-4f);
  const TextureUse& scaled =
      loaded.scene.textureUses.at(loaded.data.textures[rl::RL_TEX_METALLIC_ROUGHNESS]);
  EXPECT_EQ(scaled.uvRow0, glm::vec3(2, 0, 0.25f));
  EXPECT_EQ(scaled.uvRow1, glm::vec3(0, 3, -1));
  EXPECT_EQ(scaled.uvSet, 2u) << "the transform's texCoord goes first";
}

TEST(GltfTexture, ImagesFromDataUriBufferViewAndEscapedNames) {
  const std::string png = test::tinyPng();
  for (int kind = 0; kind < 3; ++kind) {
    GltfBuilder file;
    if (kind == 0) {
      file.add("images", {{"uri", "data:image/png;base64," + test::base64(png)}});
    } else if (kind == 1) {
      file.add("images", {{"bufferView", file.bufferView(png.data(), png.size())},
                          {"mimeType", "image/png"}});
    } else {
      file.directory().write("sub dir/\xe2\x99\xbb 50%+.png", png);
      file.add("images", {{"uri", "sub%20dir/%E2%99%BB%2050%25+.png"}});
    }
    file.add("textures", {{"source", 0}});
    const Loaded loaded =
        loadMaterial(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    ASSERT_EQ(loaded.scene.images.size(), 1u);
    EXPECT_EQ(loaded.scene.images[0].texels[1], 0x8000ff00u);
    EXPECT_TRUE(loaded.scene.warnings.empty()) << loaded.scene.warnings[0];
  }
}

TEST(GltfTexture, SixteenBitsAreRoundedWithAWarning) {
  GltfBuilder file;
  file.directory().write("deep.png", test::tinyPng16());
  file.add("images", {{"uri", "deep.png"}});
  file.add("textures", {{"source", 0}});
  const Loaded loaded =
      loadMaterial(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  // 0x01ff is 1.99 of 255 and rounds up to 2; 0x0080 is 0.498 and rounds down to 0.
  EXPECT_EQ(loaded.scene.images.at(0).texels[0], 0x7f0002ffu);
  EXPECT_TRUE(warns(loaded.scene, "rounded from 16 to 8 bits"));
}

TEST(GltfTexture, MissingUvsWarn) {
  GltfBuilder file;
  addTexture(file);
  const Loaded loaded = loadMaterial(
      file, {{"name", "m"},
             {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
  EXPECT_TRUE(warns(loaded.scene, "has no TEXCOORD_1, which its material 'm' reads"));
}

TEST(GltfTexture, ContentHashFollowsEveryFile) {
  const auto hash = [](const std::string& png, float x) {
    GltfBuilder file;
    file.directory().write("i.png", png);
    file.add("images", {{"uri", "i.png"}});
    file.node({{"mesh", file.mesh({{"attributes",
                                    {{"POSITION", file.accessor<float>({x, 0, 0, 1, 0, 0, 0, 1, 0},
                                                                       "VEC3")}}}})}});
    return file.load().contentHash;
  };
  const uint64_t first = hash(test::tinyPng(), 0.0f);
  EXPECT_EQ(first, hash(test::tinyPng(), 0.0f));
  EXPECT_NE(first, hash(test::tinyPng16(), 0.0f)) << "an image no material uses counts as well";
  EXPECT_NE(first, hash(test::tinyPng(), 0.5f));
}

// Loads a body of glass whose material has these extras.
Loaded loadBody(const json& extras) {
  GltfBuilder file;
  json material = {{"name", "amber"}, {"extras", extras}};
  material["pbrMetallicRoughness"]["metallicFactor"] = 0;
  material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                            {"KHR_materials_volume", {{"thicknessFactor", 1}}}};
  return loadMaterial(file, material, {"KHR_materials_transmission", "KHR_materials_volume"});
}

// Kinds of materials that glTF does not have, as Blender's custom properties carry them.
TEST(GltfMaterial, ExtrasChooseAKind) {
  GltfBuilder file;
  const Loaded metal = loadMaterial(
      file, {{"name", "m"},
             {"extras", {{"restlab", {{"kind", "conductor"}, {"metal", "Au"}, {"alpha", 0.25}}}}}});
  EXPECT_EQ(metal.data.closure, rl::RL_CLOSURE_CONDUCTOR);
  EXPECT_EQ(metal.scene.materials[0].closure.at(0).words.x, 3u);
  // A primitive without a material keeps glTF's, though a mixture has added its parts.
  GltfBuilder mixed;
  mixed.add("materials", {{"name", "a"}, {"extras", {{"restlab", {{"kind", "mirror"}}}}}});
  mixed.add("materials",
            {{"name", "b"},
             {"extras", {{"restlab", {{"kind", "mixture"}, {"first", "a"}, {"second", "a"}}}}}});
  mixed.node({{"mesh", mixed.triangle({{"material", 1}})}});
  mixed.node({{"mesh", mixed.triangle()}});
  const Scene both = mixed.load();
  EXPECT_EQ(both.materials.at(both.instances[0].material).data.closure, rl::RL_CLOSURE_MIXTURE);
  EXPECT_EQ(both.materials.at(both.instances[1].material).name, "default");
  const struct {
    json restlab;
    const char* line;
  } cases[] = {
      {{{"kind", "conductr"}},
       "materials[0].extras.restlab:2:10: unknown kind 'conductr', did you mean 'conductor'?"},
      {"gold", "materials[0].extras.restlab: is not an object"},
      {{{"kind", {{"a", 1}}}}, "materials[0].extras.restlab.kind: is neither a number"},
      {{{"kind", "mirror"}, {"color", 2}}, "'color' must be"},
      {{{"kind", "mirror"}, {"include", "x.toml"}}, "extras.restlab.include: is no parameter"},
  };
  for (const auto& c : cases) {
    GltfBuilder bad;
    try {
      loadMaterial(bad, {{"extras", {{"restlab", c.restlab}}}});
      ADD_FAILURE() << c.line;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      EXPECT_NE(std::string(error.what()).find(c.line), std::string::npos) << error.what();
    }
  }
}

TEST(GltfMaterial, PrioritiesAreWholeNumbers) {
  for (const int number : {0, 1, -3, 1'000'000, -1'000'000}) {
    const Loaded loaded = loadBody({{"priority", number}, {"other", {1, {2, {3}}}}});
    EXPECT_EQ(loaded.scene.materials[0].priority, number);
    EXPECT_TRUE(loaded.scene.warnings.empty()) << loaded.scene.warnings[0];
  }
  EXPECT_EQ(loadBody({{"priority", 2.0}}).scene.materials[0].priority, 2) << "written as 2.0";
  for (const auto& extras : {json(), json(7), json("priority"), json({"priority"}), json::object()})
    EXPECT_TRUE(loadBody(extras).scene.warnings.empty()) << extras;
}

TEST(GltfMaterial, PrioritiesOfNoUseAreSaid) {
  json deep = 1;
  for (int i = 0; i < 100; ++i) deep = json{{"a", deep}};
  for (const json& value :
       {json("x"), json("1"), json(1e12), json(-1e300), json(UINT64_MAX), json(1'000'001),
        json(0.5), json(true), json({1}), deep, json(std::string(100'000, 'x'))}) {
    const Loaded loaded = loadBody({{"priority", value}});
    EXPECT_EQ(loaded.scene.materials[0].priority, 0);
    ASSERT_EQ(loaded.scene.warnings.size(), 1u) << value.dump().substr(0, 40);
    const std::string& line = loaded.scene.warnings[0];
    EXPECT_NE(line.find("test.gltf: materials[0].extras.priority: "), std::string::npos) << line;
    EXPECT_NE(line.find("a whole number from -1000000 to 1000000 expected"), std::string::npos)
        << line;
    EXPECT_LT(line.size(), 300u);
  }
  // A material that transmits no light makes no body.
  GltfBuilder file;
  const Loaded loaded = loadMaterial(file, {{"extras", {{"priority", 1}}}});
  EXPECT_TRUE(warns(loaded.scene, "materials[0].extras.priority: has no effect"));
}

}  // namespace
}  // namespace restlab
