// The exact images: furnaces, and the floor under the tilted rectangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "experiments/truths/floor.h"
#include "experiments/truths/furnace.h"
#include "experiments/truths/polygon_irradiance.h"
#include "experiments/truths/quad_light.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {
namespace {

constexpr ExactView kSmall{.width = 2, .height = 2, .scatteringEvents = 1};
constexpr ExactView kDeep{.width = 2, .height = 2, .scatteringEvents = 16};

TEST(Furnace, SumsOfTheGeometricSeries) {
  EXPECT_EQ(furnaceRadiance(0.5, 0.5, 0), 0.5);
  EXPECT_EQ(furnaceRadiance(0.5, 0.5, 1), 0.75);
  EXPECT_EQ(furnaceRadiance(0.5, 0.5, 8), 1.0 - 1.0 / 512.0);
  EXPECT_EQ(furnaceRadianceLimit(0.5, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(furnaceRadiance(2.0, 1.0, 4), 10.0);
  EXPECT_NEAR(furnaceRadiance(0.3, 0.8, 200), furnaceRadianceLimit(0.3, 0.8), 1e-12);
}

TEST(Truths, FurnaceIsConstantAndMatchesItsSummary) {
  const Scene scene = makeBuiltinScene("furnace");
  for (const uint32_t events : {0u, 1u, 3u, 8u}) {
    const std::vector<glm::dvec3> image =
        exactImage(scene, {.width = 5, .height = 3, .scatteringEvents = events});
    ASSERT_EQ(image.size(), 15u);
    for (const glm::dvec3& p : image) EXPECT_DOUBLE_EQ(p.x, 1.0 - std::exp2(-double(events) - 1.0));
  }
}

TEST(Truths, SphereFurnaceIsWhite) {
  const Scene scene = makeBuiltinScene("sphere-furnace");
  for (const glm::dvec3& p : exactImage(scene, {.width = 4, .height = 4, .scatteringEvents = 1}))
    EXPECT_EQ(p, glm::dvec3(1.0));
  EXPECT_THROW(exactImage(scene, {.width = 4, .height = 4}), std::invalid_argument);
}

TEST(Truths, OnlyTheNamedScenesHaveAnExactImage) {
  for (const std::string& name : exactSceneNames()) {
    EXPECT_NO_THROW(exactImage(makeBuiltinScene(name), kDeep)) << name;
  }
  EXPECT_THROW(exactImage(makeBuiltinScene("cornell-box"), kSmall), std::invalid_argument);
}

// The camera may stand anywhere in the room, but not beyond its walls.
TEST(Truths, FurnaceNeedsACameraInside) {
  const Scene scene = makeBuiltinScene("furnace?wall=0.1");
  ExactView view = kSmall;
  view.moved = scene.cameras.front();
  view.moved->cameraToWorld[3] = glm::dvec4(-1.9, 0.1, -2.9, 1.0);
  EXPECT_EQ(whyNotExact(scene, view), "");
  view.moved->cameraToWorld[3].x = -2.05;
  EXPECT_EQ(whyNotExact(scene, view), "from a camera outside the room");
}

// The exact image follows the light factors.
TEST(Truths, FollowTheLights) {
  for (const std::string& name : exactSceneNames()) {
    Scene scene = makeBuiltinScene(name);
    const double before = exactImage(scene, kDeep)[0].y;
    for (SceneMaterial& material : scene.materials) material.lightFactor = 0.25f;
    if (scene.environment) scene.environment->lightFactor = 0.25f;
    EXPECT_DOUBLE_EQ(exactImage(scene, kDeep)[0].y, 0.25 * before) << name;
  }
}

TEST(Truths, FloorIsWhiteHoweverItIsCut) {
  for (const char* name : {"floor", "floor?triangles=0", "floor?triangles=1", "floor?triangles=50",
                           "floor?needle=100", "floor?copies=3", "floor?view=89.99"}) {
    const Scene scene = makeBuiltinScene(name);
    EXPECT_EQ(exactImage(scene, kSmall)[3], glm::dvec3(1.0)) << name;
    EXPECT_EQ(whyNotExact(scene, {.width = 2, .height = 2}), "at 0 scattering events");
  }
}

// Compares with brute force over the hemisphere: directions about the leaning normal, without those
// below the floor.
TEST(Truths, LeaningFloorAgainstQuadrature) {
  for (const double degrees : {10.0, 45.0, 80.0}) {
    const glm::dvec3 lean(std::sin(glm::radians(degrees)), std::cos(glm::radians(degrees)), 0.0);
    double sum = 0.0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double y = (i + 0.5) / n, phi = glm::two_pi<double>() * (j + 0.5) / n;
        const double r = std::sqrt(1.0 - y * y);
        sum += std::max(glm::dot(lean, {r * std::cos(phi), y, r * std::sin(phi)}), 0.0);
      }
    }
    const double returned = 2.0 * sum / (double(n) * n);  // 2 pi of the hemisphere over pi
    EXPECT_NEAR(leaningRadiance(lean.y), returned, 1e-5) << degrees;
    const Scene scene = makeBuiltinScene("floor?slope=" + std::to_string(degrees));
    // The map also leans slightly forwards.
    EXPECT_NEAR(exactImage(scene, kSmall)[0].x, returned, 2e-5) << degrees;
  }
}

// Bilinear between pixel centres, as docs/dialect.md defines it, summed over a fine grid.
TEST(Truths, SunlitFloorAgainstQuadrature) {
  constexpr uint32_t width = 32, height = 16, row = 3;
  constexpr double sun = 1000.0;
  const double h = glm::pi<double>() / height;
  double sum = 0.0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double theta = (i + 0.5) / n * 0.5 * glm::pi<double>();
    const double weight = std::max(0.0, 1.0 - std::abs(theta / h - (row + 0.5)));
    // Along a row the weights of a pixel add up to one pixel.
    const double ring =
        glm::two_pi<double>() * 1.0 + weight * (sun - 1.0) * glm::two_pi<double>() / width;
    sum += ring * std::cos(theta) * std::sin(theta) * 0.5 * glm::pi<double>() / n;
  }
  EXPECT_NEAR(sunlitRadiance(sun, (row + 0.5) * h, width, height) * glm::pi<double>() / sum, 1.0,
              1e-5);
  EXPECT_EQ(exactImage(makeBuiltinScene("floor?sun=1"), kSmall)[0], glm::dvec3(1.0));
  const double sunny = exactImage(makeBuiltinScene("floor?sun=1e6"), kSmall)[0].x;
  EXPECT_GT(sunny, 2.0) << "1e6 times 4e-5 sr";
  EXPECT_NEAR((exactImage(makeBuiltinScene("floor?sun=1e9"), kSmall)[0].x - 1.0) / (sunny - 1.0),
              1e3, 0.1);
}

