// The two kinds of shapes that are fields: an expression, a solid made of others.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "core/scene/field/program.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab {

// All of a kind but its summary, its examples and how it is read.
ShapeInfo fieldShape();

// Reads 'box', [x, y, z, x, y, z] of two corners; nullopt if there is none.
std::optional<std::array<glm::vec3, 2>> readFieldBox(const ConfigTable& table);

// Makes the words of a shape out of a key; errors name the key's place. Fails where the field has
// no surface in its box.
void readField(const ConfigTable& table, const std::string& key, ShapeGeometry& shape,
               const std::function<FieldProgram()>& make);

}  // namespace restlab
