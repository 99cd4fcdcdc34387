// Grids of distances to meshes, against every triangle, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/distance/closest_triangle.h"
#include "core/scene/distance/distance_grid.h"
#include "core/scene/distance/winding.h"
#include "tests/unit/shape_cases.h"

namespace restlab::unit {
namespace {

Scene bodiesOf(const std::vector<std::pair<MeshGeometry, glm::dmat4>>& bodies) {
  Scene scene;
  for (const auto& [mesh, place] : bodies) {
    scene.instances.push_back({"body", static_cast<uint32_t>(scene.geometries.size()), 0, place});
    scene.geometries.push_back(mesh);
  }
  return scene;
}

MeshGeometry standInOf(const std::string& kind) {
  const ShapeCase& of = shapeNamed(kind);
  return of.info->standIn(of.shape);
}

const glm::dmat4 kHere(1.0);

double boxDistance(const glm::dvec3& p, const glm::dvec3& half) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

template <class Expected>
void expectSamples(const SampledGrid& grid, const Expected& expected, double error) {
  const glm::dvec3 cell = (grid.high - grid.low) / glm::dvec3(grid.samples - 1);
  size_t n = 0;
  for (int z = 0; z < grid.samples.z; ++z)
    for (int y = 0; y < grid.samples.y; ++y)
      for (int x = 0; x < grid.samples.x; ++x, ++n) {
        const glm::dvec3 p = grid.low + glm::dvec3(x, y, z) * cell;
        ASSERT_NEAR(double(grid.values[n]), expected(p), error) << x << ", " << y << ", " << z;
      }
}

// Lines through its corners and along its faces: the cells divide its edges.
TEST(DistanceGrids, OfACubeAreThoseOfTheFormula) {
  const glm::dmat4 flat = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.5, 0.25));
  const SampledGrid grid = distanceGrid(closedTriangles(bodiesOf({{standInOf("cube"), flat}})), 20);
  EXPECT_EQ(grid.samples, glm::ivec3(21, 13, 9));
  expectSamples(
      grid,
      [](const glm::dvec3& p) {
        return boxDistance(p, {1.0, 0.5, 0.25});
      },
      1e-6);
}

double distance2ToAll(const ClosedTriangles& s, const glm::dvec3& p) {
  double least = 1e300;
  for (const glm::uvec3& t : s.triangles) {
    const glm::dvec3 a(s.positions[t.x]), u = glm::dvec3(s.positions[t.y]) - a,
                                          v = glm::dvec3(s.positions[t.z]) - a;
    // The least of a square over the triangle, by narrowing it down along both edges.
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 from = k == 2 ? a + u : a, along = k == 0 ? u : k == 1 ? v : v - u;
      const double at = std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0);
      least = std::min(least, glm::dot(p - from - at * along, p - from - at * along));
    }
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double pu = glm::dot(p - a, u), pv = glm::dot(p - a, v), det = uu * vv - uv * uv;
    const double x = (pu * vv - pv * uv) / det, y = (pv * uu - pu * uv) / det;
    if (x >= 0.0 && y >= 0.0 && x + y <= 1.0) {
      const glm::dvec3 away = p - a - x * u - y * v;
      least = std::min(least, glm::dot(away, away));
    }
  }
  return least;
}

TEST(DistanceGrids, AreThoseOfTheClosestOfAllTriangles) {
  const glm::dmat4 place = glm::translate(
      glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1.0, 2.0, 0.5)), glm::dvec3(0.3, -5.0, 2.0));
  const ClosedTriangles torus = closedTriangles(bodiesOf({{standInOf("torus"), place}}));
  const ClosestTriangle closest(torus);
  Inputs inputs(1);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 middle = 0.5 * (torus.low + torus.high);
    const glm::dvec3 p =
        middle + double(inputs.scale(0.01f, 30.0f)) * glm::dvec3(inputs.direction());
    const double expected = std::sqrt(distance2ToAll(torus, p));
    ASSERT_NEAR(closest.distance(p, 1e30), expected, 1e-9 * (1.0 + expected)) << i;
    ASSERT_NEAR(closest.distance(p, expected), expected, 1e-9 * (1.0 + expected)) << i;
  }
}

