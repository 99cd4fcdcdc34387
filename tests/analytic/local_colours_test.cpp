// Colours of textures in `local`, and what is seen behind a partly transparent surface, against
// their formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/analytic/local_images.h"

namespace restlab {
namespace {

using analytic::imageOfLocal;
using Colour3 = glm::dvec3;

const Colour3 kMaterialColour(0.5, 0.25, 0.75), kVertexColour(0.8, 1.0, 0.4);
// The only texel, of 255: red, green, blue, alpha.
constexpr std::array<uint32_t, 4> kTexel = {204, 51, 102, 153};

// A square that fills the view, textured, before another one.
Scene texturedScene(double metallic, bool hasVertexColours) {
  builtin::SceneBuilder builder("textured");
  rl::Material material = builtin::lambert(glm::vec3(kMaterialColour));
  material.metallic = float(metallic);
  if (metallic > 0.0) {
    material.roughness = 0.5f;
    material.specular = 1.0f;
  }
  material.textures[rl::RL_TEX_BASE_COLOR] = 0;
  MeshGeometry square = builtin::quad("square", {-5, -5, -1}, {10, 0, 0}, {0, 10, 0});
  square.uvs[0].assign(square.positions.size(), glm::vec2(0.5f));
  if (hasVertexColours)
    square.colors.assign(square.positions.size(), glm::vec4(glm::vec3(kVertexColour), 1.0f));
  builder.add(square, builder.addMaterial("textured", material));
  builder.addCamera("eye", {0, 0, 0}, {0, 0, -1}, 45.0);
  Scene scene = builder.finish();
  TextureImage image;
  image.name = "texel";
  image.width = image.height = 1;
  image.texels = {kTexel[0] | (kTexel[1] << 8) | (kTexel[2] << 16) | (kTexel[3] << 24)};
  scene.images.push_back(image);
  scene.textureUses.emplace_back();
  return scene;
}

// The pixel under an ambient light of 1: the albedo, which is the combined colour.
Colour3 pixelOf(const Scene& scene, const std::string& combine) {
  const Image image = imageOfLocal(CompiledScene::build(scene),
                                   {{"texture_combine", combine}, {"ambient", 1.0}}, 1, 1);
  return {image.pixels[0]};
}

const std::map<std::string, Colour3 (*)(const Colour3&, const Colour3&, double)> kFormulas = {
    {"modulate", [](const Colour3& m, const Colour3& t, double) { return m * t; }},
    {"replace", [](const Colour3&, const Colour3& t, double) { return t; }},
    {"decal", [](const Colour3& m, const Colour3& t, double a) { return (1.0 - a) * m + a * t; }},
    {"add",
     [](const Colour3& m, const Colour3& t, double) { return glm::min(m + t, Colour3(1.0)); }}};

void expectFormula(const Scene& scene, const Colour3& material) {
  const Colour3 texel = Colour3(kTexel[0], kTexel[1], kTexel[2]) / 255.0;
  for (const auto& [combine, formula] : kFormulas) {
    const Colour3 expected = formula(material, texel, kTexel[3] / 255.0);
    const Colour3 found = pixelOf(scene, combine);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-5) << combine << " " << c;
  }
}

TEST(LocalTextures, AreCombinedByTheirFormula) {
  expectFormula(texturedScene(0.0, false), kMaterialColour);
  expectFormula(texturedScene(0.0, true), kMaterialColour * kVertexColour);
  // Metal: the colour is that of its reflection.
  expectFormula(texturedScene(1.0, false), kMaterialColour);
}

TEST(LocalTextures, WithoutOneTheMaterialStays) {
  Scene scene = texturedScene(0.0, true);
  scene.materials.at(0).data.textures[rl::RL_TEX_BASE_COLOR] = rl::RL_INVALID;
  for (const auto& [combine, formula] : kFormulas) {
    const Colour3 found = pixelOf(scene, combine);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[c], kMaterialColour[c] * kVertexColour[c], 1e-5) << combine;
  }
}

TEST(LocalTextures, OfWhatIsUnlitAreCombinedToo) {
  Scene scene = texturedScene(0.0, false);
  scene.materials.at(0).data.flags |= rl::RL_MATERIAL_UNLIT;
  expectFormula(scene, kMaterialColour);
}

// over: a square of coverage a before another one of coverage b before the background.
TEST(LocalTransparency, IsTheOperatorOver) {
  constexpr double kFirst = 0.3, kSecond = 0.6;
  const Colour3 first(0.9, 0.2, 0.1), second(0.1, 0.8, 0.3), behind(0.05, 0.1, 0.7);
  builtin::SceneBuilder builder("over");
  const auto add = [&](const char* name, const Colour3& colour, double alpha, double z) {
    rl::Material material = builtin::lambert(glm::vec3(colour));
    material.alpha = float(alpha);
    material.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
    builder.add(builtin::quad(name, {-50, -50, z}, {100, 0, 0}, {0, 100, 0}),
                builder.addMaterial(name, material));
  };
  add("first", first, kFirst, -1.0);
  add("second", second, kSecond, -2.0);
  builder.addCamera("eye", {0, 0, 0}, {0, 0, -1}, 45.0);
  Scene scene = builder.finish();
  scene.background = glm::vec3(behind);
  const Image image = imageOfLocal(CompiledScene::build(scene), {{"ambient", 1.0}}, 32, 32, 64);
  Colour3 sum(0.0);
  for (const glm::vec3& p : image.pixels) sum += Colour3(p) / double(image.pixels.size());
  const Colour3 farther = kSecond * second + (1.0 - kSecond) * behind;
  const Colour3 expected = kFirst * first + (1.0 - kFirst) * farther;
  // 65536 samples: a standard error of 0.0015.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 0.007) << c;
}

}  // namespace
}  // namespace restlab
