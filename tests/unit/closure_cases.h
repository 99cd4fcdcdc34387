// Closures by the words of a scene file, as the shipped surfaceLoad() makes them.
#pragma once

#include <string>
#include <vector>

#include "tests/unit/bsdf_cases.h"

namespace restlab::unit {

// The BSDF of a [[material]] table: `text` has its kind and parameters as TOML.
rl::Bsdf closureOf(const std::string& text);

struct ClosureCase {
  std::string kind, name;  // name: the text
  rl::Bsdf bsdf;
  bool breaksEnergy = false, breaksReciprocity = false;  // as its file declares
  bool isCombined = false;                               // one of many combinations
};

// Every closure of the list with its defaults, each choice, both ends of each colour, and both ends
// and the middle of each number; facets in all combinations. Laws that a file declares as broken
// are marked where they are.
std::vector<ClosureCase> closureCases();

}  // namespace restlab::unit