// Inside, whichever way the faces look; where bodies overlap, too; a hollow is outside.
TEST(DistanceGrids, AreBelowZeroWhereTheSurfaceWindsAround) {
  MeshGeometry turned = standInOf("sphere");
  for (glm::uvec3& t : turned.triangles) std::swap(t.y, t.z);
  const auto at = [](double x, double size) {
    return glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.0, 0.0)), glm::dvec3(size));
  };
  const SampledGrid grid =
      distanceGrid(closedTriangles(bodiesOf({{standInOf("sphere"), at(-2.0, 1.0)},
                                             {standInOf("sphere"), at(-1.0, 1.0)},
                                             {turned, at(1.5, 1.0)},
                                             {standInOf("sphere"), at(4.0, 1.0)},
                                             {turned, at(4.0, 0.5)}})),
                   80);
  const glm::dvec3 cell = (grid.high - grid.low) / glm::dvec3(grid.samples - 1);
  size_t n = 0, inside = 0;
  for (int z = 0; z < grid.samples.z; ++z)
    for (int y = 0; y < grid.samples.y; ++y)
      for (int x = 0; x < grid.samples.x; ++x, ++n) {
        const glm::dvec3 p = grid.low + glm::dvec3(x, y, z) * cell;
        const auto to = [&](double c) { return glm::length(p - glm::dvec3(c, 0.0, 0.0)); };
        const double body =
            std::min({to(-2.0), to(-1.0), to(1.5), std::max(to(4.0), 1.5 - to(4.0))});
        if (std::abs(body - 1.0) < 0.01) continue;  // the sphere's triangles
        ASSERT_EQ(grid.values[n] < 0.0f, body < 1.0) << x << ", " << y << ", " << z;
        inside += body < 1.0 ? 1 : 0;
      }
  EXPECT_GT(inside, 1000u);
}

// A line of samples through every corner of a fan: one edge, one triangle each.
TEST(DistanceGrids, LinesThroughCornersAreTold) {
  Inputs inputs(2);
  for (int i = 0; i < 200; ++i) {
    // An octahedron whose corners lie on samples, sheared by whole cells.
    MeshGeometry mesh;
    const int shear = int(inputs.below(5)) - 2, other = int(inputs.below(5)) - 2;
    for (const glm::ivec3& c :
         {glm::ivec3(4, 0, 0), {-4, 0, 0}, {0, 4, 0}, {0, -4, 0}, {0, 0, 4}, {0, 0, -4}})
      mesh.positions.emplace_back(glm::vec3(c.x, c.y + shear * c.x / 4, c.z + other * c.y / 4));
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    const ClosedTriangles closed = closedTriangles(bodiesOf({{mesh, kHere}}));
    const SamplePlaces places{glm::ivec3(25), glm::dvec3(-6.0), 0.5};
    const std::vector<uint8_t> inside = insideSamples(closed, places);
    size_t n = 0;
    for (int z = 0; z < 25; ++z)
      for (int y = 0; y < 25; ++y)
        for (int x = 0; x < 25; ++x, ++n) {
          // Back through the shears: |x| + |y| + |z| < 4.
          const double px = places.at(0, x), py0 = places.at(1, y), pz0 = places.at(2, z);
          const double py = py0 - shear * px / 4.0;
          const double cornerY = other * py / 4.0;
          const double all = std::abs(px) + std::abs(py) + std::abs(pz0 - cornerY);
          if (std::abs(all - 4.0) < 1e-6) continue;
          ASSERT_EQ(inside[n] != 0, all < 4.0)
              << shear << ", " << other << " at " << px << ", " << py0 << ", " << pz0;
        }
  }
}

TEST(DistanceGrids, OfOpenSurfacesAreRefused) {
  const auto refusal = [](const Scene& scene) -> std::string {
    try {
      distanceGrid(closedTriangles(scene), 16);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      return error.what();
    }
    return "";
  };
  MeshGeometry cube = standInOf("cube");
  EXPECT_EQ(refusal(bodiesOf({{cube, kHere}})), "");
  MeshGeometry open = cube;
  open.triangles.pop_back();
  EXPECT_NE(refusal(bodiesOf({{open, kHere}})).find("3 of its 18 edges"), std::string::npos)
      << refusal(bodiesOf({{open, kHere}}));
  MeshGeometry mixed = cube;
  std::swap(mixed.triangles[0].x, mixed.triangles[0].y);
  EXPECT_NE(refusal(bodiesOf({{mixed, kHere}})).find("is not closed"), std::string::npos);
  EXPECT_NE(refusal(Scene{}).find("no triangle"), std::string::npos);
  MeshGeometry thin = cube;
  for (glm::vec3& p : thin.positions) p.z *= 1e-3f;
  EXPECT_NE(refusal(bodiesOf({{thin, kHere}})).find("thinner than a cell"), std::string::npos);
}

}  // namespace
}  // namespace restlab::unit
