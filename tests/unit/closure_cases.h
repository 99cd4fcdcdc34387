// Closures by the words of a scene file, as the shipped surfaceLoad() makes them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/closure_info.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/unit/bsdf_cases.h"

namespace restlab::unit {

struct ClosureCase {
  std::string kind, name;  // name: the text
  rl::Bsdf bsdf;
  std::shared_ptr<const CompiledScene> scene;  // for closures that read more than their Bsdf
  bool breaksEnergy = false, breaksReciprocity = false;  // as its file declares
  bool isCombined = false;                               // one of many combinations
};

// The BSDF of a [[material]] table: `text` has its kind and parameters as TOML.
rl::Bsdf closureOf(const std::string& text);
// The same with its scene, in which "half" and "directions" are tables, and "metal", "matte",
// "smooth" and "hole" materials that a mixture may name.
ClosureCase closureCaseOf(const std::string& text);
// The kind with its defaults, and what it has to be given.
std::string defaultText(const ClosureInfo& info);
// The BRDF that these tables hold, 1/sr.
glm::dvec3 tabulatedBrdf(const glm::dvec3& wo, const glm::dvec3& wi);

// Every closure of the list with its defaults, each choice, both ends of each colour, and both ends
// and the middle of each number; facets in all combinations. Laws that a file declares as broken
// are marked where they are.
std::vector<ClosureCase> closureCases();

}  // namespace restlab::unit
