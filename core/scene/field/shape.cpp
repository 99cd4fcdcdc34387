#include "core/scene/field/shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/field/stand_in.h"

namespace restlab {

ShapeInfo fieldShape() {
  ShapeInfo info;
  info.hasDraws = false;
  info.isClosed = [](const ShapeGeometry& shape) { return shape.words.at(7) != 0; };
  info.isInside = [](const ShapeGeometry& shape, const glm::dvec3& p) {
    const FieldProgram program = fieldProgram(shape.words);
    const bool isInBox = glm::all(glm::greaterThan(p, glm::dvec3(program.low))) &&
                         glm::all(glm::lessThan(p, glm::dvec3(program.high)));
    return isInBox && program.at(p) < 0.0;
  };
  info.box = [](const ShapeGeometry& shape) {
    const FieldProgram program = fieldProgram(shape.words);
    return std::array{program.low, program.high};
  };
  info.standIn = [](const ShapeGeometry& shape) { return fieldStandIn(fieldProgram(shape.words)); };
  return info;
}

std::optional<std::array<glm::vec3, 2>> readFieldBox(const ConfigTable& table) {
  if (!table.has("box")) return std::nullopt;
  const std::vector<double> b = table.getNumbers("box", {}, 6, -1e6, 1e6);
  const glm::dvec3 low(b[0], b[1], b[2]), high(b[3], b[4], b[5]);
  const glm::dvec3 size = high - low;
  const double least = std::min({size.x, size.y, size.z});
  const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
  if (!(least > 1e-4 * std::max({far.x, far.y, far.z})))
    table.fail("box",
               "'box' is [x, y, z, x, y, z]: the corner with the least coordinates, then the "
               "one with the largest; no edge may be below 1/10000 of a coordinate");
  return std::array{glm::vec3(low), glm::vec3(high)};
}

void readField(const ConfigTable& table, const std::string& key, ShapeGeometry& shape,
               const std::function<FieldProgram()>& make) {
  FieldProgram program;
  try {
    program = make();
  } catch (const Error& error) {
    table.fail(key, fmt::format("'{}': {}", key, error.what()));
  }
  if (fieldStandIn(program).triangles.empty())
    table.fail(key,
               fmt::format("'{}' has no surface in the box: nowhere it changes its sign", key));
  shape.words = fieldWords(program);
}

}  // namespace restlab