// Compares one spot with a hand computation, and many spots with a shining disc.
TEST(Truths, SpotsAgainstADiscOfThem) {
  const Scene one = makeBuiltinScene("floor?spots=1");
  ASSERT_EQ(one.lights.size(), 1u);
  const glm::dvec3 lamp = one.lights[0].posW;
  const double below = double(one.lights[0].intensity.x) / (glm::pi<double>() * lamp.y * lamp.y);
  EXPECT_NEAR(spotlitRadiance(one.lights, {lamp.x, 0.0, lamp.z}).x, below, 1e-6);
  const Scene many = makeBuiltinScene("floor?spots=1e5");
  ASSERT_EQ(many.lights.size(), 100000u);
  double intensity = 0.0, sum = 0.0;
  for (const PunctualLight& spot : many.lights) intensity += double(spot.intensity.x);
  const glm::dvec3 posW(0.3, 0.0, -0.4);
  constexpr int n = 1000;
  const double cosOuter = std::cos(glm::radians(70.0));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double r = 4.0 * std::sqrt((i + 0.5) / n), phi = glm::two_pi<double>() * (j + 0.5) / n;
      const glm::dvec3 d = glm::dvec3(r * std::cos(phi), 2.0, r * std::sin(phi)) - posW;
      const double cosine = d.y / glm::length(d);
      const double cone = std::max(0.0, (cosine - cosOuter) / (1.0 - cosOuter));
      sum += cone * cone * cosine / glm::dot(d, d);
    }
  }
  const double expected = intensity * sum / (double(n) * n) / glm::pi<double>();
  EXPECT_NEAR(spotlitRadiance(many.lights, posW).x / expected, 1.0, 1e-3);
}

TEST(Truths, FloorOfOtherLightNeedsAViewOfItAlone) {
  const auto why = [](const std::string& name) {
    return whyNotExact(makeBuiltinScene(name), {.width = 16, .height = 9, .scatteringEvents = 1});
  };
  for (const char* name : {"floor?sun=1e6", "floor?spots=100", "floor?slope=30"})
    EXPECT_EQ(why(name), "") << name;
  for (const char* name : {"floor?sun=1e6&view=80", "floor?spots=100&fov=120"})
    EXPECT_EQ(why(name), "from a camera that sees more than the floor") << name;
  EXPECT_EQ(why("floor?slope=30&sun=10"), "of a slope under anything but a uniform sky");
  EXPECT_EQ(why("floor?sun=10&triangles=0"), "of a sky with a sun or spots, without the floor");
  EXPECT_EQ(why("floor?sun=10&triangles=1"), "of one triangle under anything but a uniform sky");
}

