#include <array>
#include <stdexcept>
#include <string>

#include "core/base/error.h"
#include "core/scene/field/expression.h"
#include "core/scene/field/grid_file.h"
#include "core/scene/field/solid.h"
#include "core/scene/field/stand_in.h"
#include "tests/fuzz/entries.h"

namespace restlab::fuzz {

// Checks that a field has values within its bounds, and makes its mesh.
static void checkField(const FieldProgram& field) {
  const glm::dvec3 low(field.low), high(field.high);
  const FieldRange range = field.over(low, high);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 at = glm::mix(low, high, glm::dvec3(i & 1, i >> 1 & 1, i >> 2));
    const double value = field.at(at), slack = 1e-9 * (1.0 + std::abs(value));
    if (!(value >= range.low - slack && value <= range.high + slack))
      throw std::logic_error("a value is out of its bounds");
  }
  fieldStandIn(field);
}

bool readField(const uint8_t* bytes, size_t count) {
  if (count == 0) return false;
  const std::string text(bytes + 1, bytes + count);
  try {
    checkField(bytes[0] == 's' ? readSolid(text)
                               : readExpression(text, glm::vec3(-1.0f), glm::vec3(1.0f)));
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::badInput || std::string(error.what()).empty())
      throw std::logic_error(error.what());
    return false;
  }
}

bool readGridFile(const uint8_t* bytes, size_t count) {
  try {
    const SampledGrid grid = readGrid({bytes, bytes + count}, "x.vol");
    const std::array box{glm::vec3(grid.low - 0.1), glm::vec3(grid.high + 0.1)};
    checkField(readSolid("rotate(1, 2, 3, 40, grid('x.vol'))", box,
                         [&](const std::string&) { return FieldGrid(grid); }));
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::badInput || std::string(error.what()).empty())
      throw std::logic_error(error.what());
    return false;
  }
}

}  // namespace restlab::fuzz
