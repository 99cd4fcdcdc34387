// Shapes that emit: draws fit their density, a hit has the density of the draw, and the light that
// arrives is that of formulas.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tests/unit/constants.h"
#include "tests/unit/goodness.h"
#include "tests/unit/shape_cases.h"

namespace restlab::unit {
namespace {

std::vector<ShapeCase> drawnShapes() {
  std::vector<ShapeCase> cases = shapeCases();
  std::erase_if(cases, [](const ShapeCase& of) { return !of.info->hasDraws; });
  return cases;
}

class ShapeDraws : public testing::TestWithParam<ShapeCase> {};

// Counts draws in cells of the ids' coordinates, against the integral of the density over each.
void expectDrawsFit(const ShapeCase& of, const glm::vec3& receiver, const std::string& what) {
  LocalShape local(of);
  constexpr int kIdCells = 12, kFine = 20, kN = kIdCells * kFine;
  constexpr uint64_t kDraws = 200'000;
  std::vector<double> expected;
  std::vector<uint64_t> counts;
  std::map<uint32_t, size_t> firstOf;
  double total = 0.0;
  forEachCell(local, kN, [&](uint32_t part, int x, int y, const rl::ShapePoint& at, double area) {
    const size_t first = firstOf.try_emplace(part, expected.size()).first->second;
    if (first == expected.size()) expected.resize(first + size_t{kIdCells} * kIdCells, 0.0);
    const double p = double(local.d->shapeDensity(local.shape, receiver, at)) * area;
    expected[first + size_t(y / kFine) * kIdCells + size_t(x / kFine)] += p;
    total += p;
  });
  EXPECT_NEAR(total, 1.0, 0.01) << what << ": the density must integrate to 1";
  for (double& p : expected) p /= total;
  counts.assign(expected.size(), 0);
  Inputs inputs(3);
  for (uint64_t i = 0; i < kDraws; ++i) {
    const rl::SurfaceId id = local.d->shapeDraw(local.shape, receiver, inputs.square());
    ASSERT_TRUE(firstOf.count(id.primitive));
    ASSERT_TRUE(id.bary.x >= 0.0f && id.bary.x <= 1.0f && id.bary.y >= 0.0f && id.bary.y <= 1.0f);
    const auto cell = [](float v) { return std::min(int(v * kIdCells), kIdCells - 1); };
    ++counts[firstOf[id.primitive] + size_t(cell(id.bary.y)) * kIdCells + size_t(cell(id.bary.x))];
  }
  // Cells at the rim of a disk and at a horizon are integrated coarsely: they are joined.
  std::vector<uint64_t> joinedCounts(1, 0);
  std::vector<double> joined(1, 0.0);
  for (size_t i = 0; i < expected.size(); ++i) {
    const double actual = double(counts[i]) / double(kDraws);
    const bool isWhole = expected[i] > 0.7 / double(expected.size()) && expected[i] > 1e-3;
    if (isWhole) {
      joinedCounts.push_back(counts[i]);
      joined.push_back(expected[i]);
      EXPECT_NEAR(actual, expected[i], 0.15 * expected[i] + 1e-3) << what << ": cell " << i;
    } else {
      joinedCounts[0] += counts[i];
      joined[0] += expected[i];
    }
  }
  double relative = 0.0;
  for (size_t i = 1; i < joined.size(); ++i)
    relative += (double(joinedCounts[i]) / double(kDraws) - joined[i]) / joined[i];
  EXPECT_LT(std::abs(relative / double(joined.size() - 1)), 0.02) << what;
}

TEST_P(ShapeDraws, FitTheirDensity) {
  for (const glm::vec3& receiver : {glm::vec3(0.2f, 0.1f, 0.4f), glm::vec3(3.0f, -2.0f, 1.5f),
                                    glm::vec3(0.3f, 0.2f, -40.0f), glm::vec3(1.1f, 0.9f, 0.2f)})
    expectDrawsFit(GetParam(), receiver, GetParam().name + " from z " + std::to_string(receiver.z));
}

INSTANTIATE_TEST_SUITE_P(, ShapeDraws, testing::ValuesIn(drawnShapes()),
                         [](const auto& one) { return one.param.name; });

// Mean of the irradiance of light samples at a receiver, without visibility, and its error.
std::pair<double, double> irradianceOf(Dialect<>& d, const glm::vec3& posW, const glm::vec3& n) {
  constexpr int kSamples = 60'000;
  double sum = 0.0, sum2 = 0.0;
  for (uint32_t i = 0; i < kSamples; ++i) {
    rl::LightReceiver receiver;
    receiver.posW = posW;
    receiver.normalW = n;
    receiver.isTwoSided = 0;
    rl::Rng rng{};
    rng.key = glm::uvec2(i * 2654435761u, 77u);
    const rl::LightSample s = d->lightSample(rng, receiver);
    const rl::LightConnection c = d->lightConnect(s, posW);
    const double cosine = std::max(double(glm::dot(n, c.dirW)), 0.0);
    const double e =
        c.pdfSolidAngle > 0.0f ? double(c.emitted.x) * cosine / double(c.pdfSolidAngle) : 0.0;
    sum += e;
    sum2 += e * e;
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt(std::max(sum2 / kSamples - mean * mean, 0.0) / kSamples)};
}

// Lambert's formula for a polygon that is above the horizon, radiance 1.
double polygonIrradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& p,
                         const glm::dvec3& n) {
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(corners[i] - p),
                     b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), n);
  }
  return std::abs(0.5 * sum);
}

