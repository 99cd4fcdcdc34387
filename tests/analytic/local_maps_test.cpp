// Shadow maps of `local` against shadows that are computed here: a floor, a square above it, and a
// lamp of each kind.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/analytic/local_images.h"

namespace restlab {
namespace {

using analytic::floorPoint;
using analytic::imageOfLocal;
using builtin::SceneBuilder;
using Vec3 = glm::dvec3;

constexpr double kFloorHalf = 2.0, kSquareHalf = 0.4, kSquareHeight = 0.8, kAlbedo = 0.5;
const Vec3 kLampPlace(0.7, 2.3, 0.4);
constexpr uint32_t kMapWidth = 96, kMapHeight = 72;

enum class LampKind { point, spot, wideSpot, sun, area };

constexpr double kLampHalf = 0.05, kLampRadiance = 400.0;

struct Shadowed {
  Scene scene;
  std::shared_ptr<const CompiledScene> compiled;

  explicit Shadowed(LampKind kind, bool hasSquare = true) : scene(make(kind, hasSquare)) {
    compiled = CompiledScene::build(scene);
  }

  static Scene make(LampKind kind, bool hasSquare) {
    SceneBuilder builder("shadowed");
    const uint32_t grey = builder.addMaterial("grey", builtin::lambert(glm::vec3(float(kAlbedo))));
    builder.add(builtin::quad("floor", {-kFloorHalf, 0, kFloorHalf}, {2 * kFloorHalf, 0, 0},
                              {0, 0, -2 * kFloorHalf}),
                grey);
    if (hasSquare) {
      builder.add(builtin::quad("square", {-kSquareHalf, kSquareHeight, kSquareHalf},
                                {2 * kSquareHalf, 0, 0}, {0, 0, -2 * kSquareHalf}),
                  builder.addMaterial("black", builtin::lambert(glm::vec3(0.0f))));
    }
    if (kind == LampKind::area) {
      builder.add(builtin::quad("lamp", kLampPlace + Vec3(-kLampHalf, 0, -kLampHalf),
                                {2 * kLampHalf, 0, 0}, {0, 0, 2 * kLampHalf}),
                  builder.addMaterial("lamp", builtin::lamp(glm::vec3(float(kLampRadiance)))));
    } else {
      PunctualLight light;
      light.posW = kLampPlace;
      light.dirW = glm::normalize(-kLampPlace);
      light.intensity = glm::vec3(8.0f);
      light.kind = kind == LampKind::sun     ? rl::RL_LIGHT_DIRECTIONAL
                   : kind == LampKind::point ? rl::RL_LIGHT_POINT
                                             : rl::RL_LIGHT_SPOT;
      light.outerConeAngle = kind == LampKind::wideSpot ? 1.4f : 0.7f;
      light.innerConeAngle = 0.3f;
      builder.addLight(light);
    }
    builder.addCamera("eye", {0.3, 3.5, 2.5}, {0, 0, 0}, 55.0);
    return builder.finish();
  }

