#include "core/backend/cpu_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/raster/raster_triangles.h"

namespace restlab {

namespace {

constexpr uint32_t kRasterTile = 32;              // pixels; a row of fragments holds a tile
constexpr size_t kRasterChunk = size_t{1} << 16;  // triangles
constexpr size_t kSegment = 4096;                 // triangles that one task sets up
constexpr uint32_t kWritten = rl::RL_INVALID;     // no triangle of the chunk
static_assert(kRasterTile * kRasterTile <= rl::RL_ENTRY_ROW);

// A value that is linear on the film: dot(plane, (x, y, 1)) in pixels.
double planeAt(const glm::dvec3& plane, double x, double y) {
  return plane.x * x + (plane.y * y + plane.z);
}

// Points on an edge belong to the triangle at its right, or below it.
bool ownsEdge(const glm::dvec3& edge) { return edge.x > 0.0 || (edge.x == 0.0 && edge.y > 0.0); }

struct ScreenTriangle {
  std::array<glm::dvec3, 3> edges;  // weights of the corners over the distance; sum: 1 / distance
  glm::dvec3 depth;
  std::array<bool, 3> owns;  // points on the edge are in the triangle
  glm::ivec4 box;            // pixels that it may cover: low corner, then high corner (exclusive)
  bool asks = false;         // the fragment stage decides
  bool isShape = false;      // and says how far the surface is
  uint32_t instance = 0;
  uint32_t primitive = 0;  // of the scene

  bool covers(const glm::dvec3& e) const {
    return (e.x > 0.0 || (e.x == 0.0 && owns[0])) && (e.y > 0.0 || (e.y == 0.0 && owns[1])) &&
           (e.z > 0.0 || (e.z == 0.0 && owns[2]));
  }
  glm::dvec3 edgesAt(double x, double y) const {
    return {planeAt(edges[0], x, y), planeAt(edges[1], x, y), planeAt(edges[2], x, y)};
  }
};

// Pixels [low, high) and what their fragments were so far.
struct ScreenTile {
  glm::uvec2 low, high;
  std::array<uint32_t, kRasterTile * kRasterTile>
      seen;  // triangle of the chunk; kWritten: hits are written already
  std::vector<glm::uvec4> fragments;
};

class CpuRaster {
 public:
  CpuRaster(const RasterScene& scene, const RasterTarget& target, const rl::RasterParams& params,
            const RasterStages& stages);
  void draw();

 private:
  void drawChunk();
  bool setUp(size_t index);
  glm::ivec4 boxOf(size_t index) const;
  void bin(size_t segment);
  void drawTile(size_t index);
  glm::uvec4 hitOf(uint32_t index, const glm::dvec3& e) const;
  template <typename Show>
  static void scan(const ScreenTile& tile, const ScreenTriangle& t, const Show& show);
  void drawTriangle(ScreenTile& tile, uint32_t index);
  void drawAsked(ScreenTile& tile, uint32_t index);
  void resolve(ScreenTile& tile);

