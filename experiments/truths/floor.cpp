#include "experiments/truths/floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "experiments/truths/film.h"

namespace restlab::analytic {
namespace {

// Light after more reflections inside the slab is below the error stated in truths.h.
constexpr uint32_t kEventsOfGlass = 64;

struct Sun {
  double radiance = 1.0, theta = 0.0;  // rad from the zenith
};

Sun sunOf(const EnvironmentMap& sky) {
  const auto brightest =
      std::max_element(sky.radiance.begin(), sky.radiance.end(),
                       [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
  const size_t row = size_t(brightest - sky.radiance.begin()) / sky.width;
  return {double(brightest->x), (double(row) + 0.5) / sky.height * glm::pi<double>()};
}

bool leans(const Scene& scene) { return !scene.textureUses.empty(); }

// The texel is (1, y, 1), with y not 0: 8 bits have no exact middle.
double cosineOfSlope(const Scene& scene) {
  const double scale = double(scene.materials.at(0).data.normalScale);
  const double y = 2.0 * 128.0 / 255.0 - 1.0;
  return 1.0 / std::sqrt(1.0 + scale * scale * (1.0 + y * y));
}

}  // namespace

double sunlitRadiance(double sun, double thetaOfSun, uint32_t width, uint32_t height) {
  const double h = glm::pi<double>() / height, sine = std::sin(h);
  return 1.0 + (sun - 1.0) * (2.0 / width) * 0.5 * std::sin(2.0 * thetaOfSun) * sine * sine / h;
}

double leaningRadiance(double cosineOfSlope) { return 0.5 * (1.0 + cosineOfSlope); }

glm::dvec3 spotlitRadiance(const std::vector<PunctualLight>& spots, const glm::dvec3& posW) {
  glm::dvec3 sum(0.0);
  for (const PunctualLight& spot : spots) {
    const glm::dvec3 d = posW - spot.posW;
    const double d2 = glm::dot(d, d), distance = std::sqrt(d2);
    const double cosOuter = std::cos(double(spot.outerConeAngle)),
                 cosInner = std::cos(double(spot.innerConeAngle));
    // Falloff of KHR_lights_punctual.
    const double cone = std::clamp(
        (glm::dot(d, spot.dirW) / distance - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
    sum += glm::dvec3(spot.intensity) * double(spot.lightFactor) *
           (cone * cone * std::max(-d.y, 0.0) / (distance * d2));
  }
  return sum / glm::pi<double>();
}

std::string whyNotFloor(const Scene& scene, const ExactView& view) {
  if (view.scatteringEvents == 0) return "at 0 scattering events";
  const bool isGlass = scene.materials.at(0).data.transmission > 0.0f;
  if (isGlass && view.scatteringEvents < kEventsOfGlass)
    return fmt::format("of glass at fewer than {} scattering events", kEventsOfGlass);
  const bool isPlain =
      scene.environment && sunOf(*scene.environment).radiance == 1.0 && !leans(scene);
  if (isPlain) return "";
  if (leans(scene) && !(scene.environment && sunOf(*scene.environment).radiance == 1.0))
    return "of a slope under anything but a uniform sky";
  if (scene.instances.empty()) return "of a sky with a sun or spots, without the floor";
  const std::vector<glm::vec3>& p = scene.geometries.at(scene.instances.front().geometry).positions;
  if (p.size() < 4) return "of one triangle under anything but a uniform sky";
  if (!seesOnly(glm::dvec3(p.front().x, 0.0, p.back().z), glm::dvec3(p.back().x, 0.0, p.front().z),
                cameraOf(scene, view), view))
    return "from a camera that sees more than the floor";
  return "";
}

std::vector<glm::dvec3> floorImage(const Scene& scene, const ExactView& view) {
  if (!scene.environment) {
    return filmOf(cameraOf(scene, view), view,
                  scene.lights.size() > 1000 ? FilmPoints::few : FilmPoints::many,
                  [&](const glm::dvec3& posW) { return spotlitRadiance(scene.lights, posW); });
  }
  const EnvironmentMap& sky = *scene.environment;
  const Sun sun = sunOf(sky);
  double radiance = sunlitRadiance(sun.radiance, sun.theta, sky.width, sky.height);
  if (leans(scene)) radiance *= leaningRadiance(cosineOfSlope(scene));
  return std::vector<glm::dvec3>(size_t(view.width) * view.height,
                                 glm::dvec3(radiance * double(sky.lightFactor)));
}

}  // namespace restlab::analytic