TEST(ShapeLights, IrradianceIsThatOfTheFormula) {
  const auto expectIrradiance = [](const std::string& kind, const glm::dmat4& m,
                                   const glm::dvec3& p, const glm::dvec3& n, double expected) {
    const auto scene = placedShape(shapeNamed(kind), m, 1.0f);
    Dialect<> d(scene);
    const auto [mean, error] = irradianceOf(d, glm::vec3(p - scene->origin()), glm::vec3(n));
    EXPECT_NEAR(mean, expected, 5.0 * error + 1e-5 * expected) << kind;
    EXPECT_LT(error, 0.02 * expected) << kind;
  };
  const glm::dvec3 up(0.0, 1.0, 0.0);
  // A sphere of radius 0.5 at a height of 3, seen under 30 degrees.
  const glm::dvec3 centre(std::sqrt(3.0), 3.0, 0.0);
  expectIrradiance("sphere", glm::scale(glm::translate(glm::dmat4(1.0), centre), glm::dvec3(0.5)),
                   glm::dvec3(0.0), up, kPi * 0.25 / 12.0 * std::cos(kPi / 6.0));
  // A disk of radius 0.5 that faces the receiver.
  glm::dmat4 down = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 2.0, 0.0)),
                                0.5 * kPi, glm::dvec3(1.0, 0.0, 0.0));
  expectIrradiance("disk", glm::scale(down, glm::dvec3(0.5)), glm::dvec3(0.0), up,
                   kPi * 0.25 / (4.0 + 0.25));
  const glm::dmat4 place = glm::scale(down, glm::dvec3(1.5, 0.8, 1.0));
  std::vector<glm::dvec3> corners;
  for (const glm::dvec2& c : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    corners.emplace_back(place * glm::dvec4(c, 0.0, 1.0));
  const glm::dvec3 receiver(0.7, 0.2, -0.4), tilted = glm::normalize(glm::dvec3(0.2, 1.0, 0.1));
  expectIrradiance("rectangle", place, receiver, tilted,
                   polygonIrradiance(corners, receiver, tilted));
}

