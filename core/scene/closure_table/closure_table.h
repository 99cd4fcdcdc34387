// A BRDF as a table of values, measured or computed: files, and the records that the closure
// `table` (core/shading/closures/table.glsl) reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace restlab {

// Angles that the three axes of a table stand for. Cells are of equal width, values stand at their
// centres.
enum class TableAngles : uint32_t {
  // theta_h of the half vector (cells of equal width in its square root), theta_d and phi_d of wi
  // about it (Rusinkiewicz 1998): 0 to 90, 90 and 180 degrees. f(wi, wo) = f(wo, wi) as phi_d and
  // phi_d + 180 degrees are one.
  half,
  // theta of wo, theta of wi, and the angle between their azimuths: 0 to 90, 90 and 180 degrees.
  directions
};

// An isotropic BRDF that reflects alone.
struct ClosureTable {
  std::string name;  // of the file
  TableAngles angles = TableAngles::half;
  glm::uvec3 sizes{0u};           // of the axes, the last is the fastest
  std::vector<glm::vec3> values;  // 1/sr, sizes.x * sizes.y * sizes.z

  const glm::vec3& at(uint32_t i, uint32_t j, uint32_t k) const {
    return values[(size_t(i) * sizes.y + j) * sizes.z + k];
  }
};

constexpr uint32_t kMaxTableCells = 64u << 20;
constexpr uint32_t kMaxTableSide = 4096;
constexpr glm::uvec3 kMerlSizes{90u, 90u, 180u};

// Directions at coordinates in cells, and at the centre of a cell, local to the normal. Half tables
// have some whose wi or wo lies below the surface: f has no meaning there.
struct TableDirections {
  glm::dvec3 wo{0.0}, wi{0.0};
};
TableDirections directionsAt(TableAngles angles, const glm::uvec3& sizes, const glm::dvec3& cells);
TableDirections directionsOfCell(TableAngles angles, const glm::uvec3& sizes,
                                 const glm::uvec3& cell);

// Reads a file, by its ending: `.binary` of the MERL database (Matusik et al. 2003), or `.exr` by
// writeTableExr(). Values below the surface become 0. Throws Error (badInput) with one line.
ClosureTable readClosureTable(const std::filesystem::path& file);

using BrdfFunction = std::function<glm::dvec3(const glm::dvec3& wo, const glm::dvec3& wi)>;  // 1/sr

// A table of the values of `f` at the centres of its cells, which are lifted to the surface where
// they lie below.
ClosureTable tabulate(const BrdfFunction& f, TableAngles angles, const glm::uvec3& sizes);

// Writes a half table of MERL's sizes in the format of its database.
void writeMerl(const std::filesystem::path& file, const ClosureTable& table);
// Writes the values as rows of the last axis, with angles and sizes as attributes.
void writeTableExr(const std::filesystem::path& file, const ClosureTable& table);

// Makes a table of directions symmetric: f(wi, wo) = f(wo, wi). Others are.
void makeReciprocal(ClosureTable& table);

// The records of a table: two of its albedos, then a value each with the cumulative probability by
// which directions are drawn (table.glsl).
std::vector<glm::uvec4> tableRecords(const ClosureTable& table);

}  // namespace restlab
