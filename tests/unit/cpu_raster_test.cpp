// The rasteriser of the CPU backend alone: corners are given by clip position.
#include "core/backend/cpu_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "core/raster/raster_triangles.h"

namespace restlab::unit {
namespace {

struct ClipTriangle {
  std::array<glm::vec4, 3> corners;
  bool asks = false;  // the fragment stage decides
};

// Draws triangles, each an instance of its own.
struct Film {
  explicit Film(glm::uvec2 pixels) : size(pixels), hits(size_t(pixels.x) * pixels.y), light(2) {
    for (auto& part : light) part.resize(hits.size());
  }
  glm::uvec2 size;
  std::vector<glm::uvec4> hits;
  std::vector<std::vector<glm::vec4>> light;
  std::vector<uint32_t> dropped;  // instances that the fragment stage drops

  void draw(const std::vector<ClipTriangle>& triangles, bool hasLight = false) {
    std::vector<rl::Geometry> geometries(1);
    geometries[0].triangleCount = 1;
    geometries[0].shape = rl::RL_SHAPE_TRIANGLES;
    std::vector<rl::Instance> instances(triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i)
      instances[i].flags = triangles[i].asks ? rl::RL_INSTANCE_ALPHA : 0u;
    rl::RasterParams params{};
    params.hasLight = hasLight ? 1u : 0u;
    RasterStages stages;
    stages.vertices = [&](const rl::RasterBuffers& raster, uint32_t corners) {
      for (uint32_t i = 0; i < corners; ++i) {
        const glm::vec4& clip = triangles[raster.triangles.data[i / 3 * 2]].corners[i % 3];
        if (!hasLight) {
          raster.corners.data[i] = clip;
          continue;
        }
        raster.corners.data[3 * i] = clip;
        raster.corners.data[3 * i + 1] = glm::vec4(float(i % 3), 1.0f, 0.0f, i % 3 == 1);
        raster.corners.data[3 * i + 2] = glm::vec4(2.0f, 0.0f, 0.0f, i % 3 == 2);
      }
    };
    stages.fragments = [&](const rl::RasterBuffers& raster, uint32_t fragments) {
      for (uint32_t i = 0; i < fragments; ++i) {
        const uint32_t instance = raster.fragments.data[2 * i].x;
        raster.fragments.data[2 * i + 1].z =
            std::find(dropped.begin(), dropped.end(), instance) == dropped.end() ? 1u : 0u;
      }
    };
    stages.parallel = [](size_t count, const std::function<void(size_t)>& run) {
      std::jthread other([&] {
        for (size_t i = 1; i < count; i += 2) run(i);
      });
      for (size_t i = 0; i < count; i += 2) run(i);
    };
    rasterise({geometries, instances},
              {size, hits.data(), hasLight ? light[0].data() : nullptr,
               hasLight ? light[1].data() : nullptr},
              params, stages);
  }
  uint32_t instanceAt(uint32_t x, uint32_t y) const { return hits[size_t(y) * size.x + x].x; }
  size_t count(uint32_t instance) const {
    return size_t(std::count_if(hits.begin(), hits.end(),
                                [&](const glm::uvec4& hit) { return hit.x == instance; }));
  }
};

// Clip position of a place on the film, in pixels, at a distance; nearest: 0.01.
glm::vec4 clipOf(const Film& film, double x, double y, double distance) {
  return {float((2.0 * x / film.size.x - 1.0) * distance),
          float((2.0 * y / film.size.y - 1.0) * distance), 0.01f, float(distance)};
}

ClipTriangle triangleOf(const Film& film, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  return {{clipOf(film, a.x, a.y, a.z), clipOf(film, b.x, b.y, b.z), clipOf(film, c.x, c.y, c.z)}};
}

TEST(CpuRaster, WeightsAreCorrectInPerspective) {
  Film film({64, 48});
  const glm::dvec3 a(3.0, 5.0, 1.0), b(60.0, 10.0, 20.0), c(20.0, 46.0, 5.0);
  film.draw({triangleOf(film, a, b, c)}, true);
  size_t covered = 0;
  for (uint32_t y = 0; y < 48; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const size_t pixel = size_t(y) * 64 + x;
      const glm::uvec4& hit = film.hits[pixel];
      if (hit.x == rl::RL_INVALID) continue;
      ++covered;
      // Weights on the film, then over the distances.
      const glm::dvec2 p(x + 0.5, y + 0.5), u(b - a), v(c - a), w(p - glm::dvec2(a));
      const double det = u.x * v.y - u.y * v.x;
      const double s = (w.x * v.y - w.y * v.x) / det, t = (u.x * w.y - u.y * w.x) / det;
      const double sum = (1.0 - s - t) / a.z + s / b.z + t / c.z;
      const double second = s / b.z / sum, third = t / c.z / sum;
      EXPECT_NEAR(double(glm::uintBitsToFloat(hit.z)), second, 1e-5) << x << " " << y;
      EXPECT_NEAR(double(glm::uintBitsToFloat(hit.w)), third, 1e-5) << x << " " << y;
      EXPECT_NEAR(double(film.light[0][pixel].x), second + 2.0 * third, 1e-5) << x << " " << y;
      EXPECT_NEAR(double(film.light[1][pixel].x), 2.0, 1e-5);
    }
  }
  EXPECT_GT(covered, 800u);
}

// Neighbours in a fan leave no hole, and no pixel has two owners. Corners lie on pixel centres, on
// edges of pixels, and anywhere; some are behind the camera.
TEST(CpuRaster, NeighboursShareTheirEdgeWithoutHolesAndTwice) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    Film film({40, 40});
    const auto place = [&] {
      std::uniform_real_distribution<double> any(4.0, 36.0);
      const double x = any(random), y = any(random);
      return round % 3 == 0 ? glm::dvec2(x, y) : glm::floor(glm::dvec2(x, y)) + (round % 3) * 0.5;
    };
    const glm::dvec2 middle = place();
    const double corners[4][2] = {{-5.0, -5.0}, {45.0, -5.0}, {45.0, 45.0}, {-5.0, 45.0}};
    std::vector<ClipTriangle> fan;
    for (int i = 0; i < 4; ++i) {
      const double* p = corners[i];
      const double* q = corners[(i + 1) % 4];
      // Each turns as it likes: the winding does not matter.
      const glm::dvec3 a(middle, 2.0), b(p[0], p[1], 1.0 + i), c(q[0], q[1], 1.0 + (i + 1) % 4);
      fan.push_back(i % 2 == 0 ? triangleOf(film, a, b, c) : triangleOf(film, a, c, b));
    }
    std::vector<int> owners(film.hits.size(), 0);
    for (const ClipTriangle& triangle : fan) {
      Film alone(film.size);
      alone.draw({triangle});
      for (size_t i = 0; i < owners.size(); ++i) owners[i] += alone.hits[i].x == 0u ? 1 : 0;
    }
    for (size_t i = 0; i < owners.size(); ++i)
      ASSERT_EQ(owners[i], 1) << "round " << round << ", pixel " << i % 40 << " " << i / 40;
  }
}

