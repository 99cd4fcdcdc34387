// Light factors: names of lights, effects of a factor, and properties that must stay.
#include "core/scene/compiled/light_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

using Names = std::vector<std::string>;

MeshGeometry square(const std::string& name, double x) {
  return builtin::quad(name, {x, 2.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0});
}

// Two lights of one material, one of another, a spot light and a floor.
Scene lamps() {
  builtin::SceneBuilder scene("lamps");
  const uint32_t warm = scene.addMaterial("warm", builtin::lamp({3.0f, 2.0f, 1.0f}));
  const uint32_t cold = scene.addMaterial("cold", builtin::lamp({1.0f, 2.0f, 3.0f}));
  scene.add(square("left", -2.0), warm);
  scene.add(square("middle", 0.0), warm);
  scene.add(square("right", 2.0), cold);
  scene.add(builtin::quad("floor", {-4.0, 0.0, -4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, 8.0}),
            scene.addMaterial("floor", builtin::lambert(glm::vec3(0.5f))));
  PunctualLight spot;
  spot.name = "spot";
  spot.kind = rl::RL_LIGHT_SPOT;
  scene.addLight(spot);
  scene.addCamera("camera", {0.0, 1.0, 5.0}, {0.0, 1.0, 0.0}, 45.0);
  return scene.finish();
}

std::string errorOf(const Scene& scene, const std::string& name, double factor = 0.0) {
  try {
    withLightFactor(scene, name, factor);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    return error.what();
  }
  return "";
}

float factorOf(const Scene& scene, size_t instance) {
  return scene.materials.at(scene.instances.at(instance).material).lightFactor;
}

// Selection probability of each light of the table.
std::vector<float> probabilities(const CompiledScene& scene) {
  std::vector<float> all;
  const size_t count = 2 * 3 + 1;
  for (size_t i = 0; i < count; ++i) all.push_back(scene.data().lights.data[i].pmf);
  return all;
}

TEST(LightFactor, NamesAreOfAllThatShines) {
  EXPECT_EQ(lightNames(lamps()), (Names{"cold", "left", "middle", "right", "spot", "warm"}));
  EXPECT_EQ(lightNames(makeBuiltinScene("courtyard")), (Names{"environment", "sun"}));
}

TEST(LightFactor, UnknownNamesNameTheNearest) {
  const std::string text = errorOf(lamps(), "midle");
  EXPECT_NE(text.find("'midle'"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean 'middle'"), std::string::npos) << text;
  EXPECT_NE(errorOf(lamps(), "floor"), "") << "it does not shine";
  EXPECT_NE(errorOf(lamps(), ""), "");
  EXPECT_NE(errorOf(lamps(), "left", -0.5).find("-0.5"), std::string::npos);
  EXPECT_NE(errorOf(lamps(), "left", 1e300), "") << "no float";
  EXPECT_EQ(errorOf(lamps(), "all"), "");
}

TEST(LightFactor, AMeshHasItsOwnOfASharedMaterial) {
  Scene scene = withLightFactor(lamps(), "left", 0.25);
  EXPECT_EQ(factorOf(scene, 0), 0.25f);
  EXPECT_EQ(factorOf(scene, 1), 1.0f);
  // A second factor makes no further copy; a factor on a material applies to all its meshes.
  const size_t materials = scene.materials.size();
  scene = withLightFactor(std::move(scene), "left", 0.5);
  EXPECT_EQ(scene.materials.size(), materials);
  EXPECT_EQ(factorOf(scene, 0), 0.5f) << "of what was loaded, not of 0.25";
  scene = withLightFactor(std::move(scene), "warm", 2.0);
  EXPECT_EQ(factorOf(scene, 0), 2.0f);
  EXPECT_EQ(factorOf(scene, 1), 2.0f);
  EXPECT_EQ(factorOf(scene, 2), 1.0f);
  EXPECT_EQ(lightFactors(scene), (std::vector<float>{2.0f, 2.0f, 1.0f, 1.0f, 1.0f}));
  EXPECT_TRUE(lightFactors(withLightFactor(scene, "all", 1.0)).empty());
}

// Reservoirs identify lights by index, and kernels by features: a light that is off keeps both.
TEST(LightFactor, ALampThatIsOffKeepsItsPlace) {
  const auto on = CompiledScene::build(lamps());
  const auto off = CompiledScene::build(withLightFactor(lamps(), "left", 0.0));
  const auto dark = CompiledScene::build(withLightFactor(lamps(), "all", 0.0));
  for (const auto& other : {off, dark}) {
    EXPECT_TRUE(other->differsInLightAlone(*on));
    EXPECT_EQ(other->features(), on->features());
  }
  EXPECT_EQ(off->data().lightCount, 7u);
  const std::vector<float> before = probabilities(*on), after = probabilities(*off);
  EXPECT_EQ(after[0], 0.0f);
  EXPECT_EQ(after[1], 0.0f);
  for (size_t i = 2; i < after.size(); ++i) EXPECT_GT(after[i], before[i]) << i;
  EXPECT_NEAR(std::accumulate(after.begin(), after.end(), 0.0f), 1.0f, 1e-6f);
  EXPECT_EQ(dark->data().lightCount, 0u) << "nothing is drawn";
  for (size_t i = 0; i < 7; ++i) EXPECT_EQ(dark->data().lights.data[i].radiance, glm::vec3(0.0f));
  EXPECT_FALSE(on->differsInLightAlone(*CompiledScene::build(makeBuiltinScene("cornell-box"))));
}

TEST(LightFactor, ScalesWhatKernelsRead) {
  const auto scene =
      CompiledScene::build(withLightFactor(withLightFactor(lamps(), "left", 0.5), "spot", 3.0));
  const rl::SceneData& data = scene->data();
  EXPECT_EQ(data.lights.data[0].radiance, glm::vec3(1.5f, 1.0f, 0.5f));
  EXPECT_EQ(data.lights.data[2].radiance, glm::vec3(3.0f, 2.0f, 1.0f));
  EXPECT_EQ(data.lights.data[6].radiance, glm::vec3(3.0f));
  EXPECT_EQ(data.materials.data[data.instances.data[0].material].emission,
            glm::vec3(1.5f, 1.0f, 0.5f));
  EXPECT_EQ(data.materials.data[data.instances.data[1].material].emission,
            glm::vec3(3.0f, 2.0f, 1.0f));
  const auto sky = CompiledScene::build(makeBuiltinScene("courtyard"));
  const auto dim =
      CompiledScene::build(withLightFactor(makeBuiltinScene("courtyard"), "environment", 0.5));
  EXPECT_EQ(dim->data().environment.data[1000], 0.5f * sky->data().environment.data[1000]);
  EXPECT_EQ(dim->data().environmentAlias.data[1000].pmf,
            sky->data().environmentAlias.data[1000].pmf);
}

}  // namespace
}  // namespace restlab
