// Meshes of parametric surfaces, to a stated chord error.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/splines/bezier.h"

namespace restlab {

// Numbers of cells of a grid over one piece.
struct PieceCells {
  size_t u = 1, v = 1;
};
constexpr size_t kMostTrianglesOfPiece = size_t{1} << 16;

// The fewest cells, about square on the surface, whose triangles keep within `chordError` of the
// piece. The bound is that of second derivatives (Filip, Magedson and Markot 1986).
// Returns nullopt if that takes more than kMostTrianglesOfPiece triangles.
std::optional<PieceCells> cellsFor(const BezierPiece& piece, double chordError);

// The least chord error that cellsFor() answers, a few percent above the least possible.
double leastChordError(const BezierPiece& piece);

// Cells of each column and of each row of a grid of pieces: neighbours share the vertices of their
// edge. `cellsOf` is asked for each piece.
struct GridCells {
  std::vector<size_t> u, v;
  size_t triangles() const;
};
GridCells gridCells(const BezierGrid& grid,
                    const std::function<PieceCells(const BezierPiece&)>& cellsOf);

// A mesh with exact normals; texture coordinates are those of the knots, from 0 to 1. Triangles are
// counter-clockwise seen from where the normals point. Those without an area are left out.
MeshGeometry tessellate(const BezierGrid& grid, const GridCells& cells);

// The piece under a transform.
BezierPiece transformed(const BezierPiece& piece, const glm::dmat4& m);

}  // namespace restlab
