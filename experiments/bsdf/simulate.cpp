#include "experiments/bsdf/simulate.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "core/backend/embree.h"
#include "core/base/error.h"
#include "experiments/bsdf/uniform.h"

namespace restlab {
namespace {

using std::numbers::pi;

constexpr int kMostTiles = 10'000;  // that a ray crosses

// Triangles of one period, its last row and column repeat the first.
class Tile {
 public:
  explicit Tile(const HeightField& field)
      : width_(double(field.heights.width) * field.spacing),
        depth_(double(field.heights.height) * field.spacing) {
    const uint32_t w = field.heights.width, h = field.heights.height;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), size_t(w + 1) * (h + 1)));
    for (uint32_t y = 0; y <= h; ++y) {
      for (uint32_t x = 0; x <= w; ++x, corners += 3) {
        const float z = field.heights.at(x % w, y % h).x;
        corners[0] = float(x * field.spacing);
        corners[1] = float(y * field.spacing);
        corners[2] = z;
        top_ = std::max(top_, double(z));
        bottom_ = std::min(bottom_, double(z));
      }
    }
    auto* triangles = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), size_t(w) * h * 2));
    for (uint32_t y = 0; y < h; ++y) {
      for (uint32_t x = 0; x < w; ++x, triangles += 6) {
        const uint32_t a = y * (w + 1) + x, b = a + 1, c = a + w + 1, d = c + 1;
        const uint32_t corner[6] = {a, b, d, a, d, c};
        std::copy(corner, corner + 6, triangles);
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
    margin_ = 1e-6 * std::max({width_, depth_, top_ - bottom_});
  }

  double width() const { return width_; }
  double depth() const { return depth_; }
  double above() const { return top_ + margin_; }

  enum class End { hit, out, lost };
  // Follows a ray from `position`; on a hit moves it there and sets the facet's normal.
  End follow(glm::dvec3& position, const glm::dvec3& direction, glm::dvec3& normal) const {
    for (int tile = 0; tile < kMostTiles; ++tile) {
      const double leaves = untilSide(position, direction);
      RTCRayHit ray = rayOf(position, direction, leaves);
      rl::EmbreeContext context;
      rl::embreeInitContext(context);
      rl::embreeIntersect(scene_.get(), context, ray);
      if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        normal = glm::normalize(glm::dvec3(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z));
        if (normal.z < 0.0) normal = -normal;
        position += direction * double(ray.ray.tfar);
        return End::hit;
      }
      position += direction * leaves;
      if (direction.z > 0.0 && position.z >= above()) return End::out;
      if (position.z < bottom_ - margin_) return End::lost;
      wrap(position, direction);
    }
    return End::lost;
  }
  // Moves a point off its facet.
  void lift(glm::dvec3& position, const glm::dvec3& normal) const {
    position += normal * (2.0 * margin_);
  }

 private:
  struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  // Length to a side of the tile; for a ray that goes up, or to where nothing is above it.
  double untilSide(const glm::dvec3& p, const glm::dvec3& d) const {
    double t = std::numeric_limits<double>::max();
    if (d.x != 0.0) t = std::min(t, ((d.x > 0.0 ? width_ : 0.0) - p.x) / d.x);
    if (d.y != 0.0) t = std::min(t, ((d.y > 0.0 ? depth_ : 0.0) - p.y) / d.y);
    if (d.z != 0.0)
      t = std::min(t, ((d.z > 0.0 ? above() + margin_ : bottom_ - 2.0 * margin_) - p.z) / d.z);
    return std::max(t, 0.0);
  }
  static RTCRayHit rayOf(const glm::dvec3& p, const glm::dvec3& d, double length) {
    RTCRayHit ray{};
    ray.ray.org_x = float(p.x);
    ray.ray.org_y = float(p.y);
    ray.ray.org_z = float(p.z);
    ray.ray.dir_x = float(d.x);
    ray.ray.dir_y = float(d.y);
    ray.ray.dir_z = float(d.z);
    ray.ray.tfar = float(length * 1.0001);
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray;
  }
  void wrap(glm::dvec3& p, const glm::dvec3& d) const {
    const double step = 1e-9 * std::max(width_, depth_);
    if (d.x > 0.0 && p.x >= width_ - step)
      p.x = 0.0;
    else if (d.x < 0.0 && p.x <= step)
      p.x = width_;
    if (d.y > 0.0 && p.y >= depth_ - step)
      p.y = 0.0;
    else if (d.y < 0.0 && p.y <= step)
      p.y = depth_;
  }

  double width_, depth_, margin_ = 0.0;
  double top_ = std::numeric_limits<double>::lowest(), bottom_ = std::numeric_limits<double>::max();
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device_{rtcNewDevice(nullptr)};
  std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene_{rtcNewScene(device_.get())};
};