// Solid angle of [x0, x1] x [y0, y1] at a height z above the origin, steradians.
double rectangleSolidAngle(double x0, double x1, double y0, double y1, double z) {
  const auto corner = [z](double x, double y) {
    return std::atan2(x * y, z * std::sqrt(x * x + y * y + z * z));
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

// From a thousandth of its size to where it is small.
TEST(ShapeLights, RectanglesAreDrawnBySolidAngle) {
  const ShapeCase& of = shapeNamed("rectangle");
  LocalShape local(of);
  constexpr int kCells = 8, kDraws = 400'000;
  Inputs inputs(13);
  for (const glm::vec3& receiver :
       {glm::vec3(0.2f, -0.3f, 0.0011f), glm::vec3(-0.99f, 0.999f, 0.003f),
        glm::vec3(0.7f, 0.9f, -0.02f), glm::vec3(1.01f, 0.5f, 0.05f), glm::vec3(0.0f, 0.0f, 0.3f),
        glm::vec3(2.0f, -3.0f, 1.0f), glm::vec3(-0.4f, 0.1f, -6.0f)}) {
    const double z = std::abs(double(receiver.z));
    const auto angleOf = [&](double x0, double x1, double y0, double y1) {
      const double x = receiver.x, y = receiver.y;
      return rectangleSolidAngle(x0 - x, x1 - x, y0 - y, y1 - y, z);
    };
    const double whole = angleOf(-1.0, 1.0, -1.0, 1.0);
    std::vector<double> expected;
    for (int i = 0; i < kCells * kCells; ++i) {
      const double x = 2.0 * (i % kCells) / kCells - 1.0, y = 2.0 * (i / kCells) / kCells - 1.0;
      expected.push_back(angleOf(x, x + 2.0 / kCells, y, y + 2.0 / kCells) / whole);
    }
    std::vector<uint64_t> counts(expected.size(), 0);
    for (int i = 0; i < kDraws; ++i) {
      const rl::SurfaceId id = local.d->shapeDraw(local.shape, receiver, inputs.square());
      const auto cell = [](float v) { return std::clamp(int(v * kCells), 0, kCells - 1); };
      ++counts[size_t(cell(id.bary.y)) * kCells + size_t(cell(id.bary.x))];
      const rl::ShapePoint p = local.d->shapePoint(local.shape, id);
      const double distance = glm::length(glm::dvec3(p.posL) - glm::dvec3(receiver));
      const double density = z / (distance * distance * distance * whole);
      ASSERT_NEAR(local.d->shapeDensity(local.shape, receiver, p) / density, 1.0, 2e-5);
    }
    expectFits(counts, expected, kDraws, "from z " + std::to_string(receiver.z));
  }
}

// Cosines to the normal at the near and the far side of what a receiver sees of the unit disk in
// the direction `turn` (radians, from where the middle lies); false: nothing.
bool diskCosines(double away, double z, double turn, std::array<double, 2>& between) {
  const double along = away * std::cos(turn), inside = 1.0 - away * away + along * along;
  if (!(inside > 0.0)) return false;
  const double far = along + std::sqrt(inside), near = std::max(along - std::sqrt(inside), 0.0);
  if (!(far > 0.0)) return false;
  between = {z / std::hypot(z, near), z / std::hypot(z, far)};
  return true;
}

// From a ten-thousandth of its radius to where it is small; cells are counted in directions.
TEST(ShapeLights, DisksAreDrawnBySolidAngle) {
  const ShapeCase& of = shapeNamed("disk");
  LocalShape local(of);
  constexpr int kTurns = 12, kSlices = 6, kFine = 40, kDraws = 300'000;
  Inputs inputs(17);
  for (const glm::vec3& receiver :
       {glm::vec3(0.2f, -0.3f, 2e-4f), glm::vec3(0.6f, 0.0f, -0.02f),
        glm::vec3(0.0f, 0.999f, 2e-3f), glm::vec3(-1.002f, 0.0f, 3e-3f),
        glm::vec3(1.1f, 0.9f, 0.05f), glm::vec3(0.0f, 0.0f, 0.3f), glm::vec3(2.0f, -3.0f, 1.0f),
        glm::vec3(-0.4f, 0.1f, -6.0f), glm::vec3(300.0f, 200.0f, 150.0f)}) {
    const std::string what = fmt::format("from ({}, {}, {})", receiver.x, receiver.y, receiver.z);
    const double z = std::abs(double(receiver.z)), away = std::hypot(receiver.x, receiver.y);
    const glm::dvec2 towards = away > 0.0 ? -glm::dvec2(receiver) / away : glm::dvec2(1.0, 0.0);
    const double widest = away > 1.0 ? std::asin(1.0 / away) : kPi;
    const auto densityAt = [&](const rl::ShapePoint& p) {
      const double distance = glm::length(glm::dvec3(p.posL) - glm::dvec3(receiver));
      return double(local.d->shapeDensity(local.shape, receiver, p)) * distance * distance *
             distance / z;
    };
    std::vector<double> expected(size_t{kTurns} * kSlices, 0.0);
    double angle = 0.0, total = 0.0;
    for (int i = 0; i < kTurns * kFine; ++i) {
      const double step = 2.0 * widest / (kTurns * kFine), turn = -widest + (i + 0.5) * step;
      std::array<double, 2> c{};
      if (!diskCosines(away, z, turn, c)) continue;
      angle += (c[0] - c[1]) * step;
      for (int k = 0; k < kSlices * 4; ++k) {
        const double cosine = glm::mix(c[0], c[1], (k + 0.5) / (kSlices * 4));
        const double along = z * std::sqrt(1.0 - cosine * cosine) / cosine;
        const glm::dvec2 side(std::cos(turn), std::sin(turn));
        const glm::dvec2 at =
            glm::dvec2(receiver) + along * glm::dvec2(side.x * towards.x - side.y * towards.y,
                                                      side.x * towards.y + side.y * towards.x);
        const double p = densityAt(local.d->shapePoint(
                             local.shape, {0, 0, glm::vec2(at) * 0.5f + glm::vec2(0.5f)})) *
                         (c[0] - c[1]) * step / (kSlices * 4);
        expected[size_t(i / kFine) * kSlices + size_t(k / 4)] += p;
        total += p;
      }
    }
    EXPECT_NEAR(total, 1.0, 1e-3) << what << ": the density must integrate to 1";
    for (double& p : expected) p /= total;
    std::vector<uint64_t> counts(expected.size(), 0);
    for (int i = 0; i < kDraws; ++i) {
      const rl::SurfaceId id = local.d->shapeDraw(local.shape, receiver, inputs.square());
      const rl::ShapePoint p = local.d->shapePoint(local.shape, id);
      ASSERT_NEAR(densityAt(p) * angle, 1.0, 0.02) << what;
      const glm::dvec3 d = glm::dvec3(p.posL) - glm::dvec3(receiver);
      const double turn =
          std::atan2(towards.x * d.y - towards.y * d.x, towards.x * d.x + towards.y * d.y);
      std::array<double, 2> c{};
      diskCosines(away, z, turn, c);
      const auto cell = [](double v, int n) { return std::clamp(int(v * n), 0, n - 1); };
      const double slice = (c[0] - z / glm::length(d)) / (c[0] - c[1]);
      ++counts[size_t(cell((turn + widest) / (2.0 * widest), kTurns)) * kSlices +
               size_t(cell(slice, kSlices))];
    }
    expectFits(counts, expected, kDraws, what);
  }
}

// Receivers in the plane, at the rim, as far as floats reach: points of the disk, and a density.
TEST(ShapeLights, DisksHaveADensityFromEverywhere) {
  LocalShape local(shapeNamed("disk"));
  Inputs inputs(18);
  for (int i = 0; i < 200'000; ++i) {
    const auto any = [&] {
      return inputs.below(8) == 0
                 ? 0.0f
                 : inputs.scale(1e-18f, 1e18f) * (inputs.below(2) == 0 ? 1.0f : -1.0f);
    };
    glm::vec3 receiver(any(), any(), any());
    if (i % 4 == 0) receiver = glm::vec3(glm::vec2(inputs.direction()), any());
    if (i % 4 == 1) receiver = glm::vec3(1.0f + inputs.scale(1e-7f, 1.0f), 0.0f, any());
    const rl::SurfaceId id = local.d->shapeDraw(local.shape, receiver, inputs.square());
    ASSERT_TRUE(id.bary.x >= 0.0f && id.bary.x <= 1.0f && id.bary.y >= 0.0f && id.bary.y <= 1.0f);
    const rl::ShapePoint p = local.d->shapePoint(local.shape, id);
    ASSERT_LE(glm::length(p.posL), 1.000001f);
    const float density = local.d->shapeDensity(local.shape, receiver, p);
    ASSERT_TRUE(density > 0.0f && density < 1e12f)
        << fmt::format("{} from ({}, {}, {})", density, receiver.x, receiver.y, receiver.z);
  }
}

// Close to a lamp the drawn points lie within a thousandth of its radius.
TEST(ShapeLights, ReceiversNearASphereAreLitRight) {
  for (const double height : {1e-2, 1e-3, 1e-4, 2e-5, 1e-6}) {
    const auto scene = placedShape(shapeNamed("sphere"), glm::dmat4(1.0), 1.0f);
    Dialect<> d(scene);
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, 0.8, -0.4));
    const glm::vec3 posW(-(1.0 + height) * up - scene->origin());
    const double distance = glm::length(glm::dvec3(posW) + scene->origin());
    const auto [mean, error] = irradianceOf(d, posW, glm::vec3(up));
    EXPECT_NEAR(mean, kPi / (distance * distance), 5.0 * error + 0.003 * kPi) << height;
  }
}

