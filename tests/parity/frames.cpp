#include "tests/parity/frames.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <ostream>

#include "core/backend/backend.h"
#include "core/backend/vulkan_device.h"
#include "core/frame/cache.h"
#include "core/frame/method.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/bias/few_entries.h"
#include "tests/parity/everything_scene.h"
#include "tests/parity/reads.h"
#include "tests/unit/bvh_context.h"
#include "tests/unit/ray_cases.h"
#include "tests/varied_scenes.h"

namespace restlab::parity {

namespace {

// Finds the first hits of a session's pixels again, with both intersectors.
class FirstHits {
 public:
  FirstHits(const std::shared_ptr<const CompiledScene>& scene, const SessionConfig& config)
      : embree_(scene), own_{(scene->bindBvh(), scene->data()), embree_.frame, embree_.counters} {
    rl::FrameData& f = embree_.frame;
    f.width = config.width;
    f.height = config.height;
    f.seed = config.seed;
    f.pixelFilter = config.pixelFilter;
    const SceneCamera& camera = scene->source().cameras.front();
    f.camera = scene->camera(camera, config.width, config.height);
  }

  // Returns whether the ray through a pixel passes so close to an edge that rounding decides.
  bool passesAnEdge(uint32_t x, uint32_t y) {
    const rl::FrameData& f = embree_.frame;
    const rl::uvec2 pixel(x, y);
    const uint32_t film = embree_->cameraFilmBits(pixel);
    const rl::Ray ray = embree_->cameraFilmRay(f.camera, pixel, film);
    rl::Hit a{}, b{};
    embree_->traceRay(ray, rl::RL_RAY_PATH, embree_->cameraAlphaKey(film), a);
    own_.traceRay(ray, rl::RL_RAY_PATH, embree_->cameraAlphaKey(film), b);
    return unit::isNearEdge(a) || unit::isNearEdge(b);
  }

 private:
  unit::Dialect<> embree_;
  rl::BvhCtx own_;
};

double meanLength(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += double(glm::length(p));
  return sum / double(image.pixels.size());
}

// |a - b| / (|v| + mean); infinite for NaN.
class Distance {
 public:
  Distance(const Image& a, const Image& b)
      : a_(a), b_(b), mean_(0.5 * (meanLength(a) + meanLength(b))) {}
  double operator()(size_t i) const {
    const double difference = glm::length(glm::dvec3(a_.pixels[i]) - glm::dvec3(b_.pixels[i]));
    const double size =
        std::max(glm::length(glm::dvec3(a_.pixels[i])), glm::length(glm::dvec3(b_.pixels[i])));
    if (difference == 0.0) return 0.0;
    const double result = difference / (size + mean_);
    return result == result ? result : 1e30;
  }

