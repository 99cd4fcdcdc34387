// Surface nets (Gibson, "Constrained Elastic Surface Nets", 1998), whose vertices are moved to the
// surface.
#include "core/scene/field/stand_in.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace restlab {

namespace {

constexpr int kCells = 40;  // along the longest edge of the box
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

struct Grid {
  glm::ivec3 cells;
  glm::dvec3 low, cell;
  std::vector<double> values;  // at corners

  size_t corner(const glm::ivec3& i) const {
    return (size_t(i.z) * size_t(cells.y + 1) + size_t(i.y)) * size_t(cells.x + 1) + size_t(i.x);
  }
  size_t number(const glm::ivec3& i) const {
    return (size_t(i.z) * size_t(cells.y) + size_t(i.y)) * size_t(cells.x) + size_t(i.x);
  }
  glm::dvec3 place(const glm::ivec3& i) const { return low + glm::dvec3(i) * cell; }
  double at(const glm::ivec3& i) const { return values[corner(i)]; }
};

Grid sampled(const FieldProgram& program) {
  const glm::dvec3 size(program.high - program.low);
  const double longest = std::max({size.x, size.y, size.z});
  Grid grid;
  for (int c = 0; c < 3; ++c)
    grid.cells[c] = std::clamp(int(std::ceil(kCells * size[c] / longest)), 4, kCells);
  grid.low = glm::dvec3(program.low);
  grid.cell = size / glm::dvec3(grid.cells);
  for (int z = 0; z <= grid.cells.z; ++z)
    for (int y = 0; y <= grid.cells.y; ++y)
      for (int x = 0; x <= grid.cells.x; ++x)
        grid.values.push_back(program.at(grid.place({x, y, z})));
  return grid;
}

// The mean of the crossings of a cell's edges, moved to the surface; false: it has none.
bool vertexOf(const FieldProgram& program, const Grid& grid, const glm::ivec3& cell,
              glm::dvec3& vertex) {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) {
      glm::ivec3 from = cell;
      from[(axis + 1) % 3] += k & 1;
      from[(axis + 2) % 3] += k >> 1;
      glm::ivec3 to = from;
      ++to[axis];
      const double a = grid.at(from), b = grid.at(to);
      if ((a < 0.0) == (b < 0.0)) continue;
      sum += glm::mix(grid.place(from), grid.place(to), a / (a - b));
      ++count;
    }
  }
  if (count == 0) return false;
  vertex = sum / double(count);
  const glm::dvec3 low = grid.place(cell), high = low + grid.cell;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 slope = program.gradientAt(vertex);
    const double slope2 = glm::dot(slope, slope);
    if (!(slope2 > 0.0) || !std::isfinite(slope2)) break;
    vertex = glm::clamp(vertex - slope * (program.at(vertex) / slope2), low, high);
  }
  return true;
}

}  // namespace

MeshGeometry fieldStandIn(const FieldProgram& program) {
  const Grid grid = sampled(program);
  MeshGeometry mesh;
  std::vector<uint32_t> vertices(size_t(grid.cells.x) * size_t(grid.cells.y) * size_t(grid.cells.z),
                                 kNone);
  glm::ivec3 i;
  for (i.z = 0; i.z < grid.cells.z; ++i.z) {
    for (i.y = 0; i.y < grid.cells.y; ++i.y) {
      for (i.x = 0; i.x < grid.cells.x; ++i.x) {
        glm::dvec3 vertex;
        if (!vertexOf(program, grid, i, vertex)) continue;
        vertices[grid.number(i)] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(vertex);
      }
    }
  }
  // An edge whose ends have two signs is crossed by a face between the four cells around it.
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (i.z = axis == 2 ? 0 : 1; i.z < grid.cells.z; ++i.z) {
      for (i.y = axis == 1 ? 0 : 1; i.y < grid.cells.y; ++i.y) {
        for (i.x = axis == 0 ? 0 : 1; i.x < grid.cells.x; ++i.x) {
          glm::ivec3 to = i;
          ++to[axis];
          const bool isInside = grid.at(i) < 0.0;
          if (isInside == (grid.at(to) < 0.0)) continue;
          glm::ivec3 a = i, b = i, c = i;
          --a[u], --a[v], --b[v], --c[u];
          const std::array<uint32_t, 4> around{vertices[grid.number(a)], vertices[grid.number(b)],
                                               vertices[grid.number(i)], vertices[grid.number(c)]};
          const auto face = [&](size_t p, size_t q, size_t r) {
            if (!isInside) std::swap(q, r);
            mesh.triangles.emplace_back(around[p], around[q], around[r]);
          };
          face(0, 1, 2);
          face(0, 2, 3);
        }
      }
    }
  }
  return mesh;
}

void addFieldNormals(const FieldProgram& program, MeshGeometry& mesh) {
  constexpr double kInwards = 0.05;  // a corner at an edge is asked on its triangle's side of it
  MeshGeometry own;
  own.name = mesh.name;
  for (const glm::uvec3& t : mesh.triangles) {
    const std::array<glm::dvec3, 3> p{glm::dvec3(mesh.positions[t.x]),
                                      glm::dvec3(mesh.positions[t.y]),
                                      glm::dvec3(mesh.positions[t.z])};
    const glm::dvec3 face = glm::cross(p[1] - p[0], p[2] - p[0]),
                     centre = (p[0] + p[1] + p[2]) / 3.0;
    if (!(glm::length(face) > 0.0)) continue;  // glTF readers refuse normals without a direction
    const auto first = static_cast<uint32_t>(own.positions.size());
    for (const glm::dvec3& corner : p) {
      const glm::dvec3 slope = program.gradientAt(glm::mix(corner, centre, kInwards));
      const double length = glm::length(slope);
      const bool isAlong = length > 0.0 && std::isfinite(length) && glm::dot(slope, face) > 0.0;
      own.positions.emplace_back(corner);
      own.normals.emplace_back(isAlong ? slope / length : glm::normalize(face));
    }
    own.triangles.emplace_back(first, first + 1, first + 2);
  }
  if (!own.triangles.empty()) mesh = std::move(own);
}

}  // namespace restlab