TEST(CpuRaster, TheNearestIsSeenAndOfEqualOnesTheFirst) {
  Film film({16, 16});
  const auto whole = [&](double distance) {
    return triangleOf(film, {-40.0, -40.0, distance}, {80.0, -40.0, distance},
                      {-40.0, 80.0, distance});
  };
  film.draw({whole(3.0), whole(2.0), whole(4.0), whole(2.0)});
  EXPECT_EQ(film.count(1), 256u);
  // Fragments that are dropped leave what is behind them.
  std::vector<ClipTriangle> some = {whole(3.0), whole(2.0), whole(1.0)};
  some[2].asks = true;
  film.dropped = {2};
  film.draw(some);
  EXPECT_EQ(film.count(1), 256u);
  film.dropped = {};
  film.draw(some);
  EXPECT_EQ(film.count(2), 256u);
}

// A floor that reaches from behind the camera to the horizon covers the lower half; what is nearer
// than the nearest distance is cut.
TEST(CpuRaster, PartsBehindTheCameraAreNotSeen) {
  Film film({32, 32});
  // y points down; points of a plane one metre below: clip y = 1, w = distance.
  const auto corner = [](float x, float distance) { return glm::vec4(x, 1.0f, 0.01f, distance); };
  film.draw({{{corner(-1e4f, -50.0f), corner(1e4f, -50.0f), corner(0.0f, 1e5f)}}});
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x)
      EXPECT_EQ(film.instanceAt(x, y), y < 16 ? rl::RL_INVALID : 0u);
  Film close({32, 32});
  close.draw({triangleOf(close, {-99.0, -99.0, 0.009}, {99.0, -99.0, 0.009}, {0.0, 99.0, 0.009})});
  EXPECT_EQ(close.count(0), 0u);
  // From 0.005 at the upper left: cut where the inverse distance is above 100.
  close.draw({triangleOf(close, {0.0, 0.0, 0.005}, {40.0, 0.0, 0.1}, {0.0, 40.0, 0.1})});
  for (uint32_t x = 0; x < 16; ++x) {
    const double inverse = 200.0 + (x + x + 1.0) / 40.0 * (10.0 - 200.0);
    EXPECT_EQ(close.instanceAt(x, x), inverse > 100.0 ? rl::RL_INVALID : 0u) << x;
  }
}

TEST(CpuRaster, CornersThatAreNoNumbersAndTrianglesWithoutAreaDrawNothing) {
  Film film({16, 16});
  const float nan = std::nanf("");
  ClipTriangle bad = triangleOf(film, {0.0, 0.0, 1.0}, {16.0, 0.0, 1.0}, {0.0, 16.0, 1.0});
  bad.corners[1].x = nan;
  ClipTriangle infinite = bad;
  infinite.corners[1].x = INFINITY;
  const ClipTriangle flat = triangleOf(film, {0.0, 0.0, 1.0}, {8.0, 8.0, 1.0}, {16.0, 16.0, 1.0});
  film.draw({bad, infinite, flat});
  EXPECT_EQ(film.count(rl::RL_INVALID), 256u);
}

// More triangles than one chunk and one segment hold.
TEST(CpuRaster, ManyTrianglesAreDrawnInTheirOrder) {
  Film film({64, 64});
  std::vector<ClipTriangle> many;
  for (uint32_t i = 0; i < 70000; ++i) {
    const double x = i % 64, y = (i / 64) % 64;
    many.push_back(triangleOf(film, {x + 0.1, y + 0.1, 2.0}, {x + 0.9, y + 0.1, 2.0},
                              {x + 0.5, y + 0.9, 2.0}));
  }
  film.draw(many);
  for (uint32_t i = 0; i < 4096; ++i) EXPECT_EQ(film.hits[i].x, i);
}

}  // namespace
}  // namespace restlab::unit