  RasterScene scene_;
  RasterTarget target_;
  rl::RasterParams params_;
  RasterStages stages_;
  glm::uvec2 tiles_;
  uint32_t cornerVec4s_;
  std::vector<float> depth_;  // by pixel; 0: nothing
  // The triangles of the chunk that is drawn.
  std::vector<uint32_t> items_;                           // instance and primitive
  std::vector<glm::vec4> corners_;                        // of the vertex stage
  std::vector<ScreenTriangle> triangles_;                 // set up
  std::vector<std::vector<std::vector<uint32_t>>> bins_;  // by segment, by tile: triangles
};

CpuRaster::CpuRaster(const RasterScene& scene, const RasterTarget& target,
                     const rl::RasterParams& params, const RasterStages& stages)
    : scene_(scene),
      target_(target),
      params_(params),
      stages_(stages),
      tiles_((target.size + kRasterTile - 1u) / kRasterTile),
      cornerVec4s_(params.hasLight != 0 ? 3 : 1),
      depth_(size_t(target.size.x) * target.size.y, 0.0f) {
  std::fill(target_.hits, target_.hits + depth_.size(),
            glm::uvec4(rl::RL_INVALID, rl::RL_INVALID, 0, 0));
  if (params_.hasLight == 0) return;
  std::fill(target_.diffuse, target_.diffuse + depth_.size(), glm::vec4(0.0f));
  std::fill(target_.highlight, target_.highlight + depth_.size(), glm::vec4(0.0f));
}

void CpuRaster::draw() {
  for (uint32_t instance = 0; instance < scene_.instances.size(); ++instance) {
    const uint32_t count =
        rasterTriangles(scene_.geometries[scene_.instances[instance].geometry], params_.divisions);
    for (uint32_t primitive = 0; primitive < count; ++primitive) {
      items_.push_back(instance);
      items_.push_back(primitive);
      if (items_.size() == 2 * kRasterChunk) drawChunk();
    }
  }
  drawChunk();
}

void CpuRaster::drawChunk() {
  const size_t count = items_.size() / 2;
  if (count == 0) return;
  corners_.resize(3 * count * cornerVec4s_);
  triangles_.resize(count);
  rl::RasterBuffers buffers{};
  buffers.triangles.data = items_.data();
  buffers.corners.data = corners_.data();
  stages_.vertices(buffers, static_cast<uint32_t>(3 * count));
  const size_t segments = (count + kSegment - 1) / kSegment;
  bins_.resize(segments);
  stages_.parallel(segments, [this](size_t segment) { bin(segment); });
  stages_.parallel(size_t(tiles_.x) * tiles_.y, [this](size_t tile) { drawTile(tile); });
  items_.clear();
}

// False: the triangle covers no pixel.
bool CpuRaster::setUp(size_t index) {
  ScreenTriangle& t = triangles_[index];
  t.box = boxOf(index);
  if (t.box.x >= t.box.z || t.box.y >= t.box.w) return false;
  t.instance = items_[2 * index];
  const rl::Instance& inst = scene_.instances[t.instance];
  t.isShape = scene_.geometries[inst.geometry].shape != rl::RL_SHAPE_TRIANGLES;
  t.primitive = items_[2 * index + 1];
  if (!t.isShape) t.primitive >>= 2 * params_.divisions;
  t.asks = t.isShape || (inst.flags & rl::RL_INSTANCE_ALPHA) != 0;
  // Corners on the film, in pixels, times their distance.
  std::array<glm::dvec3, 3> v;
  glm::dvec3 z;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 clip(corners_[(3 * index + size_t(i)) * cornerVec4s_]);
    v[size_t(i)] = {0.5 * target_.size.x * (clip.x + clip.w),
                    0.5 * target_.size.y * (clip.y + clip.w), clip.w};
    z[i] = clip.z;
  }
  std::array<glm::dvec3, 3> edges = {glm::cross(v[1], v[2]), glm::cross(v[2], v[0]),
                                     glm::cross(v[0], v[1])};
  const double det = glm::dot(v[0], edges[0]);
  if (!(std::abs(det) > 0.0) || !std::isfinite(det)) return false;
  // Dividing would round the two triangles of an edge differently.
  const double side = det > 0.0 ? 1.0 : -1.0;
  t.depth = {0.0, 0.0, 0.0};
  for (size_t i = 0; i < 3; ++i) {
    t.edges[i] = side * edges[i];
    t.owns[i] = ownsEdge(t.edges[i]);
    t.depth += t.edges[i] * (z[int(i)] / std::abs(det));
  }
  return true;
}

glm::ivec4 CpuRaster::boxOf(size_t index) const {
  size_t count = 0;
  glm::dvec2 low(1e300), high(-1e300);
  const auto add = [&](const glm::dvec4& clip) {
    const glm::dvec2 film = {0.5 * target_.size.x * (clip.x / clip.w + 1.0),
                             0.5 * target_.size.y * (clip.y / clip.w + 1.0)};
    low = glm::min(low, film);
    high = glm::max(high, film);
    ++count;
  };
  std::array<glm::dvec4, 3> v;
  for (size_t i = 0; i < 3; ++i) v[i] = glm::dvec4(corners_[(3 * index + i) * cornerVec4s_]);
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec4 &a = v[i], &b = v[(i + 1) % 3];
    const double beyondA = a.w - a.z, beyondB = b.w - b.z;
    if (beyondA >= 0.0) add(a);
    if ((beyondA >= 0.0) != (beyondB >= 0.0)) add(glm::mix(a, b, beyondA / (beyondA - beyondB)));
  }
  if (count == 0) return {0, 0, 0, 0};
  // The centres of pixels within, and a little around it for rounding.
  const glm::dvec2 size(target_.size);
  const glm::dvec2 from = glm::clamp(glm::ceil(low - 0.501), glm::dvec2(0.0), size);
  const glm::dvec2 to = glm::clamp(glm::floor(high + 0.501), glm::dvec2(0.0), size);
  return {int(from.x), int(from.y), int(to.x), int(to.y)};
}

