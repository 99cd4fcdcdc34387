// Where a setting is said to have no effect, frames with another value of it are the same.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/view/page_settings.h"
#include "experiments/view/view_settings.h"
#include "tests/runner/every_method.h"
#include "tests/view/small_panes.h"

namespace restlab::view_test {
namespace {

// Histories of this many frames are old, and of light that changes before the last two; then the
// camera moves.
constexpr uint32_t kStillFrames = 10, kMovingFrames = 2;
constexpr double kSmall = 64.0;

// A scene, and the same with a third of its light.
struct Scenes {
  std::shared_ptr<const CompiledScene> bright = cornellBox().scene,
                                       dark = CompiledScene::build(
                                           withLightFactor(bright->source(), kAllLights, 0.3));
};

std::vector<Image> framesOf(const Scenes& scenes, const SessionConfig& config) {
  Session session(scenes.bright, config);
  std::vector<Image> frames;
  SceneCamera camera = scenes.bright->source().cameras.front();
  for (uint32_t i = 0; i < kStillFrames + kMovingFrames; ++i) {
    if (i >= kStillFrames) camera.cameraToWorld[3].x += 0.1;
    if (i + 2 == kStillFrames) session.setScene(scenes.dark);
    session.setCamera(camera);
    session.frame();
    frames.push_back(session.radiance());
  }
  return frames;
}

// Requires equal frames but for rounding: a pass that merges nothing still computes.
void expectEqual(const std::vector<Image>& a, const std::vector<Image>& b) {
  double difference = 0.0, square = 1e-30;
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t k = 0; k < a[i].pixels.size(); ++k) {
      const glm::dvec3 x(a[i].pixels[k]), apart = x - glm::dvec3(b[i].pixels[k]);
      difference += glm::dot(apart, apart);
      square += glm::dot(x, x);
    }
  }
  EXPECT_LT(difference / square, 1e-11);
}

// All choices; of a range its begin, twice the default, and its end where that is small: large
// numbers take memory and time.
std::vector<ParameterValue> valuesOf(const ParameterInfo& info) {
  std::vector<ParameterValue> values(info.choices.begin(), info.choices.end());
  if (std::holds_alternative<bool>(info.defaultValue)) return {false, true};
  const auto add = [&](double fallback, const auto& stored) {
    const double twice = std::min(info.maxValue, std::max(2.0 * fallback, info.minValue + 1.0));
    for (const double value :
         {info.minValue, twice, std::max(info.minValue, std::min(info.maxValue, kSmall))})
      values.push_back(stored(value));
  };
  if (const auto* whole = std::get_if<int64_t>(&info.defaultValue))
    add(double(*whole), [](double value) { return ParameterValue(int64_t(value)); });
  if (const auto* number = std::get_if<double>(&info.defaultValue))
    add(*number, [](double value) { return ParameterValue(value); });
  return values;
}

// A method with another value of the parameter, or with the last mode, for the same reason without
// effect; none if each other value has one, such as a value below a bound.
std::optional<SessionConfig> changed(const SessionConfig& config, const std::string& name,
                                     const std::string& why) {
  const Method method = findMethod(config);
  std::vector<SessionConfig> others;
  if (name == "mode") {
    others.push_back(config);
    others.back().mode = method.integrator->modes.back().name;
  }
  const ParameterMap resolved = resolveParameters(method, config.parameters);
  for (const ParameterInfo& info : method.parameters()) {
    if (info.name != name) continue;
    for (const ParameterValue& value : valuesOf(info)) {
      others.push_back(config);
      others.back().parameters[name] = value;
      if (value == resolved.at(name)) others.pop_back();
    }
  }
  for (const SessionConfig& other : others) {
    const auto reasons = unusedParameters(other);
    if (const auto found = reasons.find(name); found != reasons.end() && found->second == why)
      return other;
  }
  return std::nullopt;
}