TEST(Truths, GlassNeedsManyEvents) {
  const Scene scene = makeBuiltinScene("floor?ior=1.5");
  ExactView view = kSmall;
  EXPECT_EQ(whyNotExact(scene, view), "of glass at fewer than 64 scattering events");
  view.scatteringEvents = 64;
  EXPECT_EQ(exactImage(scene, view)[0], glm::dvec3(1.0));
}

// The rectangle cut into triangles gives the same light; one of the triangles acts as a small
// light.
TEST(Truths, QuadLightOfManyTriangles) {
  const glm::dvec3 posW(0.4, 0.0, 0.6);
  const double whole = quadLightRadiance(makeBuiltinScene("quad-light"), posW).x;
  for (const char* name : {"quad-light?triangles=50", "quad-light?triangles=1e5"})
    EXPECT_NEAR(quadLightRadiance(makeBuiltinScene(name), posW).x / whole, 1.0, 1e-5) << name;
  const Scene scene = makeBuiltinScene("quad-light?triangles=1e5&ratio=1e10");
  const MeshGeometry* one = nullptr;
  for (const MeshGeometry& g : scene.geometries) {
    if (g.name == "brightest") one = &g;
  }
  ASSERT_NE(one, nullptr);
  ASSERT_EQ(one->triangles.size(), 1u);
  const glm::dvec3 a(one->positions[0]), b(one->positions[1]), c(one->positions[2]);
  const glm::dvec3 area = 0.5 * glm::cross(b - a, c - a), d = (a + b + c) / 3.0 - posW;
  const double d2 = glm::dot(d, d), power = 10.0 * 1.5;  // radiance times area
  const double expected =
      0.5 / glm::pi<double>() * power * d.y * -glm::dot(d, glm::normalize(area)) / (d2 * d2);
  EXPECT_NEAR(quadLightRadiance(scene, posW).x / expected, 1.0, 1e-4);
}

// For every albedo, compares the sum with the recursion of radiance and with the closed form.
TEST(Truths, FurnacesOfEveryAlbedo) {
  for (const char* albedo : {"0", "0.5", "0.9", "0.99", "0.999", "0.9999", "1"}) {
    const Scene scene = makeBuiltinScene(std::string("furnace?albedo=") + albedo);
    const double a = double(float(std::stod(albedo)));
    for (const uint32_t events : {0u, 8u, 64u, 512u}) {
      double radiance = 0.5;
      for (uint32_t n = 0; n < events; ++n) radiance = 0.5 + a * radiance;
      const double closed =
          a == 1.0 ? 0.5 * (events + 1.0) : 0.5 * (1.0 - std::pow(a, events + 1.0)) / (1.0 - a);
      EXPECT_NEAR(closed / radiance, 1.0, 1e-9);
      const std::vector<glm::dvec3> image =
          exactImage(scene, {.width = 2, .height = 1, .scatteringEvents = events});
      EXPECT_NEAR(image[1].y / radiance, 1.0, 1e-9) << albedo << " " << events;
    }
  }
}

TEST(Truths, SphereFurnaceOfMetalNeedsItsCompensation) {
  const Scene scene = makeBuiltinScene("sphere-furnace?roughness=0.5");
  ExactView view = kSmall;
  EXPECT_THROW(exactImage(scene, view), std::invalid_argument);
  view.multiscatter = true;
  EXPECT_EQ(exactImage(scene, view)[0], glm::dvec3(1.0));
  // A mirror loses no light.
  EXPECT_EQ(exactImage(makeBuiltinScene("sphere-furnace?roughness=0"), kSmall)[0], glm::dvec3(1.0));
}

