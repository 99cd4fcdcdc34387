#include "experiments/cli/bench_embree.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "core/backend/alpha_filter.h"
#include "core/image/intervals.h"

namespace restlab {

namespace {

constexpr uint32_t kTile = 16;

struct RayBatch {
  std::vector<glm::vec3> origins, directions;
  std::vector<float> lengths;

  void add(const glm::vec3& origin, const glm::vec3& direction, float length) {
    origins.push_back(origin);
    directions.push_back(direction);
    lengths.push_back(length);
  }
};

struct HitPoint {
  glm::vec3 posW, normalW;  // the normal looks back along the ray
};

RTCRay makeRay(const RayBatch& rays, size_t i) {
  RTCRay ray = {};
  ray.org_x = rays.origins[i].x;
  ray.org_y = rays.origins[i].y;
  ray.org_z = rays.origins[i].z;
  ray.dir_x = rays.directions[i].x;
  ray.dir_y = rays.directions[i].y;
  ray.dir_z = rays.directions[i].z;
  ray.tnear = 1e-4f;
  ray.tfar = rays.lengths[i];
  ray.mask = 0xffffffffu;
  return ray;
}

// Embree alone sees no textures: every hit is opaque, also that of a mesh with a filter.
void acceptHit(const RTCFilterFunctionNArguments*) {}

rl::AlphaTraceContext opaqueContext() {
  rl::AlphaTraceContext context;
  rtcInitIntersectContext(&context.embree);
  context.filter = acceptHit;
  return context;
}

RTCRayHit traceClosest(RTCScene scene, const RayBatch& rays, size_t i) {
  rl::AlphaTraceContext context = opaqueContext();
  RTCRayHit query = {};
  query.ray = makeRay(rays, i);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context.embree, &query);
  return query;
}

RayBatch cameraRays(const rl::Camera& camera, uint32_t width, uint32_t height) {
  RayBatch rays;
  const auto add = [&](uint32_t x, uint32_t y) {
    const float u = (2.0f * (float(x) + 0.5f) / float(width) - 1.0f) * camera.halfWidth;
    const float v = (1.0f - 2.0f * (float(y) + 0.5f) / float(height)) * camera.halfHeight;
    const glm::vec3 aside = camera.rightW * u + camera.upW * v;
    if (camera.kind == rl::RL_CAMERA_ORTHOGRAPHIC) {
      rays.add(camera.posW + aside, camera.forwardW, std::numeric_limits<float>::infinity());
    } else {
      rays.add(camera.posW, glm::normalize(camera.forwardW + aside),
               std::numeric_limits<float>::infinity());
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

std::vector<HitPoint> hitPoints(RTCScene scene, const RayBatch& rays) {
  std::vector<HitPoint> points;
  for (size_t i = 0; i < rays.origins.size(); ++i) {
    const RTCRayHit query = traceClosest(scene, rays, i);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    // The normal of an instance is in its own space; for directions of a benchmark that will do.
    glm::vec3 normal = glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const float length = glm::length(normal);
    if (!(length > 0.0f)) continue;
    normal /= length;
    if (glm::dot(normal, rays.directions[i]) > 0.0f) normal = -normal;
    const glm::vec3 posW = rays.origins[i] + rays.directions[i] * query.ray.tfar;
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
    // A point on the unit sphere around the normal's tip: cosine distributed.
    glm::vec3 direction = point.normalW + uniformDirection(random, unit);
    const float length = glm::length(direction);
    direction = length > 1e-3f ? direction / length : point.normalW;
    rays.add(point.posW, direction, std::numeric_limits<float>::infinity());
  }
  return rays;
}

RayBatch lightRays(const std::vector<HitPoint>& points, const rl::SceneData& scene) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  RayBatch rays;
  for (const HitPoint& point : points) {
    glm::vec3 span = uniformDirection(random, unit) * 1e6f;  // no light, or the environment
    if (scene.lightCount > 0) {
      const uint32_t index =
          std::min(uint32_t(unit(random) * float(scene.lightCount)), scene.lightCount - 1);
      const rl::Light& light = scene.lights.data[index];
      if (light.kind == rl::RL_LIGHT_TRIANGLE) {
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
    rays.add(point.posW, span, 0.999f);
  }
  return rays;
}

// Rays per second of the median repetition.
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

EmbreeRates measureEmbree(const PreparedScene& prepared, uint32_t width, uint32_t height,
                          int threads, double seconds) {
  const CompiledScene& compiled = *prepared.scene;
  const auto scene = static_cast<RTCScene>(compiled.embreeScene());
  const rl::Camera camera =
      compiled.camera(compiled.source().cameras.at(prepared.camera), width, height);
  const RayBatch primary = cameraRays(camera, width, height);
  const std::vector<HitPoint> points = hitPoints(scene, primary);
  const RayBatch bounces = bounceRays(points), shadows = lightRays(points, compiled.data());

  EmbreeRates rates;
  rates.hits = points.size();
  rates.primary = rate(primary.origins.size(), threads, seconds,
                       [&](size_t i) { traceClosest(scene, primary, i); });
  rates.incoherent = rate(bounces.origins.size(), threads, seconds,
                          [&](size_t i) { traceClosest(scene, bounces, i); });
  rates.shadow = rate(shadows.origins.size(), threads, seconds, [&](size_t i) {
    rl::AlphaTraceContext context = opaqueContext();
    RTCRay ray = makeRay(shadows, i);
    rtcOccluded1(scene, &context.embree, &ray);
  });
  return rates;
}

}  // namespace restlab
