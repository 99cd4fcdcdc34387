// Layers of glTF's extensions: the densities that MIS and reuse go by are those of the draws.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/bias/independent_runs.h"
#include "tests/unit/layered.h"

namespace restlab::bias {
namespace {

// A room with a lamp before its ceiling, and a thing with each layer: cloth below a rough coat,
// brushed metal, a film, a leaf with a lamp behind it, glass that disperses.
std::shared_ptr<const CompiledScene> layeredRoom() {
  using namespace builtin;
  SceneBuilder builder("layered-room");
  const uint32_t wall = builder.addMaterial("wall", lambert({0.7f, 0.6f, 0.5f}));
  const uint32_t light = builder.addMaterial("lamp", lamp({4.0f, 4.0f, 4.0f}));
  const auto add = [&](const char* name, const rl::Material& base) {
    return builder.addMaterial(name, base);
  };
  const uint32_t cloth = add("cloth", lambert({0.4f, 0.1f, 0.1f}));
  const uint32_t brushed = add("brushed", metal({0.9f, 0.7f, 0.4f}, 0.5f));
  const uint32_t film = add("film", metal({0.5f, 0.5f, 0.5f}, 0.4f));
  const uint32_t leaf = add("leaf", plastic({0.3f, 0.6f, 0.2f}, 0.5f));
  const uint32_t prism = add("prism", glass(0.5f, glm::vec3(0.0f)));
  builder.add(insideOut(box("room", {-2.0, 0.0, -3.0}, {2.0, 3.0, 2.0})), wall);
  builder.add(quad("lamp", {-1.0, 2.9, -2.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0}), light);
  builder.add(box("cloth", {-1.6, 0.0, -2.6}, {-0.4, 1.0, -1.6}), cloth);
  builder.add(box("brushed", {0.4, 0.0, -2.6}, {1.6, 1.0, -1.6}), brushed);
  builder.add(box("film", {-0.3, 0.0, -1.8}, {0.3, 0.6, -1.2}), film);
  builder.add(quad("leaf", {-1.5, 0.2, -1.0}, {0.8, 0.0, 0.0}, {0.0, 1.2, 0.3}), leaf);
  builder.add(box("prism", {0.6, 0.0, -1.2}, {1.2, 0.8, -0.7}), prism);
  builder.addCamera("front", {0.0, 1.6, 1.7}, {0.0, 0.7, -1.5}, 60.0);
  Scene scene = builder.finish();
  const auto layer = [&](uint32_t material, const unit::Layers& layers) {
    rl::Material base = scene.materials[material].data;
    if (material == leaf) base.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    scene.materials[material] = unit::layered(base, layers);
  };
  layer(cloth, {.coat = 0.8f, .coatRoughness = 0.4f, .sheen = {0.6f, 0.6f, 0.9f}});
  layer(brushed, {.coat = 1.0f, .coatRoughness = 0.5f, .anisotropy = 0.8f, .rotation = 0.5f});
  layer(film, {.film = 1.0f, .thickness = 500.0f, .filmIor = 1.8f});
  layer(leaf, {.sheen = {0.2f, 0.2f, 0.2f}, .passing = 0.6f, .passingColor = {0.4f, 0.9f, 0.2f}});
  layer(prism, {.coat = 0.5f, .coatRoughness = 0.6f, .dispersion = 4.0f});
  return CompiledScene::build(std::move(scene));
}

Method weighted(double misExponent) {
  Method method = pathMethod(16);
  method.name = "template, mis_exponent " + std::to_string(misExponent);
  method.config.integrator = "template";
  method.config.parameters = {{"mis_exponent", misExponent}};
  return method;
}

void expectTechniquesAgree(size_t runs) {
  const auto scene = layeredRoom();
  const stats::Truth truth = stats::truthOf(independentRuns(scene, weighted(1.0), 1, runs));
  for (const Method& method :
       {weighted(8.0), pathMethod(16), restirMethod(8, 2), restirMethod(8, 2, {}, "restir_pt")}) {
    const stats::BiasReport report = testMethod(scene, method, truth, runs);
    EXPECT_FALSE(report.failed()) << method.name << ": " << report.text();
  }
}

TEST(MaterialLayers, TechniquesAgree) { expectTechniquesAgree(48); }
TEST(MaterialLayers, NightlyTechniquesAgree) { expectTechniquesAgree(512); }

}  // namespace
}  // namespace restlab::bias
