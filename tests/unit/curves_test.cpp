// Strands with radii: they are the union of their round cones, watertight and without surfaces
// within, close to their splines, and of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/curves/curve_words.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

// A strand that winds, joined at angles of 5 to 60 degrees.
Strands windingStrand(StrandBasis basis, double radius) {
  Strands strands{basis, {}, {13}};
  Inputs inputs(3);
  for (int i = 0; i < 13; ++i)
    strands.points.emplace_back(std::cos(i * 0.9), std::sin(i * 0.9), 0.15 * i - 0.9,
                                radius * (0.6 + 0.8 * double(inputs.uniform())));
  return strands;
}

struct LocalCurves {
  explicit LocalCurves(const Strands& strands, double error = kStrandError)
      : geometry{findShape("curves"), {}, curveWords(cutStrands(strands, error))},
        words(shapeWords(geometry)) {
    for (size_t i = 0; i < curvePieces(geometry.words); ++i)
      pieces.push_back(curvePiece(geometry.words, i));
    shape.kind = geometry.info->kind;
    shape.firstWord = 0;
    d.scene.shapeWords.data = words.data();
  }
  // Signed distance to all pieces, below 0 inside.
  double distance(const glm::dvec3& p) const {
    double least = 1e300;
    for (const StrandPiece& piece : pieces) least = std::min(least, distanceTo(piece, p));
    return least;
  }
  rl::ShapePoint pointOf(const rl::Hit& hit) {
    return d->shapePoint(shape, {0, hit.primitive, hit.bary});
  }
  ShapeGeometry geometry;
  std::vector<glm::uvec4> words;
  std::vector<StrandPiece> pieces;
  rl::Shape shape{};
  Dialect<> d;
};

// A ray from a place near the axis of a piece, half of them near where two pieces join, a fifth
// nearly along the axis.
rl::Ray rayFromInside(const LocalCurves& of, Inputs& inputs, int i) {
  const StrandPiece& piece = of.pieces[inputs.below(uint32_t(of.pieces.size()))];
  const glm::vec4 at = glm::mix(piece.start, piece.end, i % 2 == 0 ? 0.0f : inputs.uniform());
  const glm::vec3 from = glm::vec3(at) + 0.99f * at.w * inputs.uniform() * inputs.direction();
  glm::vec3 dir = inputs.direction();
  const glm::vec3 axis(piece.end - piece.start);
  if (i % 5 == 0 && glm::length(axis) > 0.0f)
    dir = glm::normalize(glm::normalize(axis) + inputs.scale(1e-7f, 1.0f) * dir);
  return {from, 0.0f, dir, 3e38f};
}

// A million rays begin within a strand. Each leaves it at the surface of the union, and what it
// meets beyond it enters before it leaves.
TEST(CurvesShape, NoCrackAndNoSurfaceWithin) {
  for (const double radius : {0.2, 0.004}) {
    for (const StrandBasis basis : {StrandBasis::linear, StrandBasis::bspline}) {
      LocalCurves local(windingStrand(basis, radius));
      Inputs inputs(7);
      int missed = 0, within = 0, wrongSide = 0, odd = 0;
      constexpr int kRays = 250'000;
      for (int i = 0; i < kRays; ++i) {
        rl::Ray ray = rayFromInside(local, inputs, i);
        bool isGrazing = false;
        int crossings = 0;
        rl::Hit hit{};
        for (; crossings < 100 && local.d->shapeIntersect(local.shape, ray, hit); ++crossings) {
          const rl::ShapePoint p = local.pointOf(hit);
          const float cosine = glm::dot(p.normalL, ray.dir);
          isGrazing = isGrazing || std::abs(cosine) < 0.02f;
          if (isGrazing) break;
          // All of a strand is looked at for a part of the hits, since that takes long.
          if (i % 16 == 0 && local.distance(glm::dvec3(p.posL)) < -3e-6) ++within;
          if ((cosine > 0.0f) != (crossings % 2 == 0)) ++wrongSide;
          ray.tMin = hit.t;
        }
        if (isGrazing) continue;
        missed += crossings == 0;
        odd += crossings % 2 == 0;
      }
      EXPECT_EQ(missed, 0);
      EXPECT_EQ(within, 0);
      EXPECT_EQ(wrongSide, 0);
      EXPECT_EQ(odd, 0);
    }
  }
}

