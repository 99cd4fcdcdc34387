#include <fmt/format.h>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/field/expression.h"
#include "core/scene/field/shape.h"

namespace restlab {

namespace {

ShapeExample example(const std::string& name, const std::string& text, float reach) {
  return {name, {}, fieldWords(readExpression(text, glm::vec3(-reach), glm::vec3(reach)))};
}

}  // namespace

ShapeInfo implicitShape() {
  ShapeInfo info = fieldShape();
  info.summary = "the surface where 'expression' of x, y and z is 0, cut off at 'box'";
  info.examples = {example("implicit_sphere", "x^2 + y^2 + z^2 - 1", 1.1f),
                   example("implicit_torus", "(sqrt(x^2 + y^2) - 0.7)^2 + z^2 - 0.0625", 1.0f)};
  info.read = [](const ConfigTable& table, const ShapeFiles&, ShapeGeometry& shape) {
    if (!table.has("expression"))
      table.fail("", "an implicit [[shape]] has no 'expression', as \"x^2 + y^2 + z^2 - 1\"");
    const std::array<glm::vec3, 2> box =
        readFieldBox(table).value_or(std::array{glm::vec3(-1.0f), glm::vec3(1.0f)});
    const std::string text = table.getString("expression", "");
    readField(table, "expression", shape, [&] { return readExpression(text, box[0], box[1]); });
  };
  return info;
}

}  // namespace restlab