// Limits of the light's size: a point, by the inverse square, and an endless plane, which fills (1
// + cos) / 2 of the floor's cosine-weighted view.
TEST(Truths, QuadLightBetweenAPointAndAPlane) {
  const glm::dvec3 posW(0.4, 0.0, 0.6);
  const double pi = glm::pi<double>();
  for (const char* edge : {"1e-4", "1e-3", "1e-2"}) {
    const Scene scene = makeBuiltinScene(std::string("quad-light?edge=") + edge);
    const glm::dvec3 center(0.3, 2.0, -0.2), d = center - posW;
    const auto& p = scene.geometries.at(1).positions;
    const glm::dvec3 normal = glm::normalize(
        glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[3]) - glm::dvec3(p[0])));
    const double d2 = glm::dot(d, d), factor = d.y * -glm::dot(d, normal) / (d2 * d2);
    // 1.5 m^2 of radiance 10 at edge 1; the power stays the same.
    const double expected = 0.5 / pi * 10.0 * 1.5 * factor;
    // Corners are floats: those of the smallest light are off by 1e-7 / 1e-4 of its edge.
    EXPECT_NEAR(quadLightRadiance(scene, posW).x / expected, 1.0, 3e-3) << edge;
  }
  const Scene wide = makeBuiltinScene("quad-light?edge=1e3");
  const double tilt = std::cos(glm::radians(12.0));
  EXPECT_NEAR(quadLightRadiance(wide, posW).x / (0.5 * 10.0 * 1e-6 * (1.0 + tilt) / 2.0), 1.0,
              1e-3);
}

TEST(Truths, QuadLightNeedsAViewOfTheFloorAlone) {
  const auto why = [](const std::string& name, uint32_t camera) {
    return whyNotExact(makeBuiltinScene(name),
                       {.camera = camera, .width = 16, .height = 9, .scatteringEvents = 1});
  };
  EXPECT_EQ(why("quad-light", 0), "");
  EXPECT_EQ(why("quad-light?edge=1e-4", 0), "");
  EXPECT_EQ(why("quad-light?edge=3", 0), "from a camera that sees the light");
  for (const char* edge : {"1e-4", "0.1", "1", "3", "10", "100", "1e3"})
    EXPECT_EQ(why(std::string("quad-light?edge=") + edge, 1), "") << edge;
  EXPECT_EQ(why("quad-light?fov=120", 1), "from a camera that sees more than the floor");
}

// Compares with brute force over the light's surface, without the polygon formula.
TEST(Truths, QuadLightAgainstQuadrature) {
  const Scene scene = makeBuiltinScene("quad-light");
  const MeshGeometry* light = nullptr;
  for (const MeshGeometry& g : scene.geometries) {
    if (g.name == "light") light = &g;
  }
  ASSERT_NE(light, nullptr);
  const glm::dvec3 corner(light->positions[0]);
  const glm::dvec3 u = glm::dvec3(light->positions[1]) - corner;
  const glm::dvec3 v = glm::dvec3(light->positions[3]) - corner;
  const glm::dvec3 area = glm::cross(u, v);
  for (const glm::dvec3& posW : {glm::dvec3(0.0), glm::dvec3(1.5, 0, -2), glm::dvec3(-3, 0, 1)}) {
    double sum = 0.0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const glm::dvec3 d = corner + u * ((i + 0.5) / n) + v * ((j + 0.5) / n) - posW;
        const double d2 = glm::dot(d, d);
        sum += d.y * -glm::dot(d, area) / (d2 * d2 * n * n);
      }
    }
    const glm::dvec3 radiance = quadLightRadiance(scene, posW);
    EXPECT_NEAR(radiance.x, 0.5 * 10.0 / glm::pi<double>() * sum, 1e-5 * radiance.x);
    EXPECT_NEAR(radiance.z, 0.7 * 6.0 / glm::pi<double>() * sum, 1e-5 * radiance.z);
  }
}

TEST(Truths, QuadLightImageConverges) {
  const Scene scene = makeBuiltinScene("quad-light");
  // Four pixels of twice the resolution average to one: the quadrature of both must agree.
  const std::vector<glm::dvec3> coarse =
      exactImage(scene, {.width = 16, .height = 9, .scatteringEvents = 1});
  const std::vector<glm::dvec3> fine =
      exactImage(scene, {.width = 32, .height = 18, .scatteringEvents = 1});
  double brightest = 0.0;
  for (const glm::dvec3& p : coarse) brightest = std::max(brightest, p.y);
  EXPECT_GT(brightest, 0.1);
  for (size_t y = 0; y < 9; ++y) {
    for (size_t x = 0; x < 16; ++x) {
      const size_t i = 2 * y * 32 + 2 * x;
      const double mean = 0.25 * (fine[i].y + fine[i + 1].y + fine[i + 32].y + fine[i + 33].y);
      EXPECT_NEAR(coarse[y * 16 + x].y, mean, 1e-6 * brightest) << x << " " << y;
    }
  }
  for (const glm::dvec3& p : exactImage(scene, {.width = 3, .height = 2}))
    EXPECT_EQ(p, glm::dvec3(0.0));
}

}  // namespace
}  // namespace restlab::analytic
