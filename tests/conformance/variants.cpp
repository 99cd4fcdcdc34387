#include "tests/conformance/variants.h"

#include <algorithm>
#include <bit>
#include <ostream>
#include <stdexcept>

#include "core/frame/cache.h"
#include "tests/bias/few_entries.h"

namespace restlab::conformance {

std::string Variant::name() const {
  const bool isUsual = cache.empty() || cache == cacheRegistry().front()->name;
  return integrator + "_" + mode + (isUsual ? "" : "_" + cache) +
         (denoiser == "none" ? "" : "_" + denoiser) + (endsPaths ? "_secondary" : "");
}

bool Variant::blurs() const { return findDenoiser(denoiser).needsFeatures; }

bool Variant::leavesLightOut() const { return !findIntegrator(integrator).leavesOut.empty(); }

std::vector<Variant> allVariants() {
  std::vector<Variant> all;
  for (const IntegratorInfo* info : integratorRegistry()) {
    std::vector<std::string> caches = {""};
    if (info->usesCache) {
      caches.clear();
      for (const CacheInfo* cache : cacheRegistry()) caches.push_back(cache->name);
    }
    for (const std::string& cache : caches) {
      for (const ModeInfo& mode : info->modes)
        all.push_back({info->name, mode.name, mode.bias, "none", cache});
    }
    for (const std::string& cache : caches) {
      if (info->endsPaths)
        all.push_back(
            {info->name, info->modes.front().name, BiasClass::biased, "none", cache, true});
    }
  }
  for (const DenoiserInfo* info : denoiserRegistry()) {
    if (info->name == "none") continue;
    all.push_back(
        {"path", findIntegrator("path").modes.front().name, info->biasOfStillView, info->name, ""});
  }
  return all;
}

std::vector<Variant> unbiasedVariants() {
  std::vector<Variant> all = allVariants();
  std::erase_if(all, [](const Variant& v) { return v.bias != BiasClass::unbiased; });
  return all;
}

namespace {

bool isDaily(const Variant& v) {
  if (v.denoiser != "none") return v.denoiser == "accumulate" || v.denoiser == "asvgf";
  if (v.cache.empty()) return !v.endsPaths;
  const bool isFirstMode = v.mode == findIntegrator(v.integrator).modes.front().name;
  const bool isFirstCache = v.cache == cacheRegistry().front()->name;
  const bool isLastCache = v.cache == cacheRegistry().back()->name;
  // One with a cache in world space runs all kernels of a method.
  if (v.integrator != bias::kRunsWithAll) return isFirstMode && isLastCache && !v.endsPaths;
  if (v.endsPaths) return isLastCache;
  // The last cache runs with paths that end, so other modes run with the caches between.
  return isFirstMode ? isFirstCache : !isFirstCache && !isLastCache;
}

// `template` estimates as `path` does; the mean under denoisers has tests in tests/denoise.
bool hasMeanOfItsOwn(const Variant& v) {
  return v.integrator != "template" && v.denoiser == "none";
}

}  // namespace

std::vector<Variant> byDay(std::vector<Variant> all) {
  std::erase_if(all, [](const Variant& v) { return !isDaily(v); });
  return all;
}

std::vector<Variant> byNight(std::vector<Variant> all) {
  std::erase_if(all, isDaily);
  return all;
}

std::vector<Variant> meansByDay(std::vector<Variant> all) {
  std::erase_if(all, [](const Variant& v) { return !isDaily(v) || !hasMeanOfItsOwn(v); });
  return all;
}

std::vector<Variant> meansByNight(std::vector<Variant> all) {
  std::erase_if(all, [](const Variant& v) { return isDaily(v) && hasMeanOfItsOwn(v); });
  return all;
}

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name(); }

SessionConfig configOf(const Variant& variant, uint32_t width, uint32_t height) {
  SessionConfig config;
  config.integrator = variant.integrator;
  config.mode = variant.mode;
  config.denoiser = variant.denoiser;
  config.cache = variant.cache;
  if (variant.endsPaths) config.parameters["secondary"] = std::string("cache");
  config.width = width;
  config.height = height;
  config.threads = 1;
  bias::useFewEntries(config);
  bias::useFewElements(config);
  return config;
}

bias::Method methodOf(const Variant& variant, uint32_t frames, uint32_t skipped) {
  bias::Method method;
  method.name = variant.name();
  method.config = configOf(variant, 32, 18);
  method.frames = frames;
  method.skipped = skipped;
  return method;
}

void runFrames(Session& session, const CompiledScene& scene, uint32_t frames) {
  constexpr uint32_t kStill = 9;
  const SceneCamera start = scene.source().cameras.at(session.config().camera);
  session.setCamera(start);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    if (frame >= kStill) {
      SceneCamera camera = start;
      // Move to its right and ahead.
      camera.cameraToWorld[3] += 0.02 * double(frame - kStill + 1) *
                                 (start.cameraToWorld[0] - 0.5 * start.cameraToWorld[2]);
      session.setCamera(camera);
    }
    session.frame();
  }
}

Image render(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config,
             uint32_t frames) {
  Session session(scene, config);
  runFrames(session, *scene, frames);
  return session.radiance();
}

size_t countDifferent(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("sizes differ");
  size_t different = 0;
  for (size_t p = 0; p < a.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      different +=
          std::bit_cast<uint32_t>(a.pixels[p][c]) != std::bit_cast<uint32_t>(b.pixels[p][c]);
    }
  }
  return different;
}

}  // namespace restlab::conformance