  // Whether the middle of the lamp sees a point of the floor: the segment between them misses the
  // square.
  static bool sees(LampKind kind, const Vec3& p) {
    const Vec3 to = kind == LampKind::sun ? kLampPlace : kLampPlace - p;
    const Vec3 at = p + to * (kSquareHeight / to.y);
    return std::abs(at.x) > kSquareHalf || std::abs(at.z) > kSquareHalf;
  }
};

ParameterMap mapped(int64_t size, int64_t filter = 0) {
  return {
      {"shadows", std::string("map")}, {"shadow_map_size", size}, {"shadow_map_filter", filter}};
}

struct MapError {
  double relMse = 0.0, energy = 0.0;
};

// Against the light without shadows, times what the lamp sees.
MapError errorOfMap(LampKind kind, const ParameterMap& parameters) {
  const Shadowed with(kind), without(kind, false);
  const Image found = imageOfLocal(with.compiled, parameters, kMapWidth, kMapHeight);
  const Image lit = imageOfLocal(without.compiled, {}, kMapWidth, kMapHeight);
  double squares = 0.0, sum = 0.0, truth = 0.0;
  size_t pixels = 0;
  for (uint32_t y = 0; y < kMapHeight; ++y) {
    for (uint32_t x = 0; x < kMapWidth; ++x) {
      const auto p = floorPoint(with.scene.cameras.at(0), x, y, kMapWidth, kMapHeight, kFloorHalf);
      const auto above = [&]() -> bool {  // the square hides the floor
        const Vec3 eye = positionOf(with.scene.cameras.at(0));
        const Vec3 at = *p + (eye - *p) * (kSquareHeight / eye.y);
        return std::abs(at.x) < kSquareHalf && std::abs(at.z) < kSquareHalf;
      };
      if (!p || above()) continue;
      const double value = double(lit.at(x, y).x) * (Shadowed::sees(kind, *p) ? 1.0 : 0.0);
      const double difference = double(found.at(x, y).x) - value;
      EXPECT_TRUE(std::isfinite(difference));
      squares += difference * difference;
      sum += double(found.at(x, y).x);
      truth += value;
      ++pixels;
    }
  }
  const double mean = truth / double(pixels);
  return {squares / double(pixels) / (mean * mean), sum / truth};
}

TEST(LocalMaps, TheErrorFallsWithTheTexels) {
  for (const LampKind kind : {LampKind::point, LampKind::spot, LampKind::wideSpot, LampKind::sun}) {
    SCOPED_TRACE(int(kind));
    const MapError coarse = errorOfMap(kind, mapped(32)), middle = errorOfMap(kind, mapped(128)),
                   fine = errorOfMap(kind, mapped(1024));
    const MapError rays = errorOfMap(kind, {});
    std::printf("  lamp %d: relMSE %.4f (32), %.4f (128), %.4f (1024), %.5f (rays); energy %.4f\n",
                int(kind), coarse.relMse, middle.relMse, fine.relMse, rays.relMse, fine.energy);
    EXPECT_LT(rays.relMse, 1e-9);
    EXPECT_LT(middle.relMse, 0.6 * coarse.relMse);
    EXPECT_LT(fine.relMse, 0.4 * middle.relMse);
    EXPECT_LT(fine.relMse, 0.01);
    EXPECT_NEAR(fine.energy, 1.0, 0.01);
  }
}

// Every surface is lit that nothing stands before, at the default bias; without one some shadow
// themselves.
TEST(LocalMaps, TheBiasIsEnoughAndIsNeeded) {
  for (const LampKind kind : {LampKind::point, LampKind::spot, LampKind::sun}) {
    for (const int64_t filter : {0, 1, 4}) {
      SCOPED_TRACE(int(kind) * 10 + int(filter));
      const Shadowed open(kind, false);
      const Image rays = imageOfLocal(open.compiled, {}, kMapWidth, kMapHeight);
      const auto differing = [&](ParameterMap parameters) {
        const Image map = imageOfLocal(open.compiled, parameters, kMapWidth, kMapHeight);
        size_t count = 0;
        for (size_t i = 0; i < map.pixels.size(); ++i)
          count += map.pixels[i] != rays.pixels[i] ? 1 : 0;
        return count;
      };
      ParameterMap biased = mapped(64, filter), unbiased = biased;
      unbiased["shadow_map_bias"] = 0.0;
      EXPECT_EQ(differing(biased), 0u);
      EXPECT_GT(differing(unbiased), 100u);
    }
  }
}

// A lamp with an area has the shadow of its middle.
TEST(LocalMaps, AnAreaHasTheHardShadowOfItsMiddle) {
  const Shadowed area(LampKind::area);
  ParameterMap parameters = mapped(1024);
  parameters["light_samples"] = int64_t{4};
  const Image found = imageOfLocal(area.compiled, parameters, kMapWidth, kMapHeight);
  const Image soft =
      imageOfLocal(area.compiled, {{"light_samples", int64_t{64}}}, kMapWidth, kMapHeight);
  size_t wrong = 0, dark = 0, penumbra = 0;
  for (uint32_t y = 0; y < kMapHeight; ++y) {
    for (uint32_t x = 0; x < kMapWidth; ++x) {
      const auto p = floorPoint(area.scene.cameras.at(0), x, y, kMapWidth, kMapHeight, kFloorHalf);
      if (!p || soft.at(x, y).x == 0.0f) continue;  // the black square
      const bool sees = Shadowed::sees(LampKind::area, *p);
      wrong += (found.at(x, y).x > 0.0f) != sees ? 1 : 0;
      dark += sees ? 0 : 1;
      penumbra += soft.at(x, y).x < 0.9f * found.at(x, y).x ? 1 : 0;
    }
  }
  EXPECT_LE(wrong, 4u);
  // Some of what has part of the light lies on either side of the hard edge.
  EXPECT_GT(dark, 10u);
  EXPECT_GT(penumbra, 10u);
}

// A lamp does not stand in its own light: a ball, as triangles and as a shape.
TEST(LocalMaps, ALampCastsNoShadowOfItself) {
  const auto sumOf = [](const std::shared_ptr<const CompiledScene>& scene, ParameterMap map) {
    map["light_samples"] = int64_t{8};
    double sum = 0.0;
    for (const glm::vec3& p : imageOfLocal(scene, map, 32, 24, 4).pixels) sum += double(p.y);
    return sum;
  };
  SceneBuilder builder("ball");
  builder.add(builtin::quad("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
              builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f))));
  builder.add(builtin::sphere("ball", {0, 1.5, 0}, 0.3, 2, false),
              builder.addMaterial("lamp", builtin::lamp(glm::vec3(30.0f))));
  builder.addCamera("eye", {0.3, 3.5, 2.5}, {0, 0, 0}, 55.0);
  const auto ball = CompiledScene::build(builder.finish());
  EXPECT_NEAR(sumOf(ball, mapped(64, 1)) / sumOf(ball, {}), 1.0, 0.02);
  const auto shapes = CompiledScene::build(makeBuiltinScene("shapes"));
  EXPECT_NEAR(sumOf(shapes, mapped(256, 1)) / sumOf(shapes, {}), 1.0, 0.05);
}

