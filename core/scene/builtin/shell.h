// The inner surface of rooms that open into each other, built from cells of a grid. Neighbouring
// faces share their edges exactly, so the surface is closed and light cannot leak through a wall.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::builtin {

struct ShellGrid {
  std::array<std::vector<double>, 3> lines;  // ascending coordinates of the grid planes, metres
  // Returns whether the cell around this point is air. Points outside the grid are solid.
  std::function<bool(const glm::dvec3& center)> isAir;
  // Returns the group of the face at `center` whose unit normal points into the air. Each group
  // becomes one mesh.
  std::function<uint32_t(const glm::dvec3& center, const glm::dvec3& normal)> groupOf;
};

// Makes one flat mesh per group, named NAME-GROUP; every face looks into the air. Groups without a
// face are empty meshes. Vertices are shared inside a group.
std::vector<MeshGeometry> airShell(const std::string& name, const ShellGrid& grid,
                                   const std::vector<std::string>& groups);

}  // namespace restlab::builtin