void CpuRaster::bin(size_t segment) {
  std::vector<std::vector<uint32_t>>& bins = bins_[segment];
  bins.resize(size_t(tiles_.x) * tiles_.y);
  for (std::vector<uint32_t>& tile : bins) tile.clear();
  const size_t end = std::min((segment + 1) * kSegment, triangles_.size());
  for (size_t i = segment * kSegment; i < end; ++i) {
    if (!setUp(i)) continue;
    const glm::ivec4 box = triangles_[i].box;
    const int tile = int(kRasterTile);
    for (int y = box.y / tile; y * tile < box.w; ++y) {
      for (int x = box.x / tile; x * tile < box.z; ++x)
        bins[size_t(y) * tiles_.x + size_t(x)].push_back(static_cast<uint32_t>(i));
    }
  }
}

void CpuRaster::drawTile(size_t index) {
  ScreenTile tile;
  tile.low = glm::uvec2(index % tiles_.x, index / tiles_.x) * kRasterTile;
  tile.high = glm::min(tile.low + kRasterTile, target_.size);
  tile.seen.fill(kWritten);
  for (const auto& bins : bins_) {
    for (const uint32_t triangle : bins[index]) {
      if (triangles_[triangle].asks)
        drawAsked(tile, triangle);
      else
        drawTriangle(tile, triangle);
    }
  }
  resolve(tile);
}

// A pixel of RasterBuffers::hits, from the edge functions there.
glm::uvec4 CpuRaster::hitOf(uint32_t index, const glm::dvec3& e) const {
  const ScreenTriangle& t = triangles_[index];
  const glm::vec3 weights(e / (e.x + e.y + e.z));
  glm::vec2 bary(weights.y, weights.z);
  if (params_.hasLight != 0) {  // parts of a triangle
    const glm::vec4* corners = corners_.data() + size_t(index) * 3 * cornerVec4s_;
    bary = {weights.x * corners[1].w + weights.y * corners[4].w + weights.z * corners[7].w,
            weights.x * corners[2].w + weights.y * corners[5].w + weights.z * corners[8].w};
  }
  return {t.instance, t.primitive, glm::floatBitsToUint(bary.x), glm::floatBitsToUint(bary.y)};
}

// Calls `show` for the pixels of the tile that a triangle covers: x, y, edge functions, depth.
template <typename Show>
void CpuRaster::scan(const ScreenTile& tile, const ScreenTriangle& t, const Show& show) {
  const uint32_t beginX = std::max(tile.low.x, uint32_t(t.box.x));
  const uint32_t endX = std::min(tile.high.x, uint32_t(t.box.z));
  const uint32_t beginY = std::max(tile.low.y, uint32_t(t.box.y));
  const uint32_t endY = std::min(tile.high.y, uint32_t(t.box.w));
  for (uint32_t y = beginY; y < endY; ++y) {
    for (uint32_t x = beginX; x < endX; ++x) {
      const glm::dvec3 e = t.edgesAt(x + 0.5, y + 0.5);
      if (t.covers(e)) show(x, y, e, static_cast<float>(planeAt(t.depth, x + 0.5, y + 0.5)));
    }
  }
}

