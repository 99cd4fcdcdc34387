// KHR_materials_pbrSpecularGlossiness: values of the material, and known reflectances.
#include <gtest/gtest.h>

#include "core/backend/bsdf_probe.h"
#include "core/scene/content_hash.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using nlohmann::json;
using test::GltfBuilder;

constexpr const char* kSpecGloss = "KHR_materials_pbrSpecularGlossiness";

Scene loadSpecGloss(const json& extension, const json& more = json::object()) {
  GltfBuilder file;
  file.doc["extensionsUsed"] = {kSpecGloss, "KHR_texture_transform", "KHR_materials_ior",
                                "KHR_materials_unlit"};
  file.doc["images"] = {{{"uri", "a.png"}}};
  file.doc["textures"] = {{{"source", 0}}};
  file.directory().write("a.png", test::tinyPng());
  json material = {{"extensions", {{kSpecGloss, extension}}}};
  material.merge_patch(more);
  file.add("materials", material);
  const int uv = file.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  file.node({{"mesh", file.triangle({{"material", 0}, {"attributes", {{"TEXCOORD_0", uv}}}})}});
  return file.load();
}

TEST(GltfSpecularGlossiness, Factors) {
  const rl::Material m =
      loadSpecGloss(
          {{"diffuseFactor", {0.5, 0.25, 0.125, 0.75}},
           {"specularFactor", {0.2, 0.4, 0.6}},
           {"glossinessFactor", 0.25}},
          {{"alphaMode", "BLEND"},
           {"pbrMetallicRoughness", {{"metallicFactor", 1}, {"baseColorFactor", {1, 0, 0, 1}}}}})
          .materials.at(0)
          .data;
  EXPECT_EQ(m.baseColor, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(m.alpha, 0.75f);
  EXPECT_EQ(m.metallic, 0.0f);
  EXPECT_EQ(m.roughness, 0.75f);
  EXPECT_EQ(m.ior, 0.0f);
  EXPECT_EQ(m.specular, 1.0f);
  EXPECT_EQ(m.specularColor, glm::vec3(0.2f, 0.4f, 0.6f));
  const rl::Material none = loadSpecGloss(json::object()).materials.at(0).data;
  EXPECT_EQ(none.baseColor, glm::vec3(1.0f));
  EXPECT_EQ(none.specularColor, glm::vec3(1.0f));
  EXPECT_EQ(none.roughness, 0.0f);
}

// At normal incidence: D = 1 / (pi alpha^2), no masking, F the specular colour itself; the diffuse
// colour loses the largest channel of F on the way in and out, over its mean.
TEST(GltfSpecularGlossiness, ReflectanceAtNormalIncidence) {
  const Scene scene = loadSpecGloss({{"diffuseFactor", {0.5, 0.25, 0.125, 1}},
                                     {"specularFactor", {0.2, 0.4, 0.6}},
                                     {"glossinessFactor", 0.25}});
  const BsdfProbe probe(scene.materials.at(0), scene);
  const glm::dvec3 up(0, 0, 1), specular(0.2, 0.4, 0.6), diffuse(0.5, 0.25, 0.125);
  double pdf = 0.0;
  const glm::dvec3 found = probe.eval(up, up, pdf);
  const double pi = 3.14159265358979, alpha = 0.75 * 0.75, most = 0.6;
  const double share = (1 - most) * (1 - most) / (1 - (most + (1 - most) / 21));
  const glm::dvec3 expected = specular / (4 * pi * alpha * alpha) + diffuse * (share / pi);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1.0, 1e-5) << c;

  const Scene mirror =
      loadSpecGloss({{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {0.2, 0.4, 0.6}}});
  const BsdfDraw draw = BsdfProbe(mirror.materials.at(0), mirror).draw(up, 0.5, {0.5, 0.5});
  ASSERT_TRUE(draw.isDelta);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(draw.weight[c], specular[c], 1e-6) << c;
}

TEST(GltfSpecularGlossiness, TexturesAreConverted) {
  const json info = {{"index", 0},
                     {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
  const Scene scene = loadSpecGloss(
      {{"glossinessFactor", 0.5}, {"diffuseTexture", info}, {"specularGlossinessTexture", info}});
  const rl::Material& m = scene.materials.at(0).data;
  const auto use = [&](uint32_t slot) { return scene.textureUses.at(m.textures[slot]); };
  EXPECT_TRUE(use(rl::RL_TEX_BASE_COLOR).srgb);
  EXPECT_TRUE(use(rl::RL_TEX_SPECULAR_COLOR).srgb);
  const TextureUse rough = use(rl::RL_TEX_METALLIC_ROUGHNESS);
  EXPECT_FALSE(rough.srgb);
  EXPECT_EQ(rough.uvRow0.z, 0.5f) << "transformed as the texture it was made of";
  EXPECT_EQ(m.roughness, 1.0f);
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_NE(rough.image, use(rl::RL_TEX_SPECULAR_COLOR).image);
  // The image is red with alpha 255, and green with alpha 128: roughness 1 - 0.5 alpha.
  const std::vector<uint32_t>& texels = scene.images.at(rough.image).texels;
  EXPECT_EQ(texels.at(0) >> 8 & 255u, 128u);
  EXPECT_EQ(texels.at(1) >> 8 & 255u, 191u);
  const Scene dull = loadSpecGloss({{"glossinessFactor", 0}, {"specularGlossinessTexture", info}});
  EXPECT_EQ(dull.materials.at(0).data.roughness, 1.0f);
  EXPECT_EQ(dull.images.size(), 1u) << "no roughness to make";
}

TEST(GltfSpecularGlossiness, OtherMaterialsBesideIt) {
  const Scene two = loadSpecGloss({{"glossinessFactor", 0.25}},
                                  {{"extensions", {{"KHR_materials_ior", {{"ior", 2}}}}}});
  EXPECT_TRUE(test::warns(two,
                          "materials[0].extensions.KHR_materials_ior: is not read beside "
                          "KHR_materials_pbrSpecularGlossiness"));
  EXPECT_EQ(two.materials.at(0).data.ior, 0.0f);
  const Scene unlit =
      loadSpecGloss({{"diffuseFactor", {0, 0, 0, 1}}},
                    {{"extensions", {{"KHR_materials_unlit", json::object()}}},
                     {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}}}});
  EXPECT_TRUE(test::warns(unlit, "is not read beside KHR_materials_unlit"));
  EXPECT_EQ(unlit.materials.at(0).data.baseColor, glm::vec3(0.5f));
}

// A file that was drawn by its metallic-roughness before has other references now.
TEST(GltfSpecularGlossiness, ContentHashesAreNotThoseOfTheFallback) {
  for (const bool isUsed : {false, true}) {
    GltfBuilder file;
    if (isUsed) file.doc["extensionsUsed"] = {kSpecGloss};
    file.add("materials", {{"extensions", {{kSpecGloss, json::object()}}}});
    file.node({{"mesh", file.triangle({{"material", 0}})}});
    const Scene scene = file.load();
    const std::string text = file.doc.dump();
    const uint64_t ofText = hashBytes(text.data(), text.size(), 0);
    const uint64_t ofFiles = hashBytes(file.bytes().data(), file.bytes().size(), ofText);
    EXPECT_EQ(scene.contentHash != ofFiles, isUsed);
  }
}

}  // namespace
}  // namespace restlab
