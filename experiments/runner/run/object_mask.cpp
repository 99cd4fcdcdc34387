#include "experiments/runner/run/object_mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/error.h"
#include "experiments/runner/suite/backend_choice.h"

namespace restlab {

namespace {

// Marks the instances that `object` names, counted from 1.
void markObject(const Scene& scene, const std::string& object, std::vector<uint8_t>& isWanted) {
  std::vector<std::string> names;
  bool isFound = false;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const std::string& name = scene.instances[i].name;
    if (name == object) {
      isWanted[i + 1] = 1;
      isFound = true;
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (isFound) return;
  size_t number = 0;
  const char* end = object.data() + object.size();
  const auto [rest, status] = std::from_chars(object.data(), end, number);
  if (status == std::errc() && rest == end && number >= 1 && number <= scene.instances.size()) {
    isWanted[number] = 1;
    return;
  }
  constexpr size_t kShown = 12;
  const std::string more = names.size() > kShown ? ", ..." : "";
  const std::string suggestion = didYouMean(object, names);
  names.resize(std::min(names.size(), kShown));
  failUsage(fmt::format("object {}: '{}' has the objects 1 to {} ({}{}){}", object, scene.name,
                        scene.instances.size(), fmt::join(names, ", "), more, suggestion));
}

}  // namespace

PixelMask pixelsOfObjects(const PreparedScene& prepared, SessionConfig config,
                          const std::vector<std::string>& objects,
                          const std::optional<SceneCamera>& camera) {
  const Scene& scene = prepared.scene->source();
  std::vector<uint8_t> isWanted(scene.instances.size() + 1, 0);
  for (const std::string& object : objects) markObject(scene, object, isWanted);
  config.integrator = "path";
  config.mode = "";
  config.parameters.clear();
  config.maxBounces = 0;
  config.pixelFilter = rl::RL_FILTER_CENTER;
  Session session(prepared.scene, config, (Session::aovNames().size() + 1) * sizeof(glm::vec3));
  logStartup(session);
  if (camera) session.setCamera(*camera);
  session.frame();
  const Image layer = session.aov("object");
  PixelMask mask;
  mask.reserve(layer.pixels.size());
  for (const glm::vec3& pixel : layer.pixels) mask.push_back(isWanted[size_t(pixel.x)]);
  return mask;
}

}  // namespace restlab