TEST(ShapeLights, DensityIsThatOfTheHit) {
  for (const ShapeCase& of : drawnShapes()) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 4.0, -2.0));
    m = glm::scale(glm::rotate(m, 1.1, glm::dvec3(0.2, 0.5, 0.8)), glm::dvec3(0.5, 0.8, -1.2));
    const auto scene = placedShape(of, m, 3.0f);
    Dialect<> d(scene);
    Inputs inputs(6);
    int compared = 0, off = 0;
    for (uint32_t i = 0; i < 5000; ++i) {
      rl::LightReceiver receiver;
      receiver.posW = 6.0f * inputs.direction();
      receiver.normalW = -glm::normalize(receiver.posW);
      receiver.isTwoSided = 1;
      rl::Rng rng{};
      rng.key = glm::uvec2(i * 2654435761u, 5u);
      const rl::LightSample s = d->lightSample(rng, receiver);
      const rl::LightConnection c = d->lightConnect(s, receiver.posW);
      rl::Hit hit{};
      d->traceRay(rayOf(receiver.posW, c.dirW), rl::RL_RAY_PATH, 0, hit);
      if (hit.instance == rl::RL_INVALID || std::abs(hit.t - c.distance) > 1e-3f) continue;
      const rl::Surface surface = d->surfaceLoad(hit, c.dirW);
      const float cosine = std::abs(glm::dot(surface.nGeoW, c.dirW));
      if (cosine < 0.15f || surface.id.primitive != s.id.primitive) continue;
      const float pdf =
          d->lightPdfOfHit(surface.light, surface.id, receiver, surface.nGeoW, c.dirW, hit.t);
      // Near a pole of a parametric surface the density is steep: the hit's rounding shows.
      ASSERT_NEAR(pdf / c.pdfSolidAngle, 1.0f, 0.1f) << of.name;
      if (std::abs(pdf / c.pdfSolidAngle - 1.0f) > 5e-3f) ++off;
      ++compared;
    }
    EXPECT_GT(compared, 1000) << of.name;
    EXPECT_LT(off, compared / 200) << of.name;
  }
}

}  // namespace
}  // namespace restlab::unit
