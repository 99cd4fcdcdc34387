#include "experiments/cli/bench_embree.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/backend/trace_callbacks.h"
#include "core/backend/embree.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

constexpr uint32_t kTile = 16;

using RayBatch = std::vector<rl::Ray>;

void addRay(RayBatch& rays, const glm::vec3& origin, const glm::vec3& direction,
            float length = std::numeric_limits<float>::max()) {
  rays.push_back({origin, 1e-4f, direction, length});
}

struct HitPoint {
  glm::vec3 posW, normalW;  // the normal faces the ray's origin
};

RTCRay makeRay(const RayBatch& rays, size_t i) {
  RTCRay ray = {};
  ray.org_x = rays[i].origin.x;
  ray.org_y = rays[i].origin.y;
  ray.org_z = rays[i].origin.z;
  ray.dir_x = rays[i].dir.x;
  ray.dir_y = rays[i].dir.y;
  ray.dir_z = rays[i].dir.z;
  ray.tnear = rays[i].tMin;
  ray.tfar = rays[i].tMax;
  ray.mask = 0xffffffffu;
  return ray;
}

// Accepts every hit: Embree alone sees no textures.
void acceptHit(const RTCFilterFunctionNArguments*) {}

rl::KernelTraceContext opaqueContext() {
  rl::KernelTraceContext context;
  rl::embreeInitContext(context.embree);
  context.filter = acceptHit;
  return context;
}

RTCRayHit traceClosest(RTCScene scene, const RayBatch& rays, size_t i) {
  rl::KernelTraceContext context = opaqueContext();
  RTCRayHit query = {};
  query.ray = makeRay(rays, i);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rl::embreeIntersect(scene, context.embree, query);
  return query;
}

RayBatch cameraRays(const rl::Camera& camera, uint32_t width, uint32_t height) {
  RayBatch rays;
  const auto add = [&](uint32_t x, uint32_t y) {
    const float u =
        (2.0f * (float(x) + 0.5f) / float(width) - 1.0f) * camera.halfWidth + camera.shiftX;
    const float v =
        (1.0f - 2.0f * (float(y) + 0.5f) / float(height)) * camera.halfHeight + camera.shiftY;
    const glm::vec3 aside = camera.rightW * u + camera.upW * v;
    if (camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC) {
      addRay(rays, camera.posW + aside, camera.forwardW);
    } else {
      addRay(rays, camera.posW, glm::normalize(camera.forwardW + aside));
    }
  };
  for (uint32_t tileY = 0; tileY < height; tileY += kTile) {
    for (uint32_t tileX = 0; tileX < width; tileX += kTile) {
      for (uint32_t y = tileY; y < std::min(tileY + kTile, height); ++y) {
        for (uint32_t x = tileX; x < std::min(tileX + kTile, width); ++x) add(x, y);
      }
    }
  }
  return rays;
}

rl::Camera cameraOf(const PreparedScene& prepared, uint32_t width, uint32_t height) {
  const CompiledScene& compiled = *prepared.scene;
  return compiled.camera(compiled.source().cameras.at(prepared.camera), width, height);
}

std::vector<HitPoint> hitPoints(RTCScene scene, const RayBatch& rays) {
  std::vector<HitPoint> points;
  for (size_t i = 0; i < rays.size(); ++i) {
    const RTCRayHit query = traceClosest(scene, rays, i);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    // Normals of instances stay in object space: good enough for the directions of a benchmark.
    glm::vec3 normal = glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const float length = glm::length(normal);
    if (!(length > 0.0f)) continue;
    normal /= length;
    if (glm::dot(normal, rays[i].dir) > 0.0f) normal = -normal;
    const glm::vec3 posW = rays[i].origin + rays[i].dir * query.ray.tfar;
    points.push_back({posW + normal * (1e-4f * (1.0f + glm::length(posW))), normal});
  }
  return points;
}

glm::vec3 uniformDirection(std::mt19937& random, std::uniform_real_distribution<float>& unit) {
  const float z = 1.0f - 2.0f * unit(random),
              angle = 2.0f * std::numbers::pi_v<float> * unit(random);
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

RayBatch bounceRays(const std::vector<HitPoint>& points) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  RayBatch rays;
  for (const HitPoint& point : points) {
    // Sample the unit sphere around the normal's tip: cosine-distributed directions.
    glm::vec3 direction = point.normalW + uniformDirection(random, unit);
    const float length = glm::length(direction);
    direction = length > 1e-3f ? direction / length : point.normalW;
    addRay(rays, point.posW, direction);
  }
  return rays;
}

