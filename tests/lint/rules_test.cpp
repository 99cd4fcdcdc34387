// Tests of the rules on snippets with and without findings, then on every dialect file.
#include "tests/lint/rules.h"

#include <gtest/gtest.h>

#include "tests/lint/dialect_files.h"

namespace restlab::lint {
namespace {

struct Case {
  const char* name;
  std::vector<Finding> (*rule)(const TokenizedFile&);
  const char* path;
  const char* text;
  int line;  // line of the expected finding; 0: none
};

class Rule : public testing::TestWithParam<Case> {};

TEST_P(Rule, FindsWhatItShould) {
  const Case& c = GetParam();
  const std::vector<Finding> found = c.rule(tokenize(c.path, c.text));
  if (c.line == 0) {
    EXPECT_TRUE(found.empty()) << format(found);
  } else {
    ASSERT_EQ(found.size(), 1u) << format(found);
    EXPECT_EQ(found[0].line, c.line) << format(found);
    EXPECT_EQ(found[0].path, c.path);
  }
}

const Case kCases[] = {
    {"ReservedName", findReservedWords, "a.glsl", "void f() {\n  float sample = 1.0f;\n}", 2},
    {"ReservedInComment", findReservedWords, "a.glsl", "// a sample of the input\nfloat pick;", 0},
    {"ReservedPartOfName", findReservedWords, "a.glsl", "LightSample sampleCount;", 0},
    {"FloatWithoutF", findBareLiterals, "a.glsl", "x = 1.0f;\ny = max(x, 0.0);", 2},
    {"ExponentWithoutF", findBareLiterals, "a.glsl", "x = 1e-3;", 1},
    {"ExponentWithF", findBareLiterals, "a.glsl", "x = 1.5e-3f + .5f;", 0},
    {"UintWithoutU", findBareLiterals, "a.glsl", "for (uint i = 0u;\n i < n; i = i + 1) {}", 2},
    {"HexWithoutU", findBareLiterals, "a.glsl", "int y = 3;\nint x = y ^ 0xe5;", 2},
    {"IntOfIntVariable", findBareLiterals, "a.glsl", "int y = 3;\nx = wrap(y + 1);", 0},
    {"ArraySize", findBareLiterals, "a.h", "struct S {\n  uint textures[7];\n};", 0},
    {"TwoDraws", findDoubleDraws, "a.glsl",
     "a = rngDraw(r, A);\nv = vec2(rngDraw(r, B),\n rngDraw(r, C));", 3},
    {"DrawsApart", findDoubleDraws, "a.glsl", "a = rngDraw(r, A); b = rngDraw(r, B);", 0},
    {"Swizzle", findSwizzles, "a.glsl", "a = b.x;\nc = d.xyz;", 2},
    {"ColourSwizzle", findSwizzles, "a.glsl", "c = d.rgb;", 1},
    {"NoSwizzle", findSwizzles, "a.glsl", "c = d.pdf + e.bary.x + f.zebra;", 0},
    {"PragmaOnce", findBadDirectives, "a.h", "\n#pragma once\n", 2},
    {"HeaderInGlsl", findBadDirectives, "a.glsl", "#include \"b.glsl\"\n#include \"b.h\"", 2},
    {"HeaderInHeader", findBadDirectives, "a.h", "#include \"b.h\"", 0},
    {"DefaultArgument", findDefaultArguments, "a.glsl",
     "RL_FN float f(float x,\n float y = 1.0f) { return x; }", 2},
    {"NoDefaultArgument", findDefaultArguments, "a.glsl",
     "RL_FN float f(RL_IN(vec3) x) { float y = x.x; return y; }", 0},
    {"HiddenBuiltin", findHiddenBuiltins, "a.glsl", "\nRL_FN float mix(float a) { return a; }", 2},
    {"OwnName", findHiddenBuiltins, "a.glsl", "RL_FN float rlMix(float a) { return mix(a, a, a); }",
     0},
    {"FunctionInHeader", findMisplaced, "a.h",
     "struct A {\n float b;\n};\nRL_FN float f() { return 1.0f; }", 4},
    {"ConstantInGlsl", findMisplaced, "a.glsl",
     "RL_FN float f() { const float a = 1.0f; return a; }\nconst uint A = 1u;", 2},
    {"SceneByAddress", findSceneByAddress, "a.glsl",
     "uint n = gScene.lightCount;\nLight l = gScene.lights.data[n];", 2},
    {"SceneByWord", findSceneByAddress, "a.glsl",
     "vec2 a = RL_SCENE_VEC2(gScene.uvs, 0u);\nb = gBuffers.partners.data[0];", 0},
    {"ContinuedMacro", findReservedWords, "a.h", "#define A \\\n  this\nfloat x;\nfloat half;", 4},
};
INSTANTIATE_TEST_SUITE_P(, Rule, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST(Dimensions, ClashIsFound) {
  const std::vector<Finding> found = findDimensionClashes(
      {{"a.h",
        "const uint RL_DIM_A = 1u;\nconst uint RL_DIM_B = 2u;  // + donor index (3 at most)\n"},
       {"b.h",
        "const uint RL_DIM_C = 4u;\nconst uint RL_DIM_D = 5u;\nconst uint RL_DIMENSIONS = 6u;\n"}});
  ASSERT_EQ(found.size(), 1u) << format(found);
  EXPECT_EQ(found[0].path, "b.h");
  EXPECT_EQ(found[0].line, 1);
}

TEST(Dimensions, OneBeyondTheLastIsFound) {
  const std::vector<Finding> found = findDimensionClashes(
      {{"a.h", "const uint RL_DIM_A = 3u;\nconst uint RL_DIMENSIONS = 3u;\n"}});
  ASSERT_EQ(found.size(), 1u) << format(found);
}

TEST(Dimensions, AreUnique) {
  std::vector<SourceText> headers;
  size_t constants = 0;
  for (const std::string& path : dialectHeaders()) {
    headers.push_back({path, readSource(path)});
    for (size_t at = 0;
         (at = headers.back().text.find("const uint RL_DIM_", at)) != std::string::npos; ++at) {
      ++constants;
    }
  }
  EXPECT_GT(constants, 10u) << "the constants are not where this test looks";
  const std::vector<Finding> found = findDimensionClashes(headers);
  EXPECT_TRUE(found.empty()) << format(found);
}

TEST(DialectFiles, KeepTheRules) {
  std::string report;
  for (const std::string& path : dialectFiles()) {
    // Headers that define the dialect's words use both languages.
    if (path == "core/dialect/dialect.h" || path == "core/dialect/lanes.h") continue;
    report += format(findAll(tokenize(path, readSource(path))));
  }
  EXPECT_EQ(report, "");
}

}  // namespace
}  // namespace restlab::lint
