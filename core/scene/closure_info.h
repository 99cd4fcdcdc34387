// Closures as their files describe themselves: parameters in the order in which kernels read them,
// ranges, sources, and the laws of a BSDF that they break.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/dialect/features.h"

namespace restlab {

struct ClosureParameter {
  enum class Kind { color, number, choice, table, material };
  std::string name;
  Kind kind = Kind::number;
  double fallback = 0.0;      // of a color: of each channel; of a choice: the index; tables and
                              // materials have none
  double lo = 0.0, hi = 1.0;  // inclusive, of each channel
  std::vector<std::string> choices{};
  std::string help;
  bool isOptional = true;  // false: a table or material that has to be named
};

struct ClosureInfo {
  std::string name;
  uint32_t kind = 0;            // RL_CLOSURE_*
  rl::FeatureMask feature = 0;  // RL_FEATURE_CLOSURE_*
  std::string summary;
  std::string source;  // papers
  std::vector<ClosureParameter> parameters;
  // Laws of a BSDF that it breaks ("energy", "reciprocity"), where a choice has a value ("": for
  // some of its parameters).
  std::vector<std::string> brokenLaws;
  std::string brokenWhere, brokenIf;
  // Colours or numbers whose sum is at most 1: the parts of a convex mixture.
  std::vector<std::string> convexParts;
  std::string anisotropicWhere;  // a number that, above 0, makes the closure look at the tangent

  // For the closures' files (under RL_CLOSURE_DECLARED).
  void is(const char* summaryText, const char* sourceText);
  void color(const char* parameter, double fallback, const char* help, double most = 1.0);
  void number(const char* parameter, double fallback, double lo, double hi, const char* help);
  void choice(const char* parameter, std::vector<std::string> choices, const char* help);
  void table(const char* parameter, const char* help);
  void material(const char* parameter, bool isOptional, const char* help);
  void breaks(std::vector<std::string> laws, const char* parameter = "", const char* value = "");
  void convex(std::vector<std::string> parts);
  void looksAtTangent(const char* parameter);
};

// All of core/shading/closures/closures.list, in its order.
const std::vector<ClosureInfo>& closureRegistry();
// nullptr if there is none of this name.
const ClosureInfo* findClosure(const std::string& name);

}  // namespace restlab
