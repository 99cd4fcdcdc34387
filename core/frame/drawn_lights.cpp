#include "core/frame/drawn_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

std::string DrawnLights::text() const {
  constexpr size_t kMostNames = 8;
  if (undrawn.empty()) return "";
  const std::vector<std::string> first(
      undrawn.begin(), undrawn.begin() + std::ptrdiff_t(std::min(undrawn.size(), kMostNames)));
  return fmt::format("lights: {} of {} never drawn: {}{}", undrawn.size(), lights,
                     fmt::join(first, ", "), undrawn.size() > kMostNames ? ", ..." : "");
}

DrawnLights drawnLights(const CompiledScene& scene, const std::vector<uint32_t>& drawn) {
  DrawnLights result;
  const rl::Light* lights = scene.data().lights.data;
  for (uint32_t i = 0; i < scene.lightRecords();) {
    bool shines = false, isDrawn = false;
    uint32_t end = i;
    do {
      shines |= lights[end].pmf > 0.0f;
      isDrawn |= drawn.at(end) != 0;
      ++end;
    } while (end < scene.lightRecords() && lights[i].kind == rl::RL_LIGHT_AREA &&
             lights[end].kind == rl::RL_LIGHT_AREA && lights[end].instance == lights[i].instance);
    if (shines) ++result.lights;
    if (shines && !isDrawn) result.undrawn.push_back(scene.lightName(i));
    i = end;
  }
  return result;
}

}  // namespace restlab
