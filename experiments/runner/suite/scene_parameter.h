// Built-in scenes whose names differ in one number.
#pragma once

#include <string>
#include <vector>

namespace restlab {

struct SweptParameter {
  std::string name;            // "albedo"
  std::string scene;           // common part of the names: "furnace?scale=2"
  std::vector<double> values;  // in the order of the names
  std::vector<std::string> texts;
};

// Parses at least two names. Throws Error (badUsage) if they are not of one built-in scene, differ
// in more than one parameter or repeat a value.
SweptParameter sweptParameter(const std::vector<std::string>& names);

}  // namespace restlab
