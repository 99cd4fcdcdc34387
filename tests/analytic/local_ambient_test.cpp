// Ambient light of `local`: the share of lamps, the steps of the presets, and occlusion in screen
// space against an integral over the points that it looks at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/analytic/local_images.h"

namespace restlab {
namespace {

using analytic::floorPoint;
using analytic::imageOfLocal;
using builtin::SceneBuilder;
using Point3 = glm::dvec3;

constexpr double kPiHere = 3.14159265358979323846;

ParameterMap named(const std::string& name, const std::string& value, ParameterMap more = {}) {
  more[name] = value;
  return more;
}

// A floor under point lights with attenuations of their own.
struct LitFloor {
  Scene scene;
  std::shared_ptr<const CompiledScene> compiled;

  explicit LitFloor(size_t lamps = 3) : scene(make(lamps)) {
    compiled = CompiledScene::build(scene);
  }

  static constexpr double kGrey = 0.6;

  static Scene make(size_t lamps) {
    SceneBuilder builder("lit floor");
    builder.add(builtin::quad("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
                builder.addMaterial("grey", builtin::lambert(glm::vec3(float(kGrey)))));
    for (size_t i = 0; i < lamps; ++i) {
      PunctualLight light;
      light.posW = {std::sin(2.0 * double(i)), 1.0 + 0.3 * double(i % 5),
                    std::cos(3.0 * double(i))};
      light.intensity = glm::vec3(2.0f + float(i % 3));
      light.attenuation = {0.2f * float(i % 3), 0.5f * float(i % 2), 1.0f + 0.25f * float(i % 4)};
      builder.addLight(light);
    }
    builder.addCamera("eye", {0.5, 2.5, 3.0}, {0, 0, 0}, 45.0);
    return builder.finish();
  }

  // Irradiance of all lamps at a point, with the cosine or without.
  double irradiance(const Point3& p, bool hasCosine) const {
    double sum = 0.0;
    for (const PunctualLight& light : scene.lights) {
      const double r = glm::length(light.posW - p);
      const glm::dvec3 c(light.attenuation);
      const double fallen = double(light.intensity.x) / (c.x + c.y * r + c.z * r * r);
      sum += fallen * (hasCosine ? (light.posW.y - p.y) / r : 1.0);
    }
    return sum;
  }
};

constexpr uint32_t kFloorWidth = 32, kFloorHeight = 24;

// Compares every pixel of the floor.
template <class Expected>
void expectFloor(const LitFloor& floor, const ParameterMap& parameters, Expected expected) {
  const Image image = imageOfLocal(floor.compiled, parameters, kFloorWidth, kFloorHeight);
  size_t compared = 0;
  for (uint32_t y = 0; y < kFloorHeight; ++y) {
    for (uint32_t x = 0; x < kFloorWidth; ++x) {
      const auto p = floorPoint(floor.scene.cameras.at(0), x, y, kFloorWidth, kFloorHeight, 1.999);
      if (!p) continue;
      const double truth = expected(*p);
      ASSERT_NEAR(double(image.at(x, y).x), truth, 2e-5 * truth) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 300u);
}

// No noise: the sum of 1 / (C0 + C1 r + C2 r^2).
TEST(LocalLamps, ASampleOfEachLightIsTheirSum) {
  const LitFloor floor;
  expectFloor(floor, {{"light_samples", int64_t{0}}}, [&](const Point3& p) {
    return LitFloor::kGrey / kPiHere * floor.irradiance(p, true);
  });
}

// 64 draws have the mean of 70 lamps.
TEST(LocalLamps, MoreLightsThanSamplesAreDrawnFrom) {
  const LitFloor many(70);
  const Image image =
      imageOfLocal(many.compiled, {{"light_samples", int64_t{0}}}, kFloorWidth, kFloorHeight, 16);
  double sum = 0.0, truth = 0.0;
  for (uint32_t y = 0; y < kFloorHeight; ++y) {
    for (uint32_t x = 0; x < kFloorWidth; ++x) {
      const auto p = floorPoint(many.scene.cameras.at(0), x, y, kFloorWidth, kFloorHeight, 1.999);
      if (!p) continue;
      sum += double(image.at(x, y).x);
      truth += LitFloor::kGrey / kPiHere * many.irradiance(*p, true);
    }
  }
  EXPECT_NEAR(sum / truth, 1.0, 0.005);
}

// One of each light has the mean of draws: triangles, shapes, a sun and a sky, in mirrors as well.
TEST(LocalLamps, ASampleOfEachHasTheMeanOfDraws) {
  for (const char* name : {"shapes", "courtyard", "glass"}) {
    const auto scene = CompiledScene::build(makeBuiltinScene(name));
    const auto sumOf = [&](int64_t samples, int frames) {
      const ParameterMap parameters = {{"light_samples", samples},
                                       {"reflections", std::string("glossy")}};
      double sum = 0.0;
      for (const glm::vec3& p : imageOfLocal(scene, parameters, 32, 18, frames).pixels)
        sum += double(p.y);
      return sum;
    };
    EXPECT_NEAR(sumOf(0, 32) / sumOf(8, 32), 1.0, 0.02) << name;
  }
}

TEST(LocalLamps, LampsGiveAShareOfTheirBrightnessFromEverywhere) {
  const LitFloor floor;
  const ParameterMap share = {
      {"light_samples", int64_t{0}}, {"direct_light", false}, {"ambient_share", 0.2}};
  const auto ofShare = [&](const Point3& p) {
    return LitFloor::kGrey * 0.2 / kPiHere * floor.irradiance(p, false);
  };
  expectFloor(floor, share, ofShare);
  // Rays that meet nothing take none of it away.
  expectFloor(floor, named("occlusion", "rays", share), ofShare);
}

TEST(LocalPresets, AreStepsThatFollowOneAnother) {
  const LitFloor floor;
  const ParameterMap each = {{"light_samples", int64_t{0}}};
  const auto ambient = [&](const Point3& p) {
    return LitFloor::kGrey * 0.05 / kPiHere * floor.irradiance(p, false);
  };
  const auto all = [&](const Point3& p) {
    return ambient(p) + LitFloor::kGrey / kPiHere * floor.irradiance(p, true);
  };
  expectFloor(floor, named("preset", "ambient", each), ambient);
  for (const char* step : {"direct", "shadows", "occlusion", "reflections"})
    expectFloor(floor, named("preset", step, each), all);
  ParameterMap own = named("preset", "ambient", each);
  own["ambient"] = 0.3;
  expectFloor(floor, own, [](const Point3&) { return LitFloor::kGrey * 0.3; });
}

// In a scene where every step shows something, each changes the image as it says.
TEST(LocalPresets, EachStepChangesTheImageAsItSays) {
  const auto scene = CompiledScene::build(makeBuiltinScene("glossy-gallery"));
  const auto energy = [&](const std::string& preset, ParameterMap more = {}) {
    more["light_samples"] = int64_t{0};
    double sum = 0.0;
    for (const glm::vec3& p : imageOfLocal(scene, named("preset", preset, more), 32, 18, 4).pixels)
      sum += double(p.x + p.y + p.z);
    return sum;
  };
  const double ambient = energy("ambient"), direct = energy("direct"), shadows = energy("shadows"),
               occlusion = energy("occlusion"), reflections = energy("reflections");
  EXPECT_GT(direct, 1.5 * ambient);
  EXPECT_LT(shadows, 0.99 * direct);
  EXPECT_LT(occlusion, shadows);
  EXPECT_GT(reflections, occlusion);
  // Settings stay: a map's shadows, the screen's occlusion.
  EXPECT_NE(energy("occlusion", {{"occlusion", std::string("screen")}}), occlusion);
  EXPECT_NE(energy("shadows", {{"shadows", std::string("map")}}), shadows);
}

// A floor y = 0 before a wall z = -1, both wide, and an eye that sees both.
struct Corner {
  Scene scene;
  std::shared_ptr<const CompiledScene> compiled;
  static constexpr uint32_t kSize = 64;
  static constexpr double kRadius = 0.5;

  explicit Corner(const Point3& target, bool hasWall = true) : scene(make(target, hasWall)) {
    compiled = CompiledScene::build(scene);
  }

  static Scene make(const Point3& target, bool hasWall) {
    SceneBuilder builder("corner");
    const uint32_t white = builder.addMaterial("white", builtin::lambert(glm::vec3(0.5f)));
    builder.add(builtin::quad("floor", {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), white);
    if (hasWall) builder.add(builtin::quad("wall", {-20, 0, -1}, {40, 0, 0}, {0, 40, 0}), white);
    builder.addCamera("eye", {0, 1.6, 2.0}, target, 40.0);
    return builder.finish();
  }

  ParameterMap parameters(const std::string& occlusion) const {
    return {{"occlusion", occlusion},
            {"occlusion_rays", int64_t{64}},
            {"occlusion_radius", kRadius},
            {"ambient", 2.0}};
  }

  // Share of the points about a point of the floor that the screen hides: those behind the wall,
  // where the wall is near enough to the point along the ray from the eye, and in view.
  double hidden(const Point3& p) const {
    constexpr int kCells = 48;
    const SceneCamera& camera = scene.cameras.at(0);
    const Point3 eye = positionOf(camera);
    const glm::dmat4 toCamera = glm::inverse(camera.cameraToWorld);
    const double high = std::tan(0.5 * camera.yfov);
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        const double u = (i + 0.5) / kCells, angle = 2.0 * kPiHere * (j + 0.5) / kCells;
        const Point3 w(std::sqrt(u) * std::cos(angle), std::sqrt(1.0 - u),
                       std::sqrt(u) * std::sin(angle));
        for (int k = 0; k < kCells; ++k) {
          const Point3 q = p + w * (kRadius * (k + 0.5) / kCells);
          if (q.z > -1.0) continue;
          const Point3 seen = eye + (q - eye) * ((-1.0 - eye.z) / (q.z - eye.z));
          const Point3 local(toCamera * glm::dvec4(q, 1.0));
          const bool isInView = std::max(std::abs(local.x), std::abs(local.y)) < -local.z * high;
          if (seen.y > 0.0 && glm::length(seen - p) <= kRadius && isInView) sum += 1.0;
        }
      }
    }
    return sum / double(kCells * kCells * kCells);
  }
};

TEST(LocalScreen, TheWallHidesThePointsBehindIt) {
  const Corner corner({0, 0.2, -1});
  const Image screen =
      imageOfLocal(corner.compiled, corner.parameters("screen"), Corner::kSize, Corner::kSize, 8);
  const Image rays =
      imageOfLocal(corner.compiled, corner.parameters("rays"), Corner::kSize, Corner::kSize, 8);
  const uint32_t x = Corner::kSize / 2;
  size_t compared = 0;
  double most = 0.0;
  for (uint32_t y = 0; y < Corner::kSize; ++y) {
    const auto p = floorPoint(corner.scene.cameras.at(0), x, y, Corner::kSize, Corner::kSize, 20.0);
    if (!p || p->z < -0.98) continue;
    const double hidden = corner.hidden(*p);
    most = std::max(most, hidden);
    // The albedo is 1/2 and the light 2. 512 points: a standard error of 0.02.
    EXPECT_NEAR(1.0 - double(screen.at(x, y).x), hidden, 0.07) << p->z;
    // A ray to the wall is hidden wholly, a point on it only behind the wall.
    if (hidden > 0.1) {
      EXPECT_GT(screen.at(x, y).x, rays.at(x, y).x + 0.05f) << p->z;
    }
    ++compared;
  }
  EXPECT_GT(compared, 20u);
  EXPECT_GT(most, 0.2);
}

// Surfaces that the camera does not see hide nothing, and a plane does not hide itself.
TEST(LocalScreen, WhatIsOffTheScreenHidesNothing) {
  const auto mostHidden = [](const Corner& corner, const std::string& occlusion) {
    const Image image =
        imageOfLocal(corner.compiled, corner.parameters(occlusion), Corner::kSize, Corner::kSize);
    double least = 1.0;
    for (const glm::vec3& p : image.pixels) least = std::min(least, p.x > 0.0f ? double(p.x) : 1.0);
    return 1.0 - least;
  };
  const Corner plane({0, 0, -12}, false), away({0, 0, 1.0});
  EXPECT_LT(mostHidden(plane, "screen"), 1e-6);
  // The wall stands right behind the upper edge of the picture.
  EXPECT_LT(mostHidden(away, "screen"), 1e-6);
  EXPECT_GT(mostHidden(Corner({0, 0, -0.6}), "screen"), 0.05);
}

// A square before the eye, far from the floor behind it, leaves no dark rim on the floor.
TEST(LocalScreen, FarSurfacesInFrontHideNothing) {
  SceneBuilder builder("rim");
  const uint32_t white = builder.addMaterial("white", builtin::lambert(glm::vec3(0.5f)));
  builder.add(builtin::quad("floor", {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), white);
  builder.add(builtin::quad("square", {-0.1, 1.2, 0.1}, {0.2, 0, 0}, {0, 0, -0.2}), white);
  builder.addCamera("eye", {0, 2, 0.3}, {0, 0, 0}, 60.0);
  const auto scene = CompiledScene::build(builder.finish());
  const ParameterMap parameters = {{"occlusion", std::string("screen")},
                                   {"occlusion_rays", int64_t{64}},
                                   {"occlusion_radius", 0.5},
                                   {"ambient", 2.0}};
  for (const glm::vec3& p : imageOfLocal(scene, parameters, 48, 48).pixels)
    ASSERT_NEAR(p.x, 1.0f, 1e-6f);
}

}  // namespace
}  // namespace restlab