// Ways to set one parameter, or two, that leave others without effect.
std::vector<ParameterMap> conditionsOf(const SessionConfig& config) {
  const size_t before = unusedParameters(config).size();
  std::vector<ParameterMap> single;
  for (const ParameterInfo& info : findMethod(config).parameters()) {
    for (const ParameterValue& value : valuesOf(info)) {
      SessionConfig one = config;
      one.parameters[info.name] = value;
      if (unusedParameters(one).size() != before) single.push_back(one.parameters);
    }
  }
  std::vector<ParameterMap> all = {config.parameters};
  all.insert(all.end(), single.begin(), single.end());
  for (size_t i = 0; i < single.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      all.push_back(single[i]);
      all.back().insert(single[k].begin(), single[k].end());
    }
  }
  return all;
}

// Each integrator, each cache of one, and each denoiser with and without reservoirs.
std::vector<SessionConfig> methods() {
  std::vector<SessionConfig> all;
  for (SessionConfig config : everyMethod()) {
    config = withNames(config);
    const bool isPlain = config.denoiser == "none", isGi = config.integrator == "restir_gi";
    const bool isFirstCache = config.cache.empty() || config.cache == cacheRegistry()[0]->name;
    const bool isDenoised = isFirstCache && (isGi || config.integrator == "path");
    if (!isPlain && !isDenoised) continue;
    if (!isFirstCache && !isGi) continue;
    if (config.integrator == "radiosity")
      config.parameters = {{"elements", int64_t{64}}, {"factor_rays", int64_t{16}}};
    config.width = 12;
    config.height = 9;
    config.threads = 1;
    config.kernels = KernelChoice::builtIn;
    all.push_back(config);
  }
  return all;
}

TEST(UnusedSettings, ChangeNoFrame) {
  const Scenes scenes;
  std::set<std::array<std::string, 4>> seen;
  for (SessionConfig config : methods()) {
    for (const ParameterMap& condition : conditionsOf(config)) {
      config.parameters = condition;
      std::vector<Image> frames;
      for (const auto& [name, why] : unusedParameters(config)) {
        // Denoisers read what other parts have.
        const std::vector<ParameterInfo>& own = findIntegrator(config.integrator).parameters;
        const bool isOwn = std::any_of(
            own.begin(), own.end(), [&](const ParameterInfo& info) { return info.name == name; });
        const std::array<std::string, 4> key = {config.integrator, isOwn ? "" : config.denoiser,
                                                name, why};
        if (seen.count(key) > 0) continue;
        const std::optional<SessionConfig> other = changed(config, name, why);
        if (!other) continue;
        std::string words;
        for (const auto& [parameter, value] : condition)
          words += fmt::format(" {} = {}", parameter, parameterText(value));
        SCOPED_TRACE(fmt::format("{} {} {}:{}: {} ({})", config.integrator, config.cache,
                                 config.denoiser, words, name, why));
        try {
          if (frames.empty()) frames = framesOf(scenes, config);
          expectEqual(frames, framesOf(scenes, *other));
          seen.insert(key);
        } catch (const Error&) {  // no such mesh or memory
        }
      }
    }
  }
  EXPECT_GT(seen.size(), 100u);
}

TEST(UnusedSettings, OfAllPanesChangeNoFrame) {
  const Scenes scenes;
  size_t seen = 0;
  for (SessionConfig config : methods()) {
    if (config.denoiser != "none") continue;
    for (const uint32_t bounces : {2u, 4u}) {
      config.maxBounces = bounces;
      for (const PageSetting& setting : sharedSettings()) {
        const std::string why = whyUnused(setting, {config}, *scenes.bright);
        if (why.empty() || why.find("vulkan") != std::string::npos) continue;
        SCOPED_TRACE(config.integrator + " " + setting.info.name + " (" + why + ")");
        SessionConfig other = config;
        for (const ParameterValue& value : valuesOf(setting.info))
          if (value != setting.get(config)) setting.set(other, value);
        expectEqual(framesOf(scenes, config), framesOf(scenes, other));
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 8u);
}

}  // namespace
}  // namespace restlab::view_test
