#include "core/scene/splines/tessellate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace restlab {

namespace {

double length3(const glm::dvec4& v) { return glm::length(glm::dvec3(v)); }

// Bounds of the second derivatives of a piece.
struct Bends {
  double uu = 0.0, uv = 0.0, vv = 0.0;
};

// Derivatives of a rational piece from those of its numerator and weight, which the differences of
// the net bound. Points are taken relative to the middle of the net, which makes the bounds tight.
Bends bendsOfNet(const BezierPiece& piece) {
  const size_t p = size_t(piece.degreeU), q = size_t(piece.degreeV), width = p + 1;
  glm::dvec3 low(1e300), high(-1e300);
  double least = 1e300;
  for (const glm::dvec4& h : piece.net) {
    low = glm::min(low, glm::dvec3(h) / h.w);
    high = glm::max(high, glm::dvec3(h) / h.w);
    least = std::min(least, h.w);
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  const double radius = 0.5 * glm::length(high - low);
  const auto at = [&](size_t i, size_t j) {
    const glm::dvec4 h = piece.net[j * width + i];
    return glm::dvec4(glm::dvec3(h) - middle * h.w, h.w);
  };
  const double du = double(p), dv = double(q);
  // Largest derivative of the numerator, and of the weight.
  double u = 0, v = 0, uu = 0, uv = 0, vv = 0, wu = 0, wv = 0, wuu = 0, wuv = 0, wvv = 0;
  const auto raise = [](double& a, double& w, const glm::dvec4& d, double factor) {
    a = std::max(a, factor * length3(d));
    w = std::max(w, factor * std::abs(d.w));
  };
  for (size_t j = 0; j <= q; ++j) {
    for (size_t i = 0; i <= p; ++i) {
      if (i < p) raise(u, wu, at(i + 1, j) - at(i, j), du);
      if (j < q) raise(v, wv, at(i, j + 1) - at(i, j), dv);
      if (i + 1 < p) raise(uu, wuu, at(i + 2, j) - 2.0 * at(i + 1, j) + at(i, j), du * (du - 1.0));
      if (j + 1 < q) raise(vv, wvv, at(i, j + 2) - 2.0 * at(i, j + 1) + at(i, j), dv * (dv - 1.0));
      if (i < p && j < q)
        raise(uv, wuv, at(i + 1, j + 1) - at(i, j + 1) - at(i + 1, j) + at(i, j), du * dv);
    }
  }
  const double ru = (u + wu * radius) / least, rv = (v + wv * radius) / least;
  return {(uu + 2.0 * wu * ru + wuu * radius) / least,
          (uv + wu * rv + wv * ru + wuv * radius) / least,
          (vv + 2.0 * wv * rv + wvv * radius) / least};
}

// The bounds of parts are tighter than those of the whole.
Bends bendsOf(const BezierPiece& piece) {
  constexpr int kParts = 4;
  constexpr double kScale = kParts * kParts;  // of second derivatives, from the part's parameters
  Bends most;
  for (int j = 0; j < kParts; ++j) {
    for (int i = 0; i < kParts; ++i) {
      const Bends b = bendsOfNet(part(piece, double(i) / kParts, double(i + 1) / kParts,
                                      double(j) / kParts, double(j + 1) / kParts));
      most.uu = std::max(most.uu, kScale * b.uu);
      most.uv = std::max(most.uv, kScale * b.uv);
      most.vv = std::max(most.vv, kScale * b.vv);
    }
  }
  return most;
}

double chordBound(const Bends& b, double nu, double nv) {
  return 0.125 * (b.uu / (nu * nu) + 2.0 * b.uv / (nu * nv) + b.vv / (nv * nv));
}

// Cells with one direction so much finer as its bend asks for, for `scale` cells along the other.
PieceCells cellsAt(const Bends& b, double scale) {
  const double u = std::sqrt(b.uu + b.uv), v = std::sqrt(b.vv + b.uv), most = std::max(u, v);
  if (!(most > 0.0)) return {};
  const auto count = [&](double of) { return size_t(std::max(1.0, std::ceil(scale * of / most))); };
  return {count(u), count(v)};
}

std::optional<PieceCells> cellsOf(const Bends& bends, double chordError) {
  double low = 0.0, high = 1.0;
  const auto fits = [&](double scale) {
    const PieceCells cells = cellsAt(bends, scale);
    return chordBound(bends, double(cells.u), double(cells.v)) <= chordError;
  };
  while (!fits(high)) {
    low = high;
    high *= 2.0;
    if (high > double(kMostTrianglesOfPiece)) return std::nullopt;
  }
  while (high - low > 0.5) (fits(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  const PieceCells cells = cellsAt(bends, high);
  if (2 * cells.u * cells.v > kMostTrianglesOfPiece) return std::nullopt;
  return cells;
}

}  // namespace

std::optional<PieceCells> cellsFor(const BezierPiece& piece, double chordError) {
  return cellsOf(bendsOf(piece), chordError);
}

double leastChordError(const BezierPiece& piece) {
  const Bends bends = bendsOf(piece);
  double low = 0.0, high = chordBound(bends, 1.0, 1.0);
  if (cellsOf(bends, 1e-12 * high)) return 1e-12 * high;
  while (high > 1.02 * low && high > 0.0) {
    const double middle = low > 0.0 ? std::sqrt(low * high) : 1e-3 * high;
    (cellsOf(bends, middle) ? high : low) = middle;
  }
  return high;
}

size_t GridCells::triangles() const {
  size_t columns = 0, rows = 0;
  for (const size_t n : u) columns += n;
  for (const size_t n : v) rows += n;
  return 2 * columns * rows;
}

GridCells gridCells(const BezierGrid& grid,
                    const std::function<PieceCells(const BezierPiece&)>& cellsOf) {
  GridCells cells{std::vector<size_t>(grid.columns(), 1), std::vector<size_t>(grid.rows(), 1)};
  for (size_t j = 0; j < grid.rows(); ++j) {
    for (size_t i = 0; i < grid.columns(); ++i) {
      const PieceCells own = cellsOf(grid.pieces[j * grid.columns() + i]);
      cells.u[i] = std::max(cells.u[i], own.u);
      cells.v[j] = std::max(cells.v[j], own.v);
    }
  }
  return cells;
}

MeshGeometry tessellate(const BezierGrid& grid, const GridCells& cells) {
  // Lines of the grid: the piece that begins or lies there, and the place in it. The last line of a
  // piece is the first of the next.
  struct Line {
    size_t piece;
    UnitParameter at;
    double texture;
  };
  const auto linesOf = [](const std::vector<double>& knots, const std::vector<size_t>& counts) {
    std::vector<Line> lines;
    const double first = knots.front(), width = knots.back() - knots.front();
    for (size_t k = 0; k < counts.size(); ++k) {
      for (size_t i = 0; i < counts[k]; ++i) {
        const UnitParameter x = fraction(i, counts[k]);
        lines.push_back({k, x, (knots[k] * x.rest + knots[k + 1] * x.at - first) / width});
      }
    }
    lines.push_back({counts.size() - 1, {1.0, 0.0}, 1.0});
    return lines;
  };
  const std::vector<Line> us = linesOf(grid.linesU, cells.u), vs = linesOf(grid.linesV, cells.v);
  MeshGeometry mesh;
  mesh.positions.reserve(us.size() * vs.size());
  for (const Line& v : vs) {
    for (const Line& u : us) {
      const SplinePoint p = evaluate(grid.pieces[v.piece * grid.columns() + u.piece], u.at, v.at);
      mesh.positions.push_back(p.position);
      mesh.normals.push_back(p.normal);
      mesh.uvs[0].emplace_back(u.texture, v.texture);
    }
  }
  const auto add = [&](size_t a, size_t b, size_t c) {
    const glm::vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    if (p != q && q != r && r != p) mesh.triangles.emplace_back(a, b, c);
  };
  const size_t width = us.size();
  for (size_t y = 0; y + 1 < vs.size(); ++y) {
    for (size_t x = 0; x + 1 < width; ++x) {
      const size_t a = y * width + x;
      add(a, a + 1, a + width + 1);
      add(a, a + width + 1, a + width);
    }
  }
  return mesh;
}

BezierPiece transformed(const BezierPiece& piece, const glm::dmat4& m) {
  BezierPiece result = piece;
  for (glm::dvec4& h : result.net) h = m * h;
  return result;
}

}  // namespace restlab