glm::dvec3 cosineAbout(const glm::dvec3& n, Uniform& uniform) {
  const double z = 1.0 - 2.0 * uniform(), phi = 2.0 * pi * uniform();
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  const glm::dvec3 d = n + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
  const double length = glm::length(d);
  return length > 1e-9 ? d / length : n;
}

struct Row {
  std::vector<double> energy;  // by theta of wi and azimuth
  double absorbed = 0.0;
  uint64_t lost = 0;
};

// Rays of one theta of wo.
Row traceRow(const Tile& tile, const SimulationConfig& config, uint32_t i) {
  const glm::uvec3 n = config.sizes;
  Row row;
  row.energy.resize(size_t(n.y) * n.z);
  Uniform uniform(config.seed * 1'000'003u + i);
  const auto cell = [](double share, uint32_t size) {
    return std::min(uint32_t(share * size), size - 1);
  };
  for (uint64_t s = 0; s < config.samples; ++s) {
    const double place = (double(s) + uniform()) / double(config.samples);
    const double theta = 0.5 * pi * (i + place) / n.x, phi = 2.0 * pi * uniform();
    const glm::dvec3 wo(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                        std::cos(theta));
    glm::dvec3 position(tile.width() * uniform(), tile.depth() * uniform(), tile.above());
    glm::dvec3 direction = -wo, normal;
    double throughput = 1.0;
    Tile::End end = tile.follow(position, direction, normal);
    for (uint32_t bounce = 0; end == Tile::End::hit; ++bounce) {
      if (bounce == config.bounces) break;
      throughput *= config.albedo;
      tile.lift(position, normal);
      direction = config.base == FacetBase::lambert
                      ? cosineAbout(normal, uniform)
                      : direction - normal * (2.0 * glm::dot(direction, normal));
      end = tile.follow(position, direction, normal);
    }
    if (end == Tile::End::lost) ++row.lost;
    if (end == Tile::End::hit) row.absorbed += throughput;
    if (end != Tile::End::out) continue;
    const double thetaI = std::atan2(std::hypot(direction.x, direction.y), direction.z);
    const double across = wo.x * direction.y - wo.y * direction.x;
    const double along = wo.x * direction.x + wo.y * direction.y;
    row.energy[size_t(cell(thetaI / (0.5 * pi), n.y)) * n.z +
               cell(std::abs(std::atan2(across, along)) / pi, n.z)] += throughput;
  }
  return row;
}

double slopeOf(const HeightField& field) {
  const Image& z = field.heights;
  double sum = 0.0;
  for (uint32_t y = 0; y < z.height; ++y) {
    for (uint32_t x = 0; x < z.width; ++x) {
      const double here = z.at(x, y).x;
      const double dx = z.at((x + 1) % z.width, y).x - here;
      const double dy = z.at(x, (y + 1) % z.height).x - here;
      sum += dx * dx + dy * dy;
    }
  }
  return std::sqrt(sum / (double(z.width) * z.height)) / field.spacing;
}

void check(const HeightField& field) {
  const Image& z = field.heights;
  if (z.width < 2 || z.height < 2)
    failInput(
        fmt::format("a height field of {}x{}; at least 2x2 heights expected", z.width, z.height));
  for (size_t i = 0; i < z.pixels.size(); ++i) {
    if (!std::isfinite(z.pixels[i].x))
      failInput(
          fmt::format("the height of pixel ({}, {}) is not finite", i % z.width, i / z.width));
  }
}

}  // namespace

Simulation simulateBrdf(const HeightField& field, const SimulationConfig& config) {
  check(field);
  const Tile tile(field);
  const glm::uvec3 n = config.sizes;
  std::vector<Row> rows(n.x);
  tbb::parallel_for(uint32_t(0), n.x, [&](uint32_t i) { rows[i] = traceRow(tile, config, i); });
  Simulation result;
  result.slope = slopeOf(field);
  result.table = {"", TableAngles::directions, n, {}};
  result.table.values.reserve(size_t(n.x) * n.y * n.z);
  for (const Row& row : rows) {
    const double rays = double(config.samples - row.lost);
    result.absorbed += rays > 0.0 ? row.absorbed / rays / n.x : 0.0;
    result.lostRays += row.lost;
    for (uint32_t j = 0; j < n.y; ++j) {
      const double low = std::sin(0.5 * pi * j / n.y), high = std::sin(0.5 * pi * (j + 1.0) / n.y);
      // Both sides of wo's azimuth; the cosine of wi is in the energy already.
      const double projected = pi / n.z * (high * high - low * low);
      for (uint32_t k = 0; k < n.z; ++k)
        result.table.values.emplace_back(
            float(row.energy[size_t(j) * n.z + k] / std::max(rays, 1.0) / projected));
    }
  }
  makeReciprocal(result.table);
  return result;
}

}  // namespace restlab
