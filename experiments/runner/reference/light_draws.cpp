#include "experiments/runner/reference/light_draws.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "experiments/report/text.h"

namespace restlab {

namespace {

constexpr size_t kNamedLights = 5;

double luminance(const glm::vec3& c) { return 0.212639 * c.x + 0.715169 * c.y + 0.072192 * c.z; }

// The table leaves out punctual lights without intensity.
class PunctualNames {
 public:
  explicit PunctualNames(const Scene& scene) : scene_(scene) {}
  std::string next() {
    while (at_ < scene_.lights.size() && !(luminance(scene_.lights[at_].intensity) > 0.0)) ++at_;
    return at_ < scene_.lights.size() ? scene_.lights[at_++].name : "a light";
  }

 private:
  const Scene& scene_;
  size_t at_ = 0;
};

}  // namespace

std::vector<DrawnLight> drawnLights(const CompiledScene& scene) {
  const rl::SceneData& data = scene.data();
  const rl::Light* records = data.lights.data;
  PunctualNames punctual(scene.source());
  std::vector<DrawnLight> lights;
  uint32_t lastInstance = rl::RL_INVALID;
  for (uint32_t i = 0; i < data.lightCount; ++i) {
    const rl::Light& light = records[i];
    const bool isTriangle = light.kind == rl::RL_LIGHT_TRIANGLE;
    if (isTriangle && light.instance == lastInstance) {
      lights.back().probability += double(light.pmf);
      continue;
    }
    lastInstance = isTriangle ? light.instance : rl::RL_INVALID;
    const std::string name = isTriangle ? scene.source().instances.at(light.instance).name
                             : light.kind == rl::RL_LIGHT_ENVIRONMENT ? "the environment"
                                                                      : punctual.next();
    lights.push_back({name, double(light.pmf)});
  }
  std::erase_if(lights, [](const DrawnLight& light) { return !(light.probability > 0.0); });
  return lights;
}

RareLights rareLights(const std::vector<DrawnLight>& lights, double rays, double spp) {
  RareLights rare;
  if (lights.empty()) return rare;
  double least = 1.0;
  for (const DrawnLight& light : lights) {
    least = std::min(least, light.probability);
    if (light.probability * rays < kFewestLightDraws) rare.lights.push_back(light);
  }
  std::stable_sort(rare.lights.begin(), rare.lights.end(),
                   [](const auto& a, const auto& b) { return a.probability < b.probability; });
  rare.fewestDraws = least * rays;
  if (rays > 0.0) rare.sppNeeded = kFewestLightDraws / least * spp / rays;
  return rare;
}

std::string rareLightsText(const RareLights& rare, size_t lights, double rays) {
  if (rare.lights.empty()) return "";
  std::string named;
  for (size_t i = 0; i < std::min(rare.lights.size(), kNamedLights); ++i) {
    named += fmt::format("{}'{}' {} times", i == 0 ? "" : ", ", oneLine(rare.lights[i].name),
                         shortNumber(rare.lights[i].probability * rays, 2));
  }
  if (rare.lights.size() > kNamedLights) named += ", ...";
  return fmt::format(
      "{} of {} drawn too seldom to know {} share of the light (by expectation, at most: {}); "
      "{:.0f} "
      "draws are wanted, which take about {} spp",
      rare.lights.size(), counted(lights, "light"), rare.lights.size() == 1 ? "its" : "their",
      named, kFewestLightDraws, groupedDigits(uint64_t(std::min(rare.sppNeeded, 1e18))));
}

}  // namespace restlab
