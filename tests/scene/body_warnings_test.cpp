// Warnings about bodies that a path cannot follow as the author meant.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

using builtin::SceneBuilder;

rl::Material tinted() { return builtin::glass(0.0f, {1.0f, 0.5f, 0.2f}); }

size_t linesWith(Scene scene, const std::string& text) {
  const auto compiled = CompiledScene::build(std::move(scene));
  size_t count = 0;
  for (const std::string& line : compiled->warnings())
    count += line.find(text) != std::string::npos;
  return count;
}

Scene boxes(int count, const rl::Material& material) {
  SceneBuilder builder("boxes");
  const uint32_t index = builder.addMaterial("body", material);
  for (int i = 1; i <= count; ++i)
    builder.add(builtin::box("box", glm::dvec3(-i), glm::dvec3(i)), index);
  return builder.finish();
}

TEST(BodyWarnings, FacesThatPointInwards) {
  const auto facing = [](bool isInside) {
    SceneBuilder builder("box");
    const MeshGeometry box = builtin::box("box", {5, 5, 5}, {6, 6, 6});
    builder.add(isInside ? builtin::insideOut(box) : box, builder.addMaterial("body", tinted()));
    return builder.finish();
  };
  EXPECT_EQ(linesWith(facing(true), "'box' transmits light, and its faces point inwards"), 1u);
  EXPECT_EQ(linesWith(facing(false), "inwards"), 0u);
}

TEST(BodyWarnings, MoreBodiesThanAPathKnows) {
  EXPECT_EQ(linesWith(boxes(5, tinted()), "up to 5 bodies lie in each other"), 1u);
  EXPECT_EQ(linesWith(boxes(4, tinted()), "lie in each other"), 0u);
}

TEST(BodyWarnings, AFilmInSeveralMedia) {
  Scene scene = boxes(1, tinted());
  SceneCamera camera;
  camera.name = "wide";
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = 2.0;
  scene.cameras = {camera};
  EXPECT_EQ(linesWith(scene, "the film of camera 'wide' lies in several bodies"), 1u);
  scene.cameras[0].xmag = scene.cameras[0].ymag = 0.5;
  EXPECT_EQ(linesWith(scene, "the film of camera"), 0u);
}

TEST(BodyWarnings, LampsThatAreNotSeenThroughGlass) {
  Scene scene = boxes(1, tinted());
  EXPECT_EQ(linesWith(scene, "does not pass surfaces that transmit"), 0u);
  PunctualLight lamp;
  lamp.name = "bulb";
  scene.lights = {lamp};
  EXPECT_EQ(linesWith(scene, "light of 'bulb'"), 1u);
  EXPECT_EQ(linesWith(
                [&] {
                  Scene opaque = scene;
                  opaque.materials[0].data = builtin::lambert(glm::vec3(0.5f));
                  return opaque;
                }(),
                "light of 'bulb'"),
            0u);
}

TEST(ClearSurfaces, AreLeftOutWhereTheyDisplaceNothing) {
  rl::Material clear = builtin::glass(0.3f, glm::vec3(0.0f));
  clear.ior = 1.0f;
  const auto compiled = CompiledScene::build(boxes(1, clear));
  EXPECT_TRUE(compiled->source().instances.empty());
  EXPECT_EQ(linesWith(boxes(1, clear), "'box' has an index of refraction of 1 and no colour"), 1u);

  Scene bubble = boxes(2, tinted());
  bubble.materials.push_back({"clear", clear});
  bubble.instances[0].material = 1;
  EXPECT_EQ(CompiledScene::build(bubble)->source().instances.size(), 2u);

  rl::Material pink = clear;
  pink.baseColor.y = 0.9f;
  EXPECT_EQ(CompiledScene::build(boxes(1, pink))->source().instances.size(), 1u);
}

}  // namespace
}  // namespace restlab