RayBatch lightRays(const std::vector<HitPoint>& points, const rl::SceneData& scene) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  RayBatch rays;
  for (const HitPoint& point : points) {
    glm::vec3 span = uniformDirection(random, unit) * 1e6f;  // without lights, or for the
                                                             // environment
    if (scene.lightCount > 0) {
      const uint32_t index =
          std::min(uint32_t(unit(random) * float(scene.lightCount)), scene.lightCount - 1);
      const rl::Light& light = scene.lights.data[index];
      if (light.kind == rl::RL_LIGHT_AREA) {
        float u = unit(random), v = unit(random);
        if (u + v > 1.0f) {
          u = 1.0f - u;
          v = 1.0f - v;
        }
        span = light.p0 + light.e1 * u + light.e2 * v - point.posW;
      } else if (light.kind == rl::RL_LIGHT_DIRECTIONAL) {
        span = -1e6f * light.e1;
      } else if (light.kind != rl::RL_LIGHT_ENVIRONMENT) {
        span = light.p0 - point.posW;
      }
    }
    addRay(rays, point.posW, span, 0.999f);
  }
  return rays;
}

std::string versionOf(RTCScene scene) {
  RTCDevice device = rtcGetSceneDevice(scene);  // adds a reference
  const auto part = [&](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(device, property);
  };
  const std::string version =
      fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                  part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
  rtcReleaseDevice(device);
  return version;
}

// Returns the rays per second of the median repetition.
template <class Trace>
double rate(size_t count, int threads, double seconds, const Trace& trace) {
  if (count == 0) return 0.0;
  using Clock = std::chrono::steady_clock;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  std::vector<double> times;
  const auto begin = Clock::now();
  const size_t grain = kTile * kTile;
  do {
    const auto start = Clock::now();
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain),
                        [&](const tbb::blocked_range<size_t>& range) {
                          for (size_t i = range.begin(); i < range.end(); ++i) trace(i);
                        });
    });
    times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  } while (std::chrono::duration<double>(Clock::now() - begin).count() < seconds);
  return double(count) / median(times);
}

}  // namespace

RaySets makeLines(const PreparedScene& prepared, uint32_t width, uint32_t height) {
  RaySets rays;
  rays.primary = cameraRays(cameraOf(prepared, width, height), width, height);
  const std::array<glm::dvec3, 2> bounds = worldBounds(prepared.scene->source());
  const glm::vec3 centre(0.5 * (bounds[0] + bounds[1]) - prepared.scene->origin());
  const auto radius = float(0.5 * glm::distance(bounds[0], bounds[1]));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (size_t i = 0; i < rays.primary.size(); ++i) {
    const glm::vec3 from = centre + radius * uniformDirection(random, unit);
    const glm::vec3 to = centre + radius * uniformDirection(random, unit);
    if (from != to) addRay(rays.incoherent, from, glm::normalize(to - from));
  }
  return rays;
}

RaySets makeRays(const PreparedScene& prepared, uint32_t width, uint32_t height) {
  const CompiledScene& compiled = *prepared.scene;
  const auto scene = static_cast<RTCScene>(compiled.embreeScene());
  RaySets rays;
  rays.primary = cameraRays(cameraOf(prepared, width, height), width, height);
  const std::vector<HitPoint> points = hitPoints(scene, rays.primary);
  rays.incoherent = bounceRays(points);
  rays.shadow = lightRays(points, compiled.data());
  return rays;
}

EmbreeRates measureEmbree(const PreparedScene& prepared, const RaySets& rays, int threads,
                          double seconds) {
  const auto scene = static_cast<RTCScene>(prepared.scene->embreeScene());
  EmbreeRates rates;
  rates.version = versionOf(scene);
  rates.primary = rate(rays.primary.size(), threads, seconds,
                       [&](size_t i) { traceClosest(scene, rays.primary, i); });
  rates.incoherent = rate(rays.incoherent.size(), threads, seconds,
                          [&](size_t i) { traceClosest(scene, rays.incoherent, i); });
  rates.shadow = rate(rays.shadow.size(), threads, seconds, [&](size_t i) {
    rl::KernelTraceContext context = opaqueContext();
    RTCRay ray = makeRay(rays.shadow, i);
    rl::embreeOccluded(scene, context.embree, ray);
  });
  return rates;
}

}  // namespace restlab
