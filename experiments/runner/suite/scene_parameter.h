// Scenes that differ in one number of their names.
#pragma once

#include <string>
#include <vector>

namespace restlab {

struct SweptParameter {
  std::string name;            // "albedo"
  std::string scene;           // what the names have in common: "furnace?scale=2"
  std::vector<double> values;  // of the names, in their order
  std::vector<std::string> texts;
};

// Of at least two names. Throws Error (badUsage) where they are not of one built-in scene, differ
// in more than one parameter or have a value twice.
SweptParameter sweptParameter(const std::vector<std::string>& names);

}  // namespace restlab
