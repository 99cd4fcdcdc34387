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
    double value;            // of a choice: its place
  };
  std::string base;          // "furnace"
  std::vector<Given> given;  // in the order of the name

  // Value of a parameter, given or by default; nullopt if neither.
  std::optional<double> value(const std::string& parameter) const;
  // Text of a parameter as given; "" if not given.
  std::string text(const std::string& parameter) const;
};

// Throws Error (badInput) with one line for: an unknown scene; unknown or repeated parameters;
// values that are not a number (such as 0.5, 1e-3 or 2^-13), out of range or no choice.
BuiltinName parseBuiltinName(const std::string& name);

// Parameters of every scene that change its image by a known relation.
constexpr const char* kScaleParameter = "scale";
constexpr const char* kRadianceParameter = "radiance";
constexpr const char* kMoveParameter = "move";
// Another representation of the same surfaces: the same image, but for the chord error of meshes.
constexpr const char* kRepresentationParameter = "as";

// Removes these four from the name of a built-in scene: "furnace?albedo=0.99".
std::string withoutRelations(const std::string& name);

}  // namespace restlab
