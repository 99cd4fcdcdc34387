#include "core/scene/builtin/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace restlab::builtin {

glm::dvec3 skyRadiance(const Sky& sky, const glm::dvec3& dir) {
  if (dir.y < 0.0) return glm::dvec3(sky.ground);
  const double toSun = std::clamp(glm::dot(dir, sky.towardsSun), -1.0, 1.0);
  // Blue overhead, pale where the air is thick, warm and bright about the sun.
  const glm::dvec3 zenith(0.25, 0.50, 1.10), horizon(0.95, 1.10, 1.30), glow(1.60, 1.30, 0.95);
  const double haze = std::exp(-4.0 * dir.y);
  const double aureole = std::exp(8.0 * (toSun - 1.0)) + 4.0 * std::exp(90.0 * (toSun - 1.0));
  return glm::mix(zenith, horizon, haze) * (0.7 + 0.3 * toSun * toSun) + glow * aureole;
}

EnvironmentMap skyMap(const Sky& sky, uint32_t width, uint32_t height) {
  EnvironmentMap map;
  map.source = "analytic clear sky";
  map.width = width;
  map.height = height;
  map.radiance.resize(size_t(width) * height);
  const double pi = glm::pi<double>();
  double irradiance = 0.0;  // luminance, on a level plane
  for (uint32_t y = 0; y < height; ++y) {
    const double theta = pi * (y + 0.5) / height;  // from +Y
    const double solidAngle = (2.0 * pi / width) * (pi / height) * std::sin(theta);
    for (uint32_t x = 0; x < width; ++x) {
      const double phi = 2.0 * pi * ((x + 0.5) / width - 0.5);  // 0 along -Z, towards +X
      const glm::dvec3 dir(std::sin(theta) * std::sin(phi), std::cos(theta),
                           -std::sin(theta) * std::cos(phi));
      const glm::dvec3 radiance = skyRadiance(sky, dir);
      map.radiance[size_t(y) * width + x] = glm::vec3(radiance);
      const double luminance = glm::dot(radiance, glm::dvec3(0.2126, 0.7152, 0.0722));
      if (dir.y > 0.0) irradiance += luminance * dir.y * solidAngle;
    }
  }
  const float scale = float(pi / irradiance);
  for (glm::vec3& radiance : map.radiance) radiance *= scale;
  return map;
}

}  // namespace restlab::builtin
