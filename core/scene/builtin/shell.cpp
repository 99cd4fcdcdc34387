#include "core/scene/builtin/shell.h"

#include <map>
#include <stdexcept>
#include <tuple>

namespace restlab::builtin {
namespace {

using Cell = std::array<int, 3>;

class Shell {
 public:
  Shell(const ShellGrid& grid, std::vector<MeshGeometry>& meshes)
      : grid_(grid), meshes_(meshes), vertexOf_(meshes.size()) {}

  void build() {
    Cell cell;
    for (cell[0] = 0; cell[0] < cells(0); ++cell[0]) {
      for (cell[1] = 0; cell[1] < cells(1); ++cell[1]) {
        for (cell[2] = 0; cell[2] < cells(2); ++cell[2]) {
          if (isAir(cell)) addFacesOf(cell);
        }
      }
    }
  }

 private:
  int cells(int axis) const { return int(grid_.lines[size_t(axis)].size()) - 1; }
  double line(int axis, int index) const { return grid_.lines[size_t(axis)][size_t(index)]; }

  glm::dvec3 centerOf(const Cell& cell) const {
    glm::dvec3 center;
    for (int a = 0; a < 3; ++a)
      center[a] = 0.5 * (line(a, cell[size_t(a)]) + line(a, cell[size_t(a)] + 1));
    return center;
  }

  bool isAir(const Cell& cell) const {
    for (int a = 0; a < 3; ++a) {
      if (cell[size_t(a)] < 0 || cell[size_t(a)] >= cells(a)) return false;
    }
    return grid_.isAir(centerOf(cell));
  }

  void addFacesOf(const Cell& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        Cell neighbour = cell;
        neighbour[size_t(axis)] += side == 1 ? 1 : -1;
        if (!isAir(neighbour)) addFace(cell, axis, side);
      }
    }
  }

  // Adds the face on the low (0) or high (1) side along `axis`, looking back into the cell.
  void addFace(const Cell& cell, int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::dvec3 center = centerOf(cell), normal(0.0);
    center[axis] = line(axis, cell[size_t(axis)] + side);
    normal[axis] = side == 1 ? -1.0 : 1.0;
    const uint32_t group = grid_.groupOf(center, normal);
    std::array<uint32_t, 4> corners;
    for (int i = 0; i < 4; ++i) {
      Cell grid = cell;
      grid[size_t(axis)] += side;
      grid[size_t(u)] += (i == 1 || i == 2) ? 1 : 0;
      grid[size_t(v)] += (i >= 2) ? 1 : 0;
      corners[size_t(i)] = vertex(group, grid);
    }
    // (u, v, axis) is right-handed: this order of corners faces +axis.
    if (side == 1) std::swap(corners[1], corners[3]);
    MeshGeometry& mesh = meshes_.at(group);
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh.triangles.push_back({corners[0], corners[2], corners[3]});
  }

  uint32_t vertex(uint32_t group, const Cell& corner) {
    MeshGeometry& mesh = meshes_.at(group);
    const auto [entry, isNew] =
        vertexOf_[group].try_emplace(corner, uint32_t(mesh.positions.size()));
    if (isNew)
      mesh.positions.push_back(
          glm::vec3(line(0, corner[0]), line(1, corner[1]), line(2, corner[2])));
    return entry->second;
  }

  const ShellGrid& grid_;
  std::vector<MeshGeometry>& meshes_;
  std::vector<std::map<Cell, uint32_t>> vertexOf_;
};

}  // namespace

std::vector<MeshGeometry> airShell(const std::string& name, const ShellGrid& grid,
                                   const std::vector<std::string>& groups) {
  for (const std::vector<double>& lines : grid.lines) {
    if (lines.size() < 2) throw std::logic_error("airShell: an axis has fewer than two grid lines");
    for (size_t i = 1; i < lines.size(); ++i) {
      if (!(lines[i - 1] < lines[i])) throw std::logic_error("airShell: grid lines do not ascend");
    }
  }
  std::vector<MeshGeometry> meshes(groups.size());
  for (size_t i = 0; i < groups.size(); ++i) meshes[i].name = name + "-" + groups[i];
  Shell(grid, meshes).build();
  return meshes;
}

}  // namespace restlab::builtin