void CpuRaster::drawTriangle(ScreenTile& tile, uint32_t index) {
  const ScreenTriangle& t = triangles_[index];
  scan(tile, t, [&](uint32_t x, uint32_t y, const glm::dvec3&, float depth) {
    float& nearest = depth_[size_t(y) * target_.size.x + x];
    if (!(depth > nearest) || depth > 1.0f) return;
    nearest = depth;
    tile.seen[(y - tile.low.y) * kRasterTile + (x - tile.low.x)] = index;
  });
}

// Fragments of one triangle in a tile, which the fragment stage may drop.
void CpuRaster::drawAsked(ScreenTile& tile, uint32_t index) {
  const ScreenTriangle& t = triangles_[index];
  tile.fragments.clear();
  scan(tile, t, [&](uint32_t x, uint32_t y, const glm::dvec3& e, float depth) {
    const uint32_t pixel = y * target_.size.x + x;
    // The box of a shape ends behind it.
    if (!t.isShape && (!(depth > depth_[pixel]) || depth > 1.0f)) return;
    tile.fragments.push_back(hitOf(index, e));
    tile.fragments.emplace_back(pixel, glm::floatBitsToUint(depth), 0u, 0u);
  });
  if (tile.fragments.empty()) return;
  rl::RasterBuffers buffers{};
  buffers.fragments.data = tile.fragments.data();
  stages_.fragments(buffers, static_cast<uint32_t>(tile.fragments.size() / 2));
  for (size_t i = 0; i < tile.fragments.size(); i += 2) {
    const glm::uvec4 &hit = tile.fragments[i], &q = tile.fragments[i + 1];
    const float depth = glm::uintBitsToFloat(q.y);
    if (q.z == 0 || !(depth > depth_[q.x])) continue;
    depth_[q.x] = depth;
    target_.hits[q.x] = hit;
    const uint32_t x = q.x % target_.size.x, y = q.x / target_.size.x;
    uint32_t& seen = tile.seen[(y - tile.low.y) * kRasterTile + (x - tile.low.x)];
    seen = params_.hasLight != 0 && !t.isShape ? index : kWritten;
  }
}

void CpuRaster::resolve(ScreenTile& tile) {
  for (uint32_t y = tile.low.y; y < tile.high.y; ++y) {
    for (uint32_t x = tile.low.x; x < tile.high.x; ++x) {
      const uint32_t index = tile.seen[(y - tile.low.y) * kRasterTile + (x - tile.low.x)];
      if (index == kWritten) continue;
      const ScreenTriangle& t = triangles_[index];
      const glm::dvec3 e = t.edgesAt(x + 0.5, y + 0.5);
      const size_t pixel = size_t(y) * target_.size.x + x;
      // The fragment stage has written the hit of what asks.
      if (!t.asks) target_.hits[pixel] = hitOf(index, e);
      if (params_.hasLight == 0) continue;
      const glm::vec3 weights(e / (e.x + e.y + e.z));
      const glm::vec4* corners = corners_.data() + size_t(index) * 3 * cornerVec4s_;
      target_.diffuse[pixel] =
          weights.x * corners[1] + weights.y * corners[4] + weights.z * corners[7];
      target_.highlight[pixel] =
          weights.x * corners[2] + weights.y * corners[5] + weights.z * corners[8];
    }
  }
}

}  // namespace

void rasterise(const RasterScene& scene, const RasterTarget& target, const rl::RasterParams& params,
               const RasterStages& stages) {
  CpuRaster(scene, target, params, stages).draw();
}

}  // namespace restlab