TEST(CurvesShape, PointsAndNormalsAreThoseOfTheUnion) {
  LocalCurves local(windingStrand(StrandBasis::catmullRom, 0.12));
  Inputs inputs(8);
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const StrandPiece& piece = local.pieces[inputs.below(uint32_t(local.pieces.size()))];
    const glm::vec3 dir = inputs.direction();
    const glm::vec3 target = glm::vec3(piece.start) + 0.3f * inputs.direction();
    rl::Hit hit{};
    if (!local.d->shapeIntersect(local.shape, {target - 3.0f * dir, 0.0f, dir, 3e38f}, hit))
      continue;
    const rl::ShapePoint p = local.pointOf(hit);
    const glm::dvec3 at(p.posL);
    ASSERT_NEAR(local.distance(at), 0.0, 3e-6);
    const StrandPiece& own = local.pieces.at(hit.primitive);
    constexpr double kStep = 1e-6;
    glm::dvec3 normal;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = kStep;
      normal[axis] = distanceTo(own, at + step) - distanceTo(own, at - step);
    }
    ASSERT_LT(glm::distance(normal / (2.0 * kStep), glm::dvec3(p.normalL)), 1e-5);
    ++compared;
  }
  EXPECT_GT(compared, 8000);
}

// Where a small sphere is nearly within a large one, the cone of both is nearly flat.
TEST(CurvesShape, RaysMeetFlatConesWhereTheyAre) {
  for (const double tip : {0.01, 0.1, 0.5}) {
    LocalCurves local({StrandBasis::linear, {{0, 0, 0, 1}, {1.00002 - tip, 0, 0, tip}}, {2}});
    Inputs inputs(12);
    double furthest = 0.0;
    int hits = 0;
    for (int i = 0; i < 100'000; ++i) {
      const glm::vec3 dir = inputs.direction();
      const glm::vec3 target = glm::vec3(1, 0, 0) + 2.0f * float(tip) * inputs.direction();
      const rl::Ray ray{target - 2.0f * dir, 0.0f, dir, 3e38f};
      rl::Hit hit{};
      if (!local.d->shapeIntersect(local.shape, ray, hit)) continue;
      ++hits;
      const glm::dvec3 at = glm::dvec3(ray.origin) + double(hit.t) * glm::dvec3(ray.dir);
      furthest = std::max(furthest, std::abs(local.distance(at)));
    }
    EXPECT_GT(hits, 30'000);
    EXPECT_LT(furthest, 5e-6) << tip;
  }
}

glm::dvec4 splineAt(StrandBasis basis, const std::vector<glm::dvec4>& p, size_t i, double t) {
  const double t2 = t * t, t3 = t2 * t;
  if (basis == StrandBasis::bspline)
    return ((1 - 3 * t + 3 * t2 - t3) * p[i] + (4 - 6 * t2 + 3 * t3) * p[i + 1] +
            (1 + 3 * t + 3 * t2 - 3 * t3) * p[i + 2] + t3 * p[i + 3]) /
           6.0;
  if (basis == StrandBasis::catmullRom)
    return 0.5 * ((-t + 2 * t2 - t3) * p[i] + (2 - 5 * t2 + 3 * t3) * p[i + 1] +
                  (t + 4 * t2 - 3 * t3) * p[i + 2] + (t3 - t2) * p[i + 3]);
  return (1 - 3 * t + 3 * t2 - t3) * p[i] + 3 * (t - 2 * t2 + t3) * p[i + 1] +
         3 * (t2 - t3) * p[i + 2] + t3 * p[i + 3];
}

// The tube about a spline of one radius is the pieces, but for the chord error.
TEST(CurvesShape, PiecesAreWithinTheirErrorOfTheSpline) {
  constexpr double kRadius = 0.1;
  for (const StrandBasis basis :
       {StrandBasis::bspline, StrandBasis::catmullRom, StrandBasis::bezier}) {
    Strands strands = windingStrand(basis, kRadius);
    for (glm::dvec4& p : strands.points) p.w = kRadius;
    size_t before = 0;
    for (const double error : {0.05, 0.005}) {
      LocalCurves local(strands, error);
      EXPECT_GT(local.pieces.size(), 2 * before);
      before = local.pieces.size();
      double worst = 0.0;
      const size_t step = basis == StrandBasis::bezier ? 3 : 1;
      for (size_t i = 0; i + 3 < strands.points.size(); i += step) {
        for (double t = 0.0; t <= 1.0; t += 1.0 / 64.0) {
          const glm::dvec3 at(splineAt(basis, strands.points, i, t));
          worst = std::max(worst, kRadius + local.distance(at));
        }
      }
      EXPECT_LE(worst, error * kRadius);
      EXPECT_GE(worst, 0.1 * error * kRadius) << "finer than asked for";
    }
  }
}

// Texture coordinates do not jump where pieces join.
TEST(CurvesShape, TextureCoordinatesGoOnAcrossJoints) {
  LocalCurves local(windingStrand(StrandBasis::bspline, 0.1));
  Inputs inputs(9);
  int joints = 0;
  for (size_t i = 0; i < local.pieces.size(); ++i) {
    for (size_t k = 0; k < local.pieces.size(); ++k) {
      if (i == k || local.pieces[i].end != local.pieces[k].start) continue;
      ++joints;
      for (int n = 0; n < 20; ++n) {
        const float turn = inputs.uniform(0.02f, 0.98f);
        const rl::ShapePoint a = local.d->shapePoint(local.shape, {0, uint32_t(i), {turn, 0.75f}});
        const rl::ShapePoint b = local.d->shapePoint(local.shape, {0, uint32_t(k), {turn, 0.25f}});
        EXPECT_EQ(a.uv.y, b.uv.y);
        EXPECT_NEAR(a.uv.x, b.uv.x, 1e-6f);
        EXPECT_GT(glm::dot(a.normalL, b.normalL), 0.98f);
      }
    }
  }
  EXPECT_EQ(joints + 1, int(local.pieces.size()));
}

std::shared_ptr<const CompiledScene> placedCurves(const LocalCurves& of, const glm::dmat4& m) {
  builtin::SceneBuilder builder("curves");
  const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.place("it", builder.addGeometry(makeShape(of.geometry, "it")), id, m);
  return CompiledScene::build(builder.finish());
}

// Paths within and without, a third of their rays grazing, of sizes from 2^-13 to 2^17.
TEST(CurvesShape, NonePassesItsSurfaceAtAnySize) {
  for (const double radius : {0.1, 0.002}) {
    LocalCurves local(windingStrand(StrandBasis::bspline, radius));
    Inputs inputs(10);
    uint64_t escaped = 0, entered = 0, rays = 0;
    for (int exponent = -13; exponent <= 17; exponent += 3) {
      const double size = std::exp2(exponent);
      glm::dmat4 m = glm::translate(glm::dmat4(1.0), 3.0 * size * glm::dvec3(0.48, -0.6, 0.64));
      m = glm::scale(glm::rotate(m, 0.7, glm::dvec3(0.3, 0.9, -0.2)),
                     size * glm::dvec3(1.5, 0.7, 1.1));
      const auto scene = placedCurves(local, m);
      Dialect<> d(scene);
      for (int path = 0; path < 6'000; ++path) {
        const bool isWithin = path % 2 == 0;
        const rl::Ray own = rayFromInside(local, inputs, path);
        glm::vec3 at(glm::dvec3(m * glm::dvec4(glm::dvec3(own.origin), 1.0)) - scene->origin());
        glm::vec3 dir = inputs.direction();
        if (!isWithin) at -= dir * float(8.0 * size);
        for (int bounce = 0; bounce < 8; ++bounce) {
          rl::Hit hit{};
          d->traceRay({at, 0.0f, dir, 3e38f}, rl::RL_RAY_PATH, 0, hit);
          ++rays;
          if (hit.instance == rl::RL_INVALID) {
            if (isWithin) ++escaped;
            break;
          }
          const rl::Surface s = d->surfaceLoad(hit, dir);
          if ((s.isFront != 0u) == isWithin && std::abs(glm::dot(dir, s.nGeoW)) > 1e-3f) {
            ++entered;
            break;
          }
          dir = inputs.directionAbove(s.nGeoW);
          if (inputs.below(3) == 0)
            dir = glm::normalize(dir - s.nGeoW * glm::dot(dir, s.nGeoW) *
                                           (1.0f - inputs.scale(1e-5f, 1.0f)));
          if (glm::dot(dir, s.nGeoW) <= 0.0f) break;
          at = d->surfaceOffset(s.posW, s.nGeoW, s.posError, dir);
        }
      }
    }
    EXPECT_GT(rays, 300'000u);
    EXPECT_EQ(escaped, 0u) << "of " << rays << ", radius " << radius;
    EXPECT_EQ(entered, 0u) << "of " << rays << ", radius " << radius;
  }
}

}  // namespace
}  // namespace restlab::unit
