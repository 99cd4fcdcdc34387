// Rules of the kernel dialect that no compiler checks (docs/dialect.md).
#pragma once

#include <string>
#include <vector>

#include "tests/lint/tokens.h"

namespace restlab::lint {

struct Finding {
  std::string path;
  int line;
  std::string message;
};

// "path:line: message", one per line.
std::string format(const std::vector<Finding>& findings);

// Names that are reserved words of GLSL or HLSL.
std::vector<Finding> findReservedWords(const TokenizedFile& file);
// Floating literals without f, hexadecimal ones without u, decimal integers without u in a
// statement that has no int variable.
std::vector<Finding> findBareLiterals(const TokenizedFile& file);
// Two random draws in one statement: C++ does not fix the order in which arguments are evaluated.
std::vector<Finding> findDoubleDraws(const TokenizedFile& file);
// Member accesses like .xyz or .rgb.
std::vector<Finding> findSwizzles(const TokenizedFile& file);
// `#pragma once`, and a .glsl that includes a .h.
std::vector<Finding> findBadDirectives(const TokenizedFile& file);
// Default arguments of RL_FN functions.
std::vector<Finding> findDefaultArguments(const TokenizedFile& file);
// RL_FN functions with the name of a GLSL built-in: a member with that name hides all of GLM's.
std::vector<Finding> findHiddenBuiltins(const TokenizedFile& file);
// A function in a .h, a type or constant at file scope in a .glsl.
std::vector<Finding> findMisplaced(const TokenizedFile& file);
// `gScene.<array>.data`: the scene's arrays must be read by RL_SCENE_*, which may use texels.
std::vector<Finding> findSceneByAddress(const TokenizedFile& file);

// Findings of all rules above.
std::vector<Finding> findAll(const TokenizedFile& file);

// RL_DIM_* constants that share a number or reach RL_DIMENSIONS. A comment "+ donor index (N at
// most)" reserves N numbers: this rule needs the text with comments.
struct SourceText {
  std::string path, text;
};
std::vector<Finding> findDimensionClashes(const std::vector<SourceText>& headers);

}  // namespace restlab::lint
