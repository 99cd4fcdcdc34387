// Names of built-in scenes with parameters: "furnace?albedo=0.99&scale=2^10".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

struct BuiltinName {
  struct Given {
    std::string name, text;  // "scale", "2^10"
    double value;
  };
  std::string base;          // "furnace"
  std::vector<Given> given;  // in the order of the name

  // A parameter's value; nothing where it is not given and has no default.
  std::optional<double> value(const std::string& parameter) const;
  // As it is written; "" where it is not.
  std::string text(const std::string& parameter) const;
};

// Throws Error (badInput) with one line: no such scene, unknown or repeated parameters, values that
// are no number (as 0.5, 1e-3 or 2^-13) or out of range.
BuiltinName parseBuiltinName(const std::string& name);

// Parameters that change the image of any scene by a known relation, and not its contents.
constexpr const char* kScaleParameter = "scale";
constexpr const char* kRadianceParameter = "radiance";
constexpr const char* kMoveParameter = "move";

// The name without these three: "furnace?albedo=0.99". `name` is a built-in's.
std::string withoutRelations(const std::string& name);

}  // namespace restlab
