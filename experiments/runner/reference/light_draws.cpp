#include "experiments/runner/reference/light_draws.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "experiments/report/text.h"

namespace restlab {

namespace {

constexpr size_t kNamedLights = 5;

double luminance(const glm::vec3& c) { return 0.212639 * c.x + 0.715169 * c.y + 0.072192 * c.z; }

// Names punctual lights in the order of the light table, which leaves out lights without intensity.
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

// Share of draws of a textured emitter that find its light, by material. Each image is read once.
class TextureShares {
 public:
  explicit TextureShares(const Scene& scene) : scene_(scene) {}
  double of(uint32_t material) {
    const auto found = byMaterial_.find(material);
    if (found != byMaterial_.end()) return found->second;
    return byMaterial_.emplace(material, computed(scene_.materials.at(material).data))
        .first->second;
  }

 private:
  double computed(const rl::Material& material) const {
    const uint32_t slot = material.textures[rl::RL_TEX_EMISSIVE];
    if (slot == rl::RL_INVALID) return 1.0;
    const TextureUse& use = scene_.textureUses.at(slot);
    // Luminance of a texel's channel, by byte value.
    std::array<std::array<double, 256>, 3> part{};
    for (uint32_t c = 0; c < 3; ++c) {
      glm::vec3 unit(0.0f);
      unit[int(c)] = material.emission[int(c)];
      for (size_t byte = 0; byte < 256; ++byte) {
        const double value = double(byte) / 255.0;
        part[c][byte] = luminance(unit) * (use.srgb ? std::pow(value, 2.2) : value);
      }
    }
    double sum = 0.0, squares = 0.0;
    const std::vector<uint32_t>& texels = scene_.images.at(use.image).texels;
    for (const uint32_t t : texels) {
      const double value = part[0][t & 255u] + part[1][(t >> 8) & 255u] + part[2][(t >> 16) & 255u];
      sum += value;
      squares += value * value;
    }
    return squares > 0.0 ? sum * sum / (squares * double(texels.size())) : 1.0;
  }

  const Scene& scene_;
  std::map<uint32_t, double> byMaterial_;
};

}  // namespace

std::vector<DrawnLight> drawnLights(const CompiledScene& scene) {
  const rl::SceneData& data = scene.data();
  const rl::Light* records = data.lights.data;
  PunctualNames punctual(scene.source());
  TextureShares shares(scene.source());
  std::vector<DrawnLight> lights;
  uint32_t lastInstance = rl::RL_INVALID;
  for (uint32_t i = 0; i < data.lightCount; ++i) {
    const rl::Light& light = records[i];
    const bool isTriangle = light.kind == rl::RL_LIGHT_AREA;
    const double probability =
        double(light.pmf) *
        (isTriangle ? shares.of(scene.source().instances.at(light.instance).material) : 1.0);
    if (isTriangle && light.instance == lastInstance) {
      lights.back().probability += probability;
      continue;
    }
    lastInstance = isTriangle ? light.instance : rl::RL_INVALID;
    const std::string name = isTriangle ? scene.source().instances.at(light.instance).name
                             : light.kind == rl::RL_LIGHT_ENVIRONMENT ? "the environment"
                                                                      : punctual.next();
    lights.push_back({name, probability});
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
