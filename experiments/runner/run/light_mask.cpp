#include "experiments/runner/run/light_mask.h"

#include "experiments/runner/suite/backend_choice.h"

namespace restlab {

std::vector<uint8_t> pixelsWithoutLights(const PreparedScene& prepared, SessionConfig config,
                                         const std::optional<SceneCamera>& camera) {
  constexpr int kSamples = 64;
  config.integrator = "path";
  config.mode = "";
  config.parameters.clear();
  config.maxBounces = 0;  // emission only
  config.components = rl::RL_COMPONENT_ALL;
  config.seed = 1;
  Session emission(prepared.scene, config);
  logStartup(emission);
  if (camera) emission.setCamera(*camera);
  std::vector<uint8_t> mask(size_t(config.width) * config.height, 1);
  for (int sample = 0; sample < kSamples; ++sample) {
    emission.frame();
    const Image& image = emission.radiance();
    for (size_t i = 0; i < mask.size(); ++i) {
      if (image.pixels[i] != glm::vec3(0.0f)) mask[i] = 0;
    }
  }
  return mask;
}

}  // namespace restlab
