#include "experiments/runner/reference/reference.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "core/image/metrics/metrics.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

// Writes all numbers of a camera that its image depends on, exactly. -0 is written as 0.
std::string exactly(const SceneCamera& camera) {
  std::string text = camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC ? "orthographic" : "perspective";
  if (camera.isMirrored) text += " mirrored";
  if (camera.shift != glm::dvec2(0.0))
    text += fmt::format(" shift {:a} {:a}", camera.shift.x, camera.shift.y);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      text += fmt::format(" {:a}", camera.cameraToWorld[column][row] + 0.0);
    }
  }
  if (camera.kind != rl::RL_CAMERA_ORTHOGRAPHIC) return text + fmt::format(" {:a}", camera.yfov);
  return text + fmt::format(" {:a}", camera.ymag);  // the film's shape gives the width
}

}  // namespace

const std::string& referenceSources(const std::string& integrator) {
  if (integrator == "path") return buildInfo().referenceHash;
  return integrator == "bdpt" ? buildInfo().bdptHash : buildInfo().sourceHash;
}

bool targetReached(const ReferenceTarget& target, uint64_t spp, double relmseSinceHalf,
                   double timeS, double sppForLights) {
  if (target.spp && spp >= target.spp) return true;
  if (target.timeLimitS > 0.0 && timeS >= target.timeLimitS && spp >= 2) return true;
  if (!(target.relmse > 0.0 && relmseSinceHalf <= target.relmse)) return false;
  if (double(spp) >= sppForLights) return true;
  const bool isBounded = target.spp > 0 || target.timeLimitS > 0.0;
  return !isBounded && sppForLights > kMostForLights * double(spp);
}

std::string whyNotConverged(const Reference& reference) {
  const auto rare = reference.metadata.find("rare_lights");
  return rare == reference.metadata.end() ? "" : rare->second;
}

const SceneCamera* cameraInsteadOf(const PreparedScene& prepared, const ReferenceConfig& config) {
  if (!config.camera) return nullptr;
  const SceneCamera& own = prepared.scene->source().cameras.at(prepared.camera);
  return exactly(*config.camera) == exactly(own) ? nullptr : &*config.camera;
}

ReferenceConfig referenceConfigOf(const SessionConfig& session) {
  ReferenceConfig config;
  config.width = session.width;
  config.height = session.height;
  static_cast<TransportSettings&>(config) = referenceTransport(session);
  config.components = session.components;
  config.seed = session.seed;
  config.threads = session.threads;
  config.backend = session.backend;
  config.device = session.device;
  config.rayTracing = session.rayTracing;
  config.validate = session.validate;
  return config;
}

ReferenceConfig referenceOfSuite(const Suite& suite, const SessionConfig& picture) {
  ReferenceConfig config = referenceConfigOf(picture);
  config.integrator = suite.referenceIntegrator;
  if (suite.referenceMethod.empty()) return config;
  const SuiteMethod& method = *suite.referenceRow();
  config.integrator = method.session.integrator;
  config.mode = method.session.mode;
  config.parameters = resolveParameters(findMethod(method.session), method.parameters());
  return config;
}

std::string referenceKey(const PreparedScene& prepared, const ReferenceConfig& config) {
  const SceneCamera* camera = cameraInsteadOf(prepared, config);
  std::string text = fmt::format(
      "reference-3 {} camera {} {}x{} {} sources {}", hexHash(prepared.contentHash),
      camera ? exactly(*camera) : std::to_string(prepared.camera), config.width, config.height,
      componentName(config.components), referenceSources(config.integrator));
  if (config.integrator != "path") text += " by " + config.integrator;
  if (!config.mode.empty()) text += " mode " + config.mode;
  for (const auto& [name, value] : config.parameters)
    text += fmt::format(" {} {}", name, parameterText(value));
  for (const auto& [name, value] : transportTexts(config, true)) text += " " + name + " " + value;
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return hexHash(hash.high64) + hexHash(hash.low64);
}

bool meetsTarget(const Reference& reference, const ReferenceTarget& target) {
  const auto need = reference.metadata.find("light_draws_need_spp");
  const double sppForLights =
      need == reference.metadata.end() ? 0.0 : std::strtod(need->second.c_str(), nullptr);
  return targetReached(target, reference.spp, reference.relmseSinceHalf, reference.timeS,
                       sppForLights);
}

void requireUsable(const std::string& file, const Reference& reference) {
  const auto word = [&](const char* name) {
    const auto found = reference.metadata.find(name);
    return found == reference.metadata.end() ? std::string() : found->second;
  };
  const bool isOurs = !word("scene_hash").empty();
  if (isOurs && word("kind") != "reference") {
    failInput(
        fmt::format("{}: is an image of {} with {} spp, not a reference (restlab reference "
                    "makes one)",
                    file, word("integrator"), word("spp")));
  }
  for (const Image* image : {&reference.mean, reference.half0 ? &*reference.half0 : nullptr,
                             reference.half1 ? &*reference.half1 : nullptr,
                             reference.variance ? &*reference.variance : nullptr}) {
    if (!image) continue;
    const size_t count = countNonfinite(*image);
    if (count == 0) continue;
    const auto first =
        std::find_if(image->pixels.begin(), image->pixels.end(), [](const glm::vec3& pixel) {
          return !(std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z));
        });
    const size_t at = size_t(first - image->pixels.begin());
    failInput(
        fmt::format("{}: {} values of its {} are not finite, the first at pixel ({}, {}); "
                    "a reference must be finite",
                    file, count,
                    image == &reference.mean                              ? "image"
                    : reference.variance && image == &*reference.variance ? "variance"
                                                                          : "halves",
                    at % image->width, at / image->width));
  }
}

std::optional<std::string> pictureWord(const std::map<std::string, std::string>& metadata,
                                       const std::string& key) {
  if (const auto found = metadata.find(key); found != metadata.end()) return found->second;
  if (!metadata.contains("camera_to_world")) return {};
  if (key == "camera_shift") return "0 0";
  if (key == "camera_mirrored") return "false";
  return {};
}

void requireSameConfiguration(const std::string& file,
                              const std::map<std::string, std::string>& reference,
                              const std::map<std::string, std::string>& wanted) {
  if (reference.find("scene_hash") == reference.end()) {
    logWarning(fmt::format("{}: says nothing about its scene and settings; taken on trust", file));
    return;
  }
  std::vector<std::string> items = {
      "scene_hash",      "camera_index", "camera_to_world", "camera_yfov", "camera_shift",
      "camera_mirrored", "width",        "height",          "component",   "reference_sources"};
  for (const auto& setting : transportTexts({}, true)) items.push_back(setting.first);
  const auto kind = reference.find("kind"), by = reference.find("integrator");
  const bool isByOther = kind != reference.end() && kind->second == "reference" &&
                         by != reference.end() && by->second != "path";
  for (const std::string& item : items) {
    const auto have = pictureWord(reference, item);
    auto want = pictureWord(wanted, item);
    // `wanted` names the sources of `path`, of this version or of another one.
    if (item == "reference_sources" && have && want && isByOther)
      want = *want == buildInfo().referenceHash ? referenceSources(by->second) : *have;
    if (!have || !want || *have == *want) continue;
    failInput(fmt::format("{}: the reference is of another configuration: {} is {}, not {}", file,
                          item, *have, *want));
  }
}

}  // namespace restlab
