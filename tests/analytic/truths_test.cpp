// The exact images: furnaces, and the floor under the tilted rectangle.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/analytic/furnace.h"
#include "tests/analytic/polygon_irradiance.h"
#include "tests/analytic/truths.h"

namespace restlab::analytic {
namespace {

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
    const std::vector<glm::dvec3> image = exactImage(scene, 5, 3, events);
    ASSERT_EQ(image.size(), 15u);
    for (const glm::dvec3& p : image) EXPECT_DOUBLE_EQ(p.x, 1.0 - std::exp2(-double(events) - 1.0));
  }
}

TEST(Truths, SphereFurnaceIsWhite) {
  const Scene scene = makeBuiltinScene("sphere-furnace");
  for (const glm::dvec3& p : exactImage(scene, 4, 4, 1)) EXPECT_EQ(p, glm::dvec3(1.0));
  EXPECT_THROW(exactImage(scene, 4, 4, 0), std::invalid_argument);
}

TEST(Truths, OnlyTheNamedScenesHaveAnExactImage) {
  for (const std::string& name : exactSceneNames()) {
    EXPECT_NO_THROW(exactImage(makeBuiltinScene(name), 2, 2, 1)) << name;
  }
  EXPECT_THROW(exactImage(makeBuiltinScene("cornell-box"), 2, 2, 1), std::invalid_argument);
}

// The same integral by brute force over the light's surface, without the polygon formula.
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
  const std::vector<glm::dvec3> coarse = exactImage(scene, 16, 9, 1);
  const std::vector<glm::dvec3> fine = exactImage(scene, 32, 18, 1);
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
  for (const glm::dvec3& p : exactImage(scene, 3, 2, 0)) EXPECT_EQ(p, glm::dvec3(0.0));
}

}  // namespace
}  // namespace restlab::analytic