 private:
  const Image& a_;
  const Image& b_;
  double mean_;
};

struct Aovs {
  Image positionW, normalW, depth;
  explicit Aovs(const Session& session)
      : positionW(session.aov("positionW")),
        normalW(session.aov("normalW")),
        depth(session.aov("depth")) {}
};

}  // namespace

std::string Combination::name() const {
  std::string text = integrator;
  if (!mode.empty()) text += "_" + mode;
  if (!cache.empty()) text += "_" + cache;
  if (denoiser != "none") text += "_" + denoiser;
  if (endsPaths) text += "_secondary";
  return text;
}

void PrintTo(const Combination& what, std::ostream* out) { *out << what.name(); }

bool Combination::hasFilter() const { return findDenoiser(denoiser).needsFeatures; }

std::vector<Combination> combinationsThatTrace() {
  std::vector<Combination> all = combinations();
  bool hasFilter = false;
  std::erase_if(all, [&](const Combination& what) {
    if (what.denoiser == "none") return false;
    const bool isFirst = what.hasFilter() && !hasFilter;
    hasFilter |= isFirst;
    return !isFirst;
  });
  return all;
}

namespace {

bool isDaily(const Combination& what) {
  if (what.denoiser != "none") return what.denoiser == "asvgf";
  if (what.cache.empty()) return !what.endsPaths;
  const bool isFirstMode = what.mode == findIntegrator(what.integrator).modes.front().name;
  const bool isLastCache = what.cache == cacheRegistry().back()->name;
  // One with a cache in world space runs all kernels of a method.
  if (what.integrator != bias::kRunsWithAll) return isFirstMode && isLastCache && !what.endsPaths;
  if (what.endsPaths) return true;
  // The first cache's passes run with every other cache, and the last cache's passes with the
  // combination whose paths end in cells.
  return !isFirstMode && what.cache != cacheRegistry().front()->name && !isLastCache;
}

}  // namespace

std::vector<Combination> byDay(std::vector<Combination> all) {
  std::erase_if(all, [](const Combination& what) { return !isDaily(what); });
  return all;
}

bool isOfEveryPass(const Combination& what) {
  // Plain ones run no pass of their own but `template`.
  return isDaily(what) && !(what.cache.empty() && what.denoiser == "none");
}

std::vector<Combination> combinations() {
  std::vector<Combination> all;
  for (const IntegratorInfo* info : integratorRegistry()) {
    std::vector<std::string> caches = {""};
    if (info->usesCache) {
      caches.clear();
      for (const CacheInfo* cache : cacheRegistry()) caches.push_back(cache->name);
    }
    for (const ModeInfo& mode : info->modes) {
      for (const std::string& cache : caches) all.push_back({info->name, mode.name, cache, "none"});
    }
    if (info->endsPaths)
      all.push_back({info->name, info->modes.front().name, caches.back(), "none", true});
  }
  for (const DenoiserInfo* info : denoiserRegistry()) {
    if (info->name != "none")
      all.push_back({"path", findIntegrator("path").modes.front().name, "", info->name});
  }
  // svgf_restir reads reservoirs, so it needs another integrator.
  all.push_back({"restir_gi", findIntegrator("restir_gi").modes.front().name,
                 cacheRegistry().front()->name, "svgf_restir"});
  return all;
}

SessionConfig configOf(const Combination& what, const Machine& where, uint32_t width,
                       uint32_t height, uint32_t seed) {
  SessionConfig config;
  config.integrator = what.integrator;
  config.mode = what.mode;
  config.denoiser = what.denoiser;
  if (!what.cache.empty()) config.cache = what.cache;
  if (what.endsPaths) config.parameters["secondary"] = std::string("cache");
  config.backend = where.backend;
  config.rayTracing = where.rayTracing;
  config.kernels = where.kernels;
  config.width = width;
  config.height = height;
  config.seed = seed;
  bias::useFewEntries(config);
  bias::useFewElements(config);
  return config;
}

void FrameDifference::add(const FrameDifference& other) {
  pixels += other.pixels;
  different += other.different;
  edges += other.edges;
  ties += other.ties;
  later += other.later;
  if (unexplained == 0) firstUnexplained = other.firstUnexplained;
  unexplained += other.unexplained;
  excused += other.excused;
  beyond1em4 += other.beyond1em4;
  beyond1em2 += other.beyond1em2;
  beyond1em1 += other.beyond1em1;
}

std::string FrameDifference::text() const {
  return fmt::format(
      "{} of {} pixels differ ({:.2g}): {} at edges, {} ties, {} later decisions, {} unexplained; "
      "{} by another intersector alone; beyond 1e-4: {}, 1e-2: {}, 1e-1: {}",
      different, pixels, share(), edges, ties, later, unexplained, excused, beyond1em4, beyond1em2,
      beyond1em1);
}

FrameDifference countDifferent(const Image& a, const Image& b) {
  FrameDifference result;
  result.pixels = a.pixels.size();
  const Distance distance(a, b);
  for (size_t i = 0; i < result.pixels; ++i) {
    const double d = distance(i);
    result.different += d > kSameWithin;
    result.beyond1em4 += d > 1e-4;
    result.beyond1em2 += d > 1e-2;
    result.beyond1em1 += d > 1e-1;
  }
  return result;
}

void excuse(FrameDifference& difference, const Image& a, const Image& b, const Image& other) {
  const Distance between(a, b), alone(other, b);
  for (size_t i = 0; i < difference.pixels; ++i)
    difference.excused += between(i) > kSameWithin && alone(i) > kSameWithin ? 1 : 0;
}

FrameDifference classify(const std::shared_ptr<const CompiledScene>& scene, Session& a,
                         Session& b) {
  FrameDifference result = countDifferent(a.radiance(), b.radiance());
  if (result.different == 0) return result;
  const Distance distance(a.radiance(), b.radiance());
  const Aovs left(a), right(b);
  FirstHits hits(scene, a.config());
  const glm::vec3 origin(scene->origin());
  for (size_t i = 0; i < result.pixels; ++i) {
    if (!(distance(i) > kSameWithin)) continue;
    const float da = left.depth.pixels[i].x, db = right.depth.pixels[i].x;
    // Distances are rounded relative to the size of the coordinates.
    const glm::vec3 p = glm::abs(left.positionW.pixels[i] - origin);
    const float tolerance = 1e-4f * da + 2e-5f * std::max({p.x, p.y, p.z});
    const bool isOneMissed = (da == 0.0f) != (db == 0.0f);
    const bool isSameDepth = !isOneMissed && std::abs(da - db) <= tolerance;
    const bool isSameNormal =
        glm::length(left.normalW.pixels[i] - right.normalW.pixels[i]) <= 1e-3f;
    const auto x = static_cast<uint32_t>(i % a.config().width),
               y = static_cast<uint32_t>(i / a.config().width);
    if (isSameDepth && isSameNormal) {
      ++result.later;
    } else if (hits.passesAnEdge(x, y)) {
      ++result.edges;
    } else if (isSameDepth) {
      ++result.ties;
    } else if (result.unexplained++ == 0) {
      result.firstUnexplained = fmt::format("pixel {} {}: depths {} and {}", x, y, da, db);
    }
  }
  return result;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names = test::variedScenes();
  std::erase(names, "shapes");  // the file has one of each kind
  names.emplace_back("everything");
  names.emplace_back("materials");
  return names;
}

std::vector<std::string> gateNames() {
  return {"gates/cornell-box/cornell-box.gltf", "gates/cornell-d8/cornell.gltf",
          "gates/mi-directional/mi-directional.gltf", "gates/mi-vertex-color/mi-vertex-color.gltf"};
}

namespace {

bool isGate(const std::string& scene) { return scene.rfind("gates/", 0) == 0; }

std::filesystem::path gateFile(const std::string& scene) {
  const char* variable = std::getenv("RESTLAB_SCENES");
  const std::filesystem::path root =
      variable != nullptr ? std::filesystem::path(variable)
                          : std::filesystem::path(RESTLAB_SOURCE_DIR) / "../shared/scenes";
  return root / scene;
}

// Every kind of shape but those that are slow to compile, which have scenes of their own.
Scene fileOfShapes() {
  Scene scene = loadScene(RESTLAB_SOURCE_DIR "/experiments/scenes/shapes.scene.toml");
  std::erase_if(scene.instances, [&](const MeshInstance& instance) {
    const auto& shape = scene.geometries.at(instance.geometry).shape;
    return shape && (shape->info->name == "nurbs" || shape->info->name == "curves");
  });
  return scene;
}

Scene makeScene(const std::string& name) {
  if (name == "everything") return makeEverythingScene();
  if (name == "materials")  // every kind of closure
    return loadScene(RESTLAB_SOURCE_DIR "/experiments/scenes/materials.scene.toml");
  if (name == "nurbs-file")  // met exactly
    return loadScene(RESTLAB_SOURCE_DIR "/experiments/scenes/nurbs.scene.toml");
  if (name == "shapes-file") return fileOfShapes();
  return isGate(name) ? loadScene(gateFile(name).string()) : makeBuiltinScene(name);
}

}  // namespace

bool isAtHand(const std::string& scene) {
  return !isGate(scene) || std::filesystem::exists(gateFile(scene));
}

std::shared_ptr<const CompiledScene> sceneNamed(const std::string& name) {
  static std::map<std::string, std::shared_ptr<const CompiledScene>> known;
  std::shared_ptr<const CompiledScene>& scene = known[name];
  if (!scene) scene = CompiledScene::build(makeScene(name));
  return scene;
}

SceneCamera cameraOf(const CompiledScene& scene, uint32_t frame) {
  const SceneCamera& start = scene.source().cameras.front();
  SceneCamera camera = start;
  if (frame < 2) return camera;
  camera.cameraToWorld[3] +=
      0.02 * double(frame - 1) * (start.cameraToWorld[0] - 0.5 * start.cameraToWorld[2]);
  return camera;
}

namespace {

// Images of the third frame, then of a layer, whose buffers are allocated later and lie elsewhere.
std::vector<Image> seenBy(const char* how, const std::string& scene, const Combination& what,
                          const Machine& where) {
  const Reads reads(how);
  Session session(sceneNamed(scene), configOf(what, where, 64, 48, 11));
  EXPECT_EQ(session.startup().readsTexels, std::string(how) == "texels");
  session.frames(3);
  return {session.radiance(), session.aov("albedo")};
}

}  // namespace

void expectSameBitsByBothReads(const Combination& what, const std::string& scene,
                               const Machine& where) {
  SCOPED_TRACE(scene);
  const std::vector<Image> texels = seenBy("texels", scene, what, where);
  const std::vector<Image> addresses = seenBy("addresses", scene, what, where);
  for (size_t i = 0; i < texels.size(); ++i) {
    const auto& a = texels[i].pixels;
    const auto& b = addresses[i].pixels;
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0) << "image " << i;
    EXPECT_TRUE(std::any_of(a.begin(), a.end(), [](const glm::vec3& v) { return v.x > 0.0f; }));
  }
}

bool hasVulkan() {
  for (const VulkanDeviceInfo& info : vulkanDeviceInfos()) {
    if (info.whyNot.empty()) return true;
  }
  return false;
}

}  // namespace restlab::parity
