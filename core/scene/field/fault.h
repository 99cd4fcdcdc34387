// Where a field has no value.
#pragma once

#include <optional>
#include <string>

#include "core/scene/field/program.h"

namespace restlab {

struct FieldFault {
  size_t instruction = 0;
  std::string why;  // "divides by 0"
};

// Finds an instruction without a value somewhere in the box, or with one above 1e15; bounds decide,
// so that none is missed.
std::optional<FieldFault> findFault(const FieldProgram& program);

}  // namespace restlab
