// Sun and sky by formula (Preetham, Shirley and Smits 1999).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/scene/textures/daylight.h"

namespace restlab {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

double daylightLuminance(const glm::vec3& c) {
  return 0.212639 * c.r + 0.715169 * c.g + 0.072192 * c.b;
}

// Illuminance (klx) of the map's upper or lower half on a plane that faces it.
double illuminanceOf(const EnvironmentMap& map, bool isUpper, bool isFacing) {
  double sum = 0.0;
  for (uint32_t y = 0; y < map.height; ++y) {
    const double top = kHalfTurn * y / map.height, bottom = kHalfTurn * (y + 1) / map.height;
    if ((2 * y < map.height) != isUpper) continue;
    const double solidAngle = 2.0 * kHalfTurn / map.width * (std::cos(top) - std::cos(bottom));
    const double cosine = isFacing ? std::abs(std::cos(0.5 * (top + bottom))) : 1.0;
    for (uint32_t x = 0; x < map.width; ++x)
      sum += daylightLuminance(map.radiance[size_t(y) * map.width + x]) * solidAngle * cosine;
  }
  return sum;
}

TEST(Daylight, ZenithIsThatOfThePaper) {
  // The paper's appendix by hand: turbidity 3, the sun half way up.
  const glm::dvec3 zenith = skyYxy({45.0, 0.0, 3.0, 0.0, 1.0}, {0.0, 1.0, 0.0});
  EXPECT_NEAR(zenith.x, 7.32, 0.01);
  EXPECT_NEAR(zenith.y, 0.2457, 1e-4);
  EXPECT_NEAR(zenith.z, 0.2515, 1e-4);
}

TEST(Daylight, IsBrightAboutTheSun) {
  const Daylight d{30.0, 90.0, 3.0, 0.2, 1.0};
  const double c = std::cos(kHalfTurn / 6.0);
  const double sunwards = skyYxy(d, {c, 0.5, 0.0}).x, opposite = skyYxy(d, {-c, 0.5, 0.0}).x;
  EXPECT_GT(sunwards, 4.0 * opposite) << "an azimuth of 90 degrees is +X";
  const EnvironmentMap map = daylightMap(d);
  const auto brightest = std::max_element(map.radiance.begin(), map.radiance.end(),
                                          [](const glm::vec3& a, const glm::vec3& b) {
                                            return daylightLuminance(a) < daylightLuminance(b);
                                          });
  const size_t at = size_t(brightest - map.radiance.begin());
  EXPECT_NEAR(double(at % map.width) / map.width, 0.75, 0.002);
  EXPECT_NEAR(double(at / map.width) / map.height, 60.0 / 180.0, 0.002);
}

TEST(Daylight, TheSunsLightDoesNotDependOnTheTexels) {
  const Daylight with{45.0, 20.0, 3.0, 0.0, 1.0}, without{45.0, 20.0, 3.0, 0.0, 0.0};
  double first = 0.0;
  for (const uint32_t height : {32u, 256u, 1024u}) {
    const double sun = illuminanceOf(daylightMap(with, 2 * height, height), true, false) -
                       illuminanceOf(daylightMap(without, 2 * height, height), true, false);
    if (first == 0.0) first = sun;
    EXPECT_NEAR(sun / first, 1.0, 2e-3) << height;
  }
  // A clear day's direct sun, facing it: 128 klx above the air.
  EXPECT_GT(first, 70.0);
  EXPECT_LT(first, 115.0);
}

TEST(Daylight, TheGroundScattersWhatArrives) {
  const EnvironmentMap map = daylightMap({60.0, 0.0, 4.0, 0.5, 1.0}, 512, 256);
  const double arrives = illuminanceOf(map, true, true), leaves = illuminanceOf(map, false, true);
  EXPECT_NEAR(leaves / arrives, 0.5, 2e-3);
}

TEST(Daylight, LowSunsAreRed) {
  const auto rednessOf = [](double elevation) {
    const EnvironmentMap with = daylightMap({elevation, 0.0, 3.0, 0.0, 1.0}, 512, 256);
    const EnvironmentMap without = daylightMap({elevation, 0.0, 3.0, 0.0, 0.0}, 512, 256);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < with.radiance.size(); ++i)
      sum += glm::dvec3(with.radiance[i] - without.radiance[i]);
    return sum.r / sum.b;
  };
  EXPECT_GT(rednessOf(5.0), 3.0 * rednessOf(60.0));
}

std::string daylightError(const std::string& name) {
  try {
    parseDaylight(name);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(Daylight, NamesAreReadOrRefused) {
  EXPECT_TRUE(isDaylightName("daylight"));
  EXPECT_TRUE(isDaylightName("daylight?turbidity=4"));
  EXPECT_FALSE(isDaylightName("daylight.hdr"));
  const Daylight d = parseDaylight("daylight?elevation=30&turbidity=4");
  EXPECT_EQ(d.elevation, 30.0);
  EXPECT_EQ(d.turbidity, 4.0);
  EXPECT_EQ(parseDaylight("daylight").turbidity, 3.0);
  EXPECT_EQ(daylightError("daylight?height=3"),
            "daylight?height=3: no parameter 'height'; elevation, azimuth, turbidity, ground and "
            "sun are there");
  EXPECT_EQ(daylightError("daylight?elevation=0"),
            "daylight?elevation=0: elevation is '0'; a number from 1 to 90 expected");
  EXPECT_EQ(daylightError("daylight?sun=nan"),
            "daylight?sun=nan: sun is 'nan'; a number from 0 to 1 expected");
  EXPECT_EQ(daylightError("daylight?sun=1&sun=1"), "daylight?sun=1&sun=1: 'sun' is given twice");
}

}  // namespace
}  // namespace restlab
