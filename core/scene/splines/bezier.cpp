#include "core/scene/splines/bezier.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace restlab {

namespace {

using Points = std::vector<glm::dvec4>;

// One point of a curve, and the last two of de Casteljau's scheme, whose difference is the tangent.
struct CurvePoint {
  glm::dvec4 value, before, after;
};

CurvePoint castel(Points p, UnitParameter x) {
  for (size_t left = p.size() - 1; left > 1; --left) {
    for (size_t i = 0; i < left; ++i) p[i] = p[i] * x.rest + p[i + 1] * x.at;
  }
  return {p[0] * x.rest + p[1] * x.at, p[0], p[1]};
}

Points rowOf(const BezierPiece& piece, size_t j) {
  const auto first = piece.net.begin() + std::ptrdiff_t(j) * (piece.degreeU + 1);
  return {first, first + piece.degreeU + 1};
}

// Inserts every inner knot of a curve until it stands there `degree` times, and cuts off what lies
// before and behind the domain (Boehm 1980).
Points bezierPoints(Points points, const SplineAxis& axis) {
  std::vector<double> knots = axis.knots;
  const size_t p = size_t(axis.degree);
  const auto insert = [&](double x) {
    // The last knot that is not above x.
    const size_t k = size_t(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin()) - 1;
    Points after(points.size() + 1);
    for (size_t i = 0; i < after.size(); ++i) {
      if (i + p <= k) {
        after[i] = points[i];
      } else if (i > k) {
        after[i] = points[i - 1];
      } else {
        const double a = (x - knots[i]) / (knots[i + p] - knots[i]);
        after[i] = points[i] * a + points[i - 1] * (1.0 - a);
      }
    }
    points = std::move(after);
    knots.insert(knots.begin() + std::ptrdiff_t(k) + 1, x);
  };
  const auto [low, high] = domainOf(axis);
  std::vector<double> lines(axis.knots);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  for (const double x : lines) {
    if (x < low || x > high) continue;
    for (auto n = size_t(std::count(knots.begin(), knots.end(), x)); n < p; ++n) insert(x);
  }
  // The first point of the domain is the one with the last p knots of `low` before it.
  const size_t first =
      size_t(std::upper_bound(knots.begin(), knots.end(), low) - knots.begin()) - 1 - p;
  const size_t last =
      size_t(std::lower_bound(knots.begin(), knots.end(), high) - knots.begin()) - 1;
  return {points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(last) + 1};
}

std::vector<double> linesOf(const SplineAxis& axis) {
  const auto [low, high] = domainOf(axis);
  std::vector<double> lines;
  for (const double x : axis.knots) {
    if (x >= low && x <= high && (lines.empty() || x > lines.back())) lines.push_back(x);
  }
  return lines;
}

SplinePoint evaluateOnce(const BezierPiece& piece, UnitParameter s, UnitParameter t) {
  Points values, slopes;
  for (int j = 0; j <= piece.degreeV; ++j) {
    const CurvePoint row = castel(rowOf(piece, size_t(j)), s);
    values.push_back(row.value);
    slopes.push_back((row.after - row.before) * double(piece.degreeU));
  }
  const CurvePoint column = castel(values, t);
  const glm::dvec4 h = column.value, hs = castel(slopes, t).value,
                   ht = (column.after - column.before) * double(piece.degreeV);
  SplinePoint point;
  point.position = glm::dvec3(h) / h.w;
  point.du = (glm::dvec3(hs) - point.position * hs.w) / h.w;
  point.dv = (glm::dvec3(ht) - point.position * ht.w) / h.w;
  return point;
}

// The part of a curve from x0 to x1, by splitting it twice.
Points partOf(Points p, double x0, double x1) {
  const size_t n = p.size() - 1;
  // Keep the left part up to x1.
  Points left{p[0]};
  Points rest = p;
  for (size_t k = n; k > 0; --k) {
    for (size_t i = 0; i < k; ++i) rest[i] = rest[i] * (1.0 - x1) + rest[i + 1] * x1;
    left.push_back(rest[0]);
  }
  if (x1 == 1.0) left = p;
  if (x0 == 0.0) return left;
  // Keep the right part of that.
  const double x = x0 / x1;
  Points right{left[n]};
  for (size_t k = n; k > 0; --k) {
    for (size_t i = 0; i < k; ++i) left[i] = left[i] * (1.0 - x) + left[i + 1] * x;
    right.push_back(left[k - 1]);
  }
  std::reverse(right.begin(), right.end());
  return right;
}

}  // namespace

BezierGrid bezierGrid(const NurbsSurface& s) {
  BezierGrid grid;
  grid.linesU = linesOf(s.u);
  grid.linesV = linesOf(s.v);
  // First along u, row by row, then along v.
  std::vector<Points> rows;
  for (int j = 0; j < s.v.count; ++j) {
    Points row;
    for (int i = 0; i < s.u.count; ++i) {
      const size_t at = size_t(j) * size_t(s.u.count) + size_t(i);
      row.emplace_back(s.points[at] * s.weights[at], s.weights[at]);
    }
    rows.push_back(bezierPoints(row, s.u));
  }
  std::vector<Points> columns;
  for (size_t i = 0; i < rows[0].size(); ++i) {
    Points column;
    for (const Points& row : rows) column.push_back(row[i]);
    columns.push_back(bezierPoints(column, s.v));
  }
  const size_t p = size_t(s.u.degree), q = size_t(s.v.degree);
  for (size_t y = 0; y < grid.rows(); ++y) {
    for (size_t x = 0; x < grid.columns(); ++x) {
      BezierPiece piece{s.u.degree, s.v.degree, {}};
      for (size_t j = 0; j <= q; ++j) {
        for (size_t i = 0; i <= p; ++i) piece.net.push_back(columns[x * p + i][y * q + j]);
      }
      grid.pieces.push_back(std::move(piece));
    }
  }
  return grid;
}

SplinePoint evaluate(const BezierPiece& piece, UnitParameter s, UnitParameter t) {
  SplinePoint point = evaluateOnce(piece, s, t);
  glm::dvec3 n = glm::cross(point.du, point.dv);
  const double longest = std::max(glm::length(point.du), glm::length(point.dv));
  if (!(glm::length(n) > 1e-9 * longest * longest)) {
    const double step = 1e-7;
    const auto beside = [&](UnitParameter x) {
      return UnitParameter{x.at + step * (0.5 - x.at), x.rest + step * (0.5 - x.rest)};
    };
    const SplinePoint inner = evaluateOnce(piece, beside(s), beside(t));
    n = glm::cross(inner.du, inner.dv);
  }
  if (glm::length(n) > 0.0) point.normal = glm::normalize(n);
  return point;
}

BezierPiece part(const BezierPiece& piece, double s0, double s1, double t0, double t1) {
  BezierPiece result{piece.degreeU, piece.degreeV, {}};
  std::vector<Points> rows;
  for (int j = 0; j <= piece.degreeV; ++j) rows.push_back(partOf(rowOf(piece, size_t(j)), s0, s1));
  result.net.resize(piece.net.size());
  const size_t width = size_t(piece.degreeU) + 1;
  for (size_t i = 0; i < width; ++i) {
    Points column;
    for (const Points& row : rows) column.push_back(row[i]);
    column = partOf(column, t0, t1);
    for (size_t j = 0; j < column.size(); ++j) result.net[j * width + i] = column[j];
  }
  return result;
}

}  // namespace restlab
