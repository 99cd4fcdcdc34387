#include "tests/unit/layer_cases.h"

#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/dialect_context.h"

namespace restlab::unit {
namespace {

using builtin::glass;
using builtin::lambert;
using builtin::metal;
using builtin::plastic;

const glm::vec3 kBrown(0.6f, 0.4f, 0.3f), kWhite(1.0f);

rl::Material transmittingBy(rl::Material m, float transmission, bool isThin) {
  m.transmission = transmission;
  if (isThin) m.flags |= rl::RL_MATERIAL_THIN;
  return m;
}

}  // namespace

LayerCase layerCase(const std::string& name, const SceneMaterial& material, bool isFront) {
  builtin::SceneBuilder builder("one quad");
  builder.add(builtin::quad("quad", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
              builder.addMaterial("material", lambert(glm::vec3(0.5f))));
  Scene scene = builder.finish();
  scene.materials[0] = material;
  LayerCase c{name, {}, CompiledScene::build(std::move(scene))};
  Dialect<> d(c.scene);
  const rl::Hit hit{0, 0, {0.25f, 0.25f}, 1.0f};
  c.bsdf = d->surfaceLoad(hit, {0.0f, 0.0f, isFront ? -1.0f : 1.0f}).bsdf;
  return c;
}

std::vector<LayerCase> continuousLayers() {
  std::vector<LayerCase> cases;
  const auto add = [&](const std::string& name, const rl::Material& base, const Layers& layers,
                       bool isFront = true) {
    cases.push_back(layerCase(name, layered(base, layers), isFront));
  };
  const rl::Material white = lambert(kWhite), brown = lambert(kBrown),
                     rough = plastic(kBrown, 0.5f), gold = metal(kWhite, 0.6f),
                     rod = glass(0.4f, glm::vec3(0.0f));
  for (const float roughness : {0.2f, 0.6f, 1.0f}) {
    const std::string name = "coat " + std::to_string(roughness).substr(0, 3);
    add(name + " over white", white, {.coat = 1.0f, .coatRoughness = roughness});
    add(name + " over plastic", rough, {.coat = 0.7f, .coatRoughness = roughness});
    add(name + " over metal", gold, {.coat = 1.0f, .coatRoughness = roughness});
    add(name + " over black", lambert(glm::vec3(0.0f)), {.coat = 1.0f, .coatRoughness = roughness});
  }
  add("coat over glass", rod, {.coat = 1.0f, .coatRoughness = 0.3f});
  add("coat beyond glass", rod, {.coat = 1.0f, .coatRoughness = 0.3f}, false);
  add("coat over thin glass", transmittingBy(plastic(kBrown, 0.4f), 1.0f, true),
      {.coat = 1.0f, .coatRoughness = 0.3f});
  for (const float roughness : {0.1f, 0.3f, 0.7f, 1.0f}) {
    const std::string name = "sheen " + std::to_string(roughness).substr(0, 3);
    add(name + " over white", white, {.sheen = kWhite, .sheenRoughness = roughness});
    add(name + " over plastic", rough, {.sheen = {0.2f, 0.9f, 0.4f}, .sheenRoughness = roughness});
    add(name + " over black", lambert(glm::vec3(0.0f)),
        {.sheen = kWhite, .sheenRoughness = roughness});
  }
  add("coat over sheen over white", white,
      {.coat = 1.0f, .coatRoughness = 0.4f, .sheen = kWhite, .sheenRoughness = 0.4f});
  for (const float strength : {0.3f, 1.0f}) {
    const std::string name = "anisotropy " + std::to_string(strength).substr(0, 3);
    add(name + " of metal", gold, {.anisotropy = strength, .rotation = 0.4f});
    add(name + " of plastic", rough, {.anisotropy = strength});
    add(name + " of glass", rod, {.anisotropy = strength, .rotation = 1.0f});
    add(name + " of glass, inside", rod, {.anisotropy = strength, .rotation = 1.0f}, false);
    add(name + " of thin glass", transmittingBy(plastic(kBrown, 0.4f), 1.0f, true),
        {.anisotropy = strength});
    add(name + " below a coat", gold,
        {.coat = 1.0f, .coatRoughness = 0.3f, .anisotropy = strength});
  }
  add("anisotropy of a smooth metal", metal(kWhite, 0.0f), {.anisotropy = 0.5f});
  for (const float thickness : {50.0f, 400.0f, 1200.0f}) {
    const std::string name = "film " + std::to_string(int(thickness));
    add(name + " over metal", metal({0.9f, 0.6f, 0.3f}, 0.5f),
        {.film = 1.0f, .thickness = thickness});
    add(name + " over white plastic", plastic(kWhite, 0.5f),
        {.film = 0.7f, .thickness = thickness});
    add(name + " over glass", rod, {.film = 1.0f, .thickness = thickness, .filmIor = 1.8f});
    add(name + " over glass, inside", rod, {.film = 1.0f, .thickness = thickness, .filmIor = 1.8f},
        false);
  }
  for (const float passing : {0.4f, 1.0f}) {
    const std::string name = "diffuse transmission " + std::to_string(passing).substr(0, 3);
    add(name + " of white", white, {.passing = passing});
    add(name + " of plastic", plastic(kWhite, 0.4f), {.passing = passing, .passingColor = kBrown});
    add(name + " below a coat and sheen", brown,
        {.coat = 1.0f, .coatRoughness = 0.5f, .sheen = kBrown, .passing = passing});
    add(name + " beside refraction", transmittingBy(plastic(kWhite, 0.4f), 0.5f, false),
        {.passing = passing});
    add(name + " beside refraction, inside", transmittingBy(plastic(kWhite, 0.4f), 0.5f, false),
        {.passing = passing}, false);
  }
  add("dispersion", rod, {.dispersion = 5.0f});
  add("dispersion, inside", rod, {.dispersion = 5.0f}, false);
  add("dispersion beside all", transmittingBy(plastic(kWhite, 0.4f), 0.5f, false),
      {.coat = 0.5f,
       .coatRoughness = 0.3f,
       .sheen = kBrown,
       .anisotropy = 0.5f,
       .film = 0.5f,
       .passing = 0.5f,
       .dispersion = 3.0f});
  return cases;
}

std::vector<LayerCase> deltaLayers() {
  std::vector<LayerCase> cases;
  const auto add = [&](const std::string& name, const rl::Material& base, const Layers& layers,
                       bool isFront = true) {
    cases.push_back(layerCase(name, layered(base, layers), isFront));
  };
  const rl::Material smooth = glass(0.0f, glm::vec3(0.0f));
  add("smooth coat over white", lambert(kWhite), {.coat = 1.0f});
  add("smooth coat over a mirror", metal(kWhite, 0.0f), {.coat = 1.0f});
  add("smooth coat over rough metal", metal(kWhite, 0.5f), {.coat = 1.0f});
  add("smooth coat over smooth glass", smooth, {.coat = 1.0f});
  add("smooth coat beyond smooth glass", smooth, {.coat = 1.0f}, false);
  add("rough coat over smooth glass", smooth, {.coat = 1.0f, .coatRoughness = 0.5f});
  add("film over a mirror", metal(kWhite, 0.0f), {.film = 1.0f});
  add("film over smooth glass", smooth, {.film = 1.0f});
  add("film over smooth glass, inside", smooth, {.film = 1.0f}, false);
  add("sheen over a mirror", metal(kWhite, 0.0f), {.sheen = kBrown});
  add("smooth dispersion", smooth, {.dispersion = 5.0f});
  add("smooth dispersion, inside", smooth, {.dispersion = 5.0f}, false);
  return cases;
}

}  // namespace restlab::unit