// Lamps for which there is no square have shadow rays.
TEST(LocalMaps, WithoutASquareThereAreRays) {
  const Shadowed point(LampKind::point);
  const Image rays = imageOfLocal(point.compiled, {}, kMapWidth, kMapHeight);
  ParameterMap parameters = mapped(16);
  const auto image = [&](int64_t squares) {
    parameters["shadow_maps"] = squares;
    return imageOfLocal(point.compiled, parameters, kMapWidth, kMapHeight).pixels;
  };
  EXPECT_EQ(image(5), rays.pixels);
  EXPECT_NE(image(6), rays.pixels);
}

// Ninths of the light, at edges alone.
TEST(LocalMaps, TheFilterCountsTexels) {
  const Shadowed point(LampKind::point), open(LampKind::point, false);
  const Image found = imageOfLocal(point.compiled, mapped(64, 1), kMapWidth, kMapHeight);
  const Image lit = imageOfLocal(open.compiled, {}, kMapWidth, kMapHeight);
  size_t partly = 0;
  for (size_t i = 0; i < found.pixels.size(); ++i) {
    if (!(lit.pixels[i].x > 0.0f)) continue;
    const double ninths = 9.0 * double(found.pixels[i].x) / double(lit.pixels[i].x);
    EXPECT_NEAR(ninths, std::round(ninths), 1e-3);
    partly += ninths > 0.5 && ninths < 8.5 ? 1 : 0;
  }
  EXPECT_GT(partly, 50u);
}

TEST(LocalMaps, AMapOfNoTexelsIsRefused) {
  const Shadowed point(LampKind::point);
  try {
    imageOfLocal(point.compiled, mapped(0), 4, 4);
    FAIL() << "it was rendered";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("shadow_map_size"), std::string::npos) << error.what();
  }
}

TEST(LocalMaps, ALightWithoutADirectionIsRefused) {
  for (const LampKind kind : {LampKind::sun, LampKind::spot}) {
    Scene scene = Shadowed::make(kind, true);
    scene.lights.at(0).dirW = glm::dvec3(0.0);
    EXPECT_THROW(CompiledScene::build(scene), Error);
  }
}

// A lamp within a surface lights nothing, and neither does none: black, never NaN.
TEST(LocalMaps, LampsThatLightNothingLeaveItBlack) {
  Scene inside = Shadowed::make(LampKind::point, true);
  inside.lights.at(0).posW = glm::dvec3(0.1, 0.0, 0.1);
  Scene none = Shadowed::make(LampKind::point, true);
  none.lights.clear();
  for (const Scene& scene : {inside, none}) {
    const Image image =
        imageOfLocal(CompiledScene::build(scene), mapped(16), kMapWidth, kMapHeight);
    for (const glm::vec3& p : image.pixels) ASSERT_EQ(p, glm::vec3(0.0f));
  }
}

}  // namespace
}  // namespace restlab
