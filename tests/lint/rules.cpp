#include "tests/lint/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace restlab::lint {

namespace {

const std::set<std::string>& reservedWords() {
  static const std::set<std::string> words = {
      "active",    "asm",        "buffer",   "cast",     "centroid", "coherent",  "common",
      "external",  "filter",     "fixed",    "flat",     "goto",     "half",      "input",
      "interface", "invariant",  "long",     "noinline", "output",   "partition", "patch",
      "precise",   "public",     "resource", "sample",   "shared",   "short",     "sizeof",
      "smooth",    "subroutine", "superp",   "this",     "typedef",  "union",     "unsigned",
      "using",     "varying",    "volatile", "texture",  "sampler"};
  return words;
}

const std::set<std::string>& builtins() {
  static const std::set<std::string> names = {
      "abs",        "acos",    "all",       "any",     "asin",         "atan",
      "ceil",       "clamp",   "cos",       "cross",   "degrees",      "determinant",
      "distance",   "dot",     "equal",     "exp",     "exp2",         "faceforward",
      "floor",      "fma",     "fract",     "inverse", "inversesqrt",  "isinf",
      "isnan",      "length",  "log",       "log2",    "max",          "min",
      "mix",        "mod",     "normalize", "not",     "outerProduct", "pow",
      "radians",    "reflect", "refract",   "round",   "sign",         "sin",
      "smoothstep", "sqrt",    "step",      "tan",     "transpose",    "trunc"};
  return names;
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isHex(const std::string& number) {
  return number.compare(0, 2, "0x") == 0 || number.compare(0, 2, "0X") == 0;
}

bool isFloating(const std::string& number) {
  return !isHex(number) && number.find_first_of(".eE") != std::string::npos;
}

bool isDraw(const std::string& name) {
  return name.compare(0, 7, "rngDraw") == 0 || name.compare(0, 7, "rngBits") == 0;
}

// Calls visit(nameIndex, openIndex, closeIndex) for each RL_FN function: its name and parentheses.
template <typename Visit>
void forEachFunction(const TokenizedFile& file, Visit visit) {
  const auto& t = file.tokens;
  for (size_t i = 0; i < t.size(); ++i) {
    if (t[i].text != "RL_FN" && t[i].text != "RL_FN_OUTLINE") continue;
    size_t open = i;
    while (open < t.size() && t[open].text != "(") ++open;
    if (open == t.size() || open == 0) return;
    int depth = 0;
    size_t close = open;
    for (; close < t.size(); ++close) {
      if (t[close].text == "(") ++depth;
      if (t[close].text == ")" && --depth == 0) break;
    }
    visit(open - 1, open, close);
  }
}

}  // namespace

std::string format(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) text += fmt::format("{}:{}: {}\n", f.path, f.line, f.message);
  return text;
}

std::vector<Finding> findReservedWords(const TokenizedFile& file) {
  std::vector<Finding> found;
  for (const Token& t : file.tokens) {
    if (t.kind == TokenKind::identifier && reservedWords().count(t.text)) {
      found.push_back({file.path, t.line, fmt::format("'{}' is a reserved word of GLSL", t.text)});
    }
  }
  return found;
}

std::vector<Finding> findBareLiterals(const TokenizedFile& file) {
  std::vector<Finding> found;
  // Host-side names that take plain integers count as int variables.
  std::set<std::string> integers = {"int", "ivec2", "ivec3", "ivec4", "RL_STATIC_ASSERT_SIZE"};
  const auto& t = file.tokens;
  for (size_t i = 0; i + 1 < t.size(); ++i) {
    if (t[i].text == "int" && t[i + 1].kind == TokenKind::identifier)
      integers.insert(t[i + 1].text);
  }
  for (const TokenRange& range : statements(file)) {
    const auto first = t.begin() + std::ptrdiff_t(range.first);
    const auto last = t.begin() + std::ptrdiff_t(range.last);
    const bool hasInt = std::any_of(
        first, last, [&](const Token& token) { return integers.count(token.text) > 0; });
    for (size_t i = range.first; i < range.last; ++i) {
      if (t[i].kind != TokenKind::number) continue;
      const std::string& number = t[i].text;
      const bool isArraySize = i > 0 && t[i - 1].text == "[";
      if (isFloating(number) && !endsWith(number, "f")) {
        found.push_back(
            {file.path, t[i].line, fmt::format("literal {} needs the suffix f", number)});
      } else if (!isFloating(number) && !endsWith(number, "u") &&
                 (isHex(number) || (!hasInt && !isArraySize))) {
        found.push_back(
            {file.path, t[i].line, fmt::format("literal {} needs the suffix u", number)});
      }
    }
  }
  return found;
}

