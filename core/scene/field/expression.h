// Expressions over x, y and z, as "x^2 + y^2 + z^2 - 1".
#pragma once

#include <string>

#include "core/scene/field/program.h"

namespace restlab {

// Reads numbers, x y z, pi, + - * / ^ (whole powers), parentheses, and sin cos exp sqrt abs min
// max. The box is (low, high). Throws Error (badInput) without a file: the place in the text, what
// is wrong; also where the value is not bounded in the box.
FieldProgram readExpression(const std::string& text, const glm::vec3& low, const glm::vec3& high);

}  // namespace restlab
