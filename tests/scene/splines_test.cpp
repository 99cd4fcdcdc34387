// Surfaces of control points: what is wrong with them is said in one line, pieces and meshes are
// the surface to the stated errors, and neighbours share the vertices of their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/error.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/splines/tessellate.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/mesh_checks.h"

namespace restlab {
namespace {

class Numbers {
 public:
  explicit Numbers(uint64_t seed) : engine_(seed) {}
  double uniform() { return double(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

NurbsSurface roughSheet(Numbers& numbers, int degreeU, int degreeV, int countU, int countV) {
  NurbsSurface s{{degreeU, countU, clampedKnots(degreeU, countU)},
                 {degreeV, countV, clampedKnots(degreeV, countV)},
                 {},
                 {}};
  for (int j = 0; j < countV; ++j) {
    for (int i = 0; i < countU; ++i) {
      s.points.emplace_back(i + 0.3 * numbers.uniform(), j + 0.3 * numbers.uniform(),
                            numbers.uniform());
      s.weights.push_back(0.5 + numbers.uniform());
    }
  }
  return s;
}

std::string faultText(const NurbsSurface& s) {
  const auto fault = faultOf(s);
  return fault ? fault->key + ": " + fault->message : "none";
}

TEST(Splines, WhatIsWrongIsSaid) {
  const NurbsSurface right = sphereAsNurbs();
  EXPECT_EQ(faultText(right), "none");
  const auto with = [&](auto&& change) {
    NurbsSurface s = right;
    change(s);
    return faultText(s);
  };
  EXPECT_EQ(with([](NurbsSurface& s) { s.u.degree = 8; }),
            "degree: the degree along u is 8, but must be in 1..7");
  EXPECT_EQ(with([](NurbsSurface& s) { s.v.count = 2; }),
            "size: 2 points along v are too few: degree 2 needs 3 or more");
  EXPECT_EQ(with([](NurbsSurface& s) { s.v.count = 5000; }),
            "size: 5000 points along v are too many: at most 1024");
  EXPECT_EQ(with([](NurbsSurface& s) { s.u.knots.pop_back(); }),
            "knots_u: 'knots_u' has 11 numbers, but must have 12: 9 points and degree 2 + 1");
  EXPECT_EQ(with([](NurbsSurface& s) { s.v.knots[4] = 0.25; }),
            "knots_v: 'knots_v' must not decrease, but 0.25 follows 0.5 (number 5)");
  EXPECT_EQ(with([](NurbsSurface& s) { s.v.knots[2] = std::nan(""); }),
            "knots_v: number 3 of 'knots_v' is not finite");
  EXPECT_EQ(with([](NurbsSurface& s) { s.u.knots[5] = 0.25; }),
            "knots_u: 0.25 stands inside 'knots_u' 3 times, which tears the surface: at most 2");
  EXPECT_EQ(with([](NurbsSurface& s) { s.v.knots.assign(8, 0.0); }),
            "knots_v: 0 stands in 'knots_v' more than 3 times: degree 2 allows no more");
  EXPECT_EQ(with([](NurbsSurface& s) { s.points.pop_back(); }),
            "points: 'points' has 44 points, but must have 45: 9 along u times 5 along v");
  EXPECT_EQ(with([](NurbsSurface& s) { s.points[3].y = std::nan(""); }),
            "points: point 4 of 'points' is not finite");
  EXPECT_EQ(with([](NurbsSurface& s) { s.weights.pop_back(); }),
            "weights: 'weights' has 44 numbers, but must have 45: one a point");
  EXPECT_EQ(with([](NurbsSurface& s) { s.weights[7] = 0.0; }),
            "weights: number 8 of 'weights' is 0, but must be above 0");
}

std::string errorOfShape(const std::string& keys) {
  test::TempDirectory directory;
  directory.write("x.scene.toml", "[[shape]]\nkind = \"nurbs\"\n" + keys);
  try {
    loadScene((directory.path() / "x.scene.toml").string());
  } catch (const Error& error) {
    std::string line = error.what();
    const std::string folder = directory.path().string() + "/";
    for (size_t at; (at = line.find(folder)) != std::string::npos;) line.erase(at, folder.size());
    return line;
  }
  return "no error";
}

TEST(Splines, ASceneFileNamesThePlace) {
  const std::string flat =
      "degree = [1, 1]\nsize = [2, 2]\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1]]\n";
  EXPECT_EQ(errorOfShape(flat), "no error");
  EXPECT_EQ(errorOfShape(flat + "way = \"exact\"\n"), "no error");
  EXPECT_EQ(errorOfShape("size = [4, 4]\n"),
            "x.scene.toml:1:1: [[shape]] of kind 'nurbs' has no 'points': size = [4, 4] and points "
            "= [[x, y, z], ...], u fastest");
  EXPECT_EQ(errorOfShape(flat + "knots_u = [0, 1, 0.5, 1]\n"),
            "x.scene.toml:6:11: 'knots_u' must not decrease, but 0.5 follows 1 (number 3)");
  EXPECT_EQ(errorOfShape(flat + "weights = [1, 1, -2, 1]\n"),
            "x.scene.toml:6:11: number 3 of 'weights' is -2, but must be above 0");
  EXPECT_EQ(errorOfShape(flat + "chord_error = 1e-9\n"),
            "x.scene.toml:6:15: 'chord_error' is 1e-09, which takes more than 65536 triangles a "
            "piece: 7.77e-06 would do");
  EXPECT_EQ(errorOfShape("size = [2, 2]\ndegree = [1, 1]\npoints = [[0, 0], [1, 0]]\n"),
            "x.scene.toml:5:11: 'points' must hold arrays of 3 numbers");
}

TEST(Splines, PiecesAreTheSurface) {
  Numbers numbers(1);
  for (const auto& [p, q] : {std::pair(1, 2), {3, 3}, {5, 4}, {7, 7}}) {
    const NurbsSurface s = roughSheet(numbers, p, q, p + 4, q + 3);
    const BezierGrid grid = bezierGrid(s);
    ASSERT_EQ(grid.pieces.size(), 12u);
    for (int k = 0; k < 300; ++k) {
      const size_t x = size_t(numbers.uniform() * 4.0), y = size_t(numbers.uniform() * 3.0);
      const double a = numbers.uniform(), b = numbers.uniform();
      const double du = grid.linesU[x + 1] - grid.linesU[x],
                   dv = grid.linesV[y + 1] - grid.linesV[y];
      const SplinePoint is = evaluate(s, grid.linesU[x] + a * du, grid.linesV[y] + b * dv);
      const SplinePoint piece = evaluate(grid.pieces[y * 4 + x], {a, 1.0 - a}, {b, 1.0 - b});
      EXPECT_LT(glm::distance(is.position, piece.position), 1e-11);
      EXPECT_LT(glm::distance(is.du * du, piece.du), 1e-10);
      EXPECT_LT(glm::distance(is.normal, piece.normal), 1e-10);
      const BezierPiece inner = part(grid.pieces[y * 4 + x], 0.25, 0.75, 0.5, 0.625);
      const SplinePoint again = evaluate(inner, {0.4, 0.6}, {0.2, 0.8});
      EXPECT_LT(
          glm::distance(again.position,
                        evaluate(grid.pieces[y * 4 + x], {0.45, 0.55}, {0.525, 0.475}).position),
          1e-11);
    }
  }
}

TEST(Splines, DerivativesAreDifferences) {
  Numbers numbers(2);
  const NurbsSurface s = roughSheet(numbers, 3, 4, 7, 6);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 200; ++k) {
    const double u = 0.01 + 0.98 * numbers.uniform(), v = 0.01 + 0.98 * numbers.uniform();
    const SplinePoint at = evaluate(s, u, v);
    const glm::dvec3 du =
        (evaluate(s, u + kStep, v).position - evaluate(s, u - kStep, v).position) / (2.0 * kStep);
    const glm::dvec3 dv =
        (evaluate(s, u, v + kStep).position - evaluate(s, u, v - kStep).position) / (2.0 * kStep);
    EXPECT_LT(glm::distance(at.du, du), 1e-6 * (1.0 + glm::length(du)));
    EXPECT_LT(glm::distance(at.dv, dv), 1e-6 * (1.0 + glm::length(dv)));
    EXPECT_LT(glm::distance(at.normal, glm::normalize(glm::cross(du, dv))), 1e-6);
  }
}

TEST(Splines, TheSphereIsASphere) {
  const NurbsSurface s = sphereAsNurbs();
  for (int j = 0; j <= 40; ++j) {
    for (int i = 0; i <= 40; ++i) {
      const SplinePoint p = evaluate(s, i / 40.0, j / 40.0);
      EXPECT_NEAR(glm::length(p.position), 1.0, 1e-14);
      EXPECT_LT(glm::distance(p.normal, p.position), 1e-6) << "also at the poles";
    }
  }
}

// Distance of a point from a piece's cell, by dense sampling around its parameters.
TEST(Splines, TheChordErrorHolds) {
  Numbers numbers(3);
  std::vector<BezierGrid> grids{bezierGrid(sphereAsNurbs())};
  for (int k = 1; k < 6; ++k) grids.push_back(bezierGrid(roughSheet(numbers, k, 3, k + 2, 5)));
  for (const BezierGrid& grid : grids) {
    for (const double error : {0.03, 0.003, 0.0003}) {
      for (const BezierPiece& piece : grid.pieces) {
        const auto fit = cellsFor(piece, error);
        if (!fit && error < 0.001) continue;  // more than 65536 triangles
        ASSERT_TRUE(fit);
        const PieceCells cells = *fit;
        double worst = 0.0;
        for (int k = 0; k < 200; ++k) {
          const size_t x = size_t(numbers.uniform() * double(cells.u)),
                       y = size_t(numbers.uniform() * double(cells.v));
          double a = numbers.uniform(), b = numbers.uniform();
          const auto at = [&](double i, double j) {
            const double s = (double(x) + i) / double(cells.u),
                         t = (double(y) + j) / double(cells.v);
            return evaluate(piece, {s, 1.0 - s}, {t, 1.0 - t}).position;
          };
          // The triangle of the lower or of the upper corner, as tessellate() splits a cell.
          const glm::dvec3 p00 = at(0, 0), p11 = at(1, 1);
          const glm::dvec3 flat = a >= b ? p00 + (a - b) * (at(1, 0) - p00) + b * (p11 - p00)
                                         : p00 + (b - a) * (at(0, 1) - p00) + a * (p11 - p00);
          worst = std::max(worst, glm::distance(flat, at(a, b)));
        }
        EXPECT_LE(worst, error);
        // The bound is no waste: not 100 times finer than needed.
        if (cells.u * cells.v > 100) {
          EXPECT_GT(worst, error / 100.0);
        }
      }
    }
  }
}

std::vector<test::WorldTriangle> trianglesOf(const MeshGeometry& mesh) {
  std::vector<test::WorldTriangle> triangles;
  for (const glm::uvec3& t : mesh.triangles)
    triangles.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], 0});
  return triangles;
}

TEST(Splines, MeshesAreWatertight) {
  const BezierGrid sphere = bezierGrid(sphereAsNurbs());
  const GridCells cells =
      gridCells(sphere, [](const BezierPiece& piece) { return cellsFor(piece, 1e-3).value(); });
  const MeshGeometry mesh = tessellate(sphere, cells);
  EXPECT_EQ(test::openEdge(trianglesOf(mesh)), "");
  EXPECT_NEAR(test::signedVolume(trianglesOf(mesh)), 4.18879, 0.02);
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    ASSERT_LT(glm::distance(mesh.normals[i], mesh.positions[i]), 2e-6f);
}

// Rim, body and bottom of the teapot share their edges; handle, spout and lid end free.
TEST(Splines, TheTeapotsBodyIsOneSurface) {
  const std::vector<BezierGrid> pieces = builtin::teapotPieces();
  ASSERT_EQ(pieces.size(), 32u);
  MeshGeometry body;
  for (const size_t k : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 20, 21, 22, 23}) {
    const MeshGeometry part = tessellate(pieces[k], {{7}, {9}});
    const auto first = uint32_t(body.positions.size());
    body.positions.insert(body.positions.end(), part.positions.begin(), part.positions.end());
    for (const glm::uvec3& t : part.triangles) body.triangles.push_back(t + first);
  }
  // The mouth is the only open edge: a lid of one fan closes it.
  const uint32_t middle = uint32_t(body.positions.size());
  body.positions.emplace_back(0.0f, 0.0f, 2.4f);
  for (size_t k = 0; k < 4; ++k) {
    for (uint32_t i = 0; i < 7; ++i) {
      const uint32_t a = uint32_t(k) * 80 + i;
      body.triangles.emplace_back(middle, a + 1, a);
    }
  }
  EXPECT_EQ(test::openEdge(trianglesOf(body)), "");
  EXPECT_GT(test::signedVolume(trianglesOf(body)), 15.0);
}

}  // namespace
}  // namespace restlab