std::vector<Finding> findDoubleDraws(const TokenizedFile& file) {
  std::vector<Finding> found;
  for (const TokenRange& range : statements(file)) {
    int draws = 0;
    for (size_t i = range.first; i + 1 < range.last; ++i) {
      if (!isDraw(file.tokens[i].text) || file.tokens[i + 1].text != "(") continue;
      if (++draws == 2) {
        found.push_back({file.path, file.tokens[i].line, "two random draws in one statement"});
      }
    }
  }
  return found;
}

std::vector<Finding> findSwizzles(const TokenizedFile& file) {
  std::vector<Finding> found;
  const auto& t = file.tokens;
  for (size_t i = 0; i + 1 < t.size(); ++i) {
    if (t[i].text != "." || t[i + 1].kind != TokenKind::identifier) continue;
    const std::string& member = t[i + 1].text;
    if (member.size() < 2 || member.size() > 4) continue;
    for (const char* letters : {"xyzw", "rgba", "stpq"}) {
      if (member.find_first_not_of(letters) == std::string::npos) {
        found.push_back(
            {file.path, t[i + 1].line, fmt::format("swizzle .{}: only .x .y .z .w", member)});
      }
    }
  }
  return found;
}

std::vector<Finding> findBadDirectives(const TokenizedFile& file) {
  std::vector<Finding> found;
  for (const Directive& d : file.directives) {
    if (d.text.find("pragma") != std::string::npos && d.text.find("once") != std::string::npos) {
      found.push_back(
          {file.path, d.line, "#pragma once: glslang ignores it; use an include guard"});
    }
    const bool isInclude = d.text.find("include") != std::string::npos;
    if (isInclude && endsWith(file.path, ".glsl") && d.text.find(".h\"") != std::string::npos) {
      found.push_back({file.path, d.line,
                       "a .glsl never includes a .h: headers come before the kernel context"});
    }
  }
  return found;
}

std::vector<Finding> findDefaultArguments(const TokenizedFile& file) {
  std::vector<Finding> found;
  forEachFunction(file, [&](size_t name, size_t open, size_t close) {
    for (size_t i = open; i < close; ++i) {
      if (file.tokens[i].text == "=") {
        found.push_back(
            {file.path, file.tokens[i].line,
             fmt::format("default argument of {}(): write an overload", file.tokens[name].text)});
      }
    }
  });
  return found;
}

std::vector<Finding> findHiddenBuiltins(const TokenizedFile& file) {
  std::vector<Finding> found;
  forEachFunction(file, [&](size_t name, size_t, size_t) {
    const Token& token = file.tokens[name];
    if (builtins().count(token.text)) {
      found.push_back(
          {file.path, token.line, fmt::format("{}() hides a built-in function", token.text)});
    }
  });
  return found;
}

std::vector<Finding> findMisplaced(const TokenizedFile& file) {
  std::vector<Finding> found;
  const bool isHeader = endsWith(file.path, ".h");
  int depth = 0;
  for (const Token& t : file.tokens) {
    if (t.text == "{") ++depth;
    if (t.text == "}") --depth;
    if (isHeader && (t.text == "RL_FN" || t.text == "RL_FN_OUTLINE")) {
      found.push_back({file.path, t.line,
                       "a function in a .h: functions live in a .glsl, inside the kernel context"});
    }
    if (!isHeader && depth == 0 && (t.text == "struct" || t.text == "const")) {
      found.push_back(
          {file.path, t.line,
           fmt::format("'{}' at file scope of a .glsl: types and constants live in a .h", t.text)});
    }
  }
  return found;
}

std::vector<Finding> findSceneByAddress(const TokenizedFile& file) {
  std::vector<Finding> found;
  const auto& t = file.tokens;
  for (size_t i = 0; i + 4 < t.size(); ++i) {
    if (t[i].text == "gScene" && t[i + 1].text == "." && t[i + 3].text == "." &&
        t[i + 4].text == "data") {
      found.push_back({file.path, t[i].line,
                       fmt::format("gScene.{}.data: RL_SCENE_* reads the scene", t[i + 2].text)});
    }
  }
  return found;
}

std::vector<Finding> findAll(const TokenizedFile& file) {
  std::vector<Finding> found;
  for (auto* rule :
       {findReservedWords, findBareLiterals, findDoubleDraws, findSwizzles, findBadDirectives,
        findDefaultArguments, findHiddenBuiltins, findMisplaced, findSceneByAddress}) {
    const std::vector<Finding> more = rule(file);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

}  // namespace restlab::lint
