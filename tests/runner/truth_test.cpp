// References that are known without rendering the measured scene: Truth::exact and Truth::same.
#include "experiments/runner/reference/truth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace restlab {

namespace {

SceneRequest requestOf(const std::string& scene, const std::string& camera = "") {
  SceneRequest request;
  request.scene = scene;
  request.camera = camera;
  return request;
}

ReferenceConfig smallConfig(uint32_t maxBounces = 4) {
  ReferenceConfig config;
  config.width = 6;
  config.height = 4;
  config.maxBounces = maxBounces;
  config.threads = 1;
  return config;
}

std::string why(Truth truth, const SceneRequest& request, const ReferenceConfig& config) {
  return whyNoTruth(truth, request, prepareScene(withoutRelations(request)), config);
}

TEST(Truth, ExactIsWithoutNoiseAndTimesTheRadiance) {
  const SceneRequest request = requestOf("furnace?albedo=0.75&radiance=2^20&scale=8&move=1e4");
  const PreparedScene plain = prepareScene(withoutRelations(request));
  ASSERT_EQ(whyNoTruth(Truth::exact, request, plain, smallConfig(3)), "");
  const Reference reference = exactReference(request, plain, smallConfig(3));
  // 1/2 (1 - 0.75^4) / (1 - 0.75)
  const double value = std::exp2(20.0) * 0.5 * (1.0 - std::pow(0.75, 4.0)) / 0.25;
  for (const glm::vec3& pixel : reference.mean.pixels)
    EXPECT_NEAR(double(pixel.x), value, 1e-6 * value);
  EXPECT_EQ(reference.half0->pixels, reference.mean.pixels);
  EXPECT_EQ(reference.half1->pixels, reference.mean.pixels);
  EXPECT_EQ(reference.relmse, 0.0);
  EXPECT_EQ(originOf(reference), "in closed form");
}

TEST(Truth, SameIsTheOtherOneTimesTheRadiance) {
  const PreparedScene plain = prepareScene(requestOf("quad-light"));
  const Reference rendered = renderReference(plain, smallConfig(1), {.spp = 4});
  const Reference twice = multiplied(rendered, 2.0);
  for (size_t i = 0; i < rendered.mean.pixels.size(); ++i) {
    EXPECT_EQ(twice.mean.pixels[i], 2.0f * rendered.mean.pixels[i]);
    EXPECT_EQ(twice.half1->pixels[i], 2.0f * rendered.half1->pixels[i]);
    EXPECT_EQ(twice.variance->pixels[i], 4.0f * rendered.variance->pixels[i]);
  }
  EXPECT_NE(originOf(twice).find("of quad-light, times 2, 4 spp"), std::string::npos)
      << originOf(twice);
}

TEST(Truth, WhatItIsNotKnownOfIsSaid) {
  const auto expectWhy = [](const std::string& said, const std::string& words) {
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expectWhy(why(Truth::exact, requestOf("cornell-box"), smallConfig()),
            "cornell-box has no exact image (scenes that have one: furnace, sphere-furnace, "
            "shape-furnace, floor, media, quad-light)");
  EXPECT_EQ(why(Truth::same, requestOf("cornell-box?scale=2"), smallConfig()), "");
  expectWhy(why(Truth::exact, requestOf("sphere-furnace"), smallConfig(0)),
            "at 0 scattering events");
  expectWhy(why(Truth::exact, requestOf("shape-furnace?kind=cone"), smallConfig(8)),
            "at less than 16 scattering events");
  expectWhy(why(Truth::exact, requestOf("sphere-furnace?roughness=0.5"), smallConfig()),
            "of rough metal without multiscatter");
  expectWhy(why(Truth::exact, requestOf("quad-light?fov=120"), smallConfig()),
            "a camera that sees more than the floor");
  expectWhy(why(Truth::exact, requestOf("quad-light?edge=10"), smallConfig()),
            "a camera that sees the light");
  EXPECT_EQ(why(Truth::exact, requestOf("quad-light?edge=1e3", "low"), smallConfig()), "");
  ReferenceConfig direct = smallConfig();
  direct.components = rl::RL_COMPONENT_DIRECT;
  expectWhy(why(Truth::exact, requestOf("furnace"), direct), "of the component all");
  ReferenceConfig center = smallConfig();
  center.pixelFilter = rl::RL_FILTER_CENTER;
  expectWhy(why(Truth::exact, requestOf("furnace"), center), "of the filter box");
  SceneRequest lit = requestOf("sphere-furnace");
  lit.environmentScale = 2.0;
  expectWhy(why(Truth::exact, lit, smallConfig()), "the environment is not the scene's own");
}

}  // namespace

}  // namespace restlab
