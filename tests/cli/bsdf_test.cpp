// restlab bsdf, and scene files as a user gives them.
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

using BsdfTest = ProgramTest;

// The words of a law's verdict.
std::string verdictOf(const std::string& text, const std::string& law) {
  const auto json = nlohmann::json::parse(text);
  for (const auto& v : json["laws"]) {
    if (v["law"] == law) return v["verdict"];
  }
  return "no such law";
}

TEST_F(BsdfTest, RawPhongBreaksTwoLawsAndTheModifiedOneNone) {
  const ProgramResult raw = run("bsdf phong --json --samples 20000");
  ASSERT_EQ(raw.code, 0) << raw.err;
  EXPECT_EQ(verdictOf(raw.out, "energy"), "broken, as declared");
  EXPECT_EQ(verdictOf(raw.out, "reciprocity"), "broken, as declared");
  EXPECT_EQ(verdictOf(raw.out, "non-negative"), "holds");
  EXPECT_EQ(verdictOf(raw.out, "sampling"), "holds");
  const ProgramResult modified = run("bsdf phong --set model=modified --json --samples 20000");
  ASSERT_EQ(modified.code, 0) << modified.err;
  for (const char* law : {"energy", "reciprocity", "non-negative", "sampling"})
    EXPECT_EQ(verdictOf(modified.out, law), "holds") << law;
}

TEST_F(BsdfTest, WritesFiguresLobesAndABall) {
  const ProgramResult result = run("bsdf mirror -o out --samples 1000");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("reciprocity   holds"), std::string::npos) << result.out;
  EXPECT_EQ(nlohmann::json::parse(read("out/mirror.json"))["albedo"].size(), 10u);
  EXPECT_NE(read("out/mirror.svg").find("light from 80 degrees"), std::string::npos);
  EXPECT_EQ(read("out/mirror.png").substr(1, 3), "PNG");
}

TEST_F(BsdfTest, BadInputIsOneLine) {
  expectError(run("bsdf phnog"), 2, {"unknown kind of material", "did you mean 'phong'?"});
  expectError(run("bsdf phong --set powr=3"), 2, {"--set powr=3", "did you mean 'power'?"});
  expectError(run("bsdf phong --set power=-1"), 2, {"--set power=-1", "must be in 0..100000"});
  expectError(run("bsdf phong --set diffuse=0.9"), 2, {"'diffuse' + 'specular' is 1.4"});
  expectError(run("bsdf all --set power=3"), 2, {"--set goes with one kind"});
  write("bad.scene.toml", "base = \"cornell-box\"\n[[assign]]\nto = \"clay\"\n");
  expectError(run("render bad.scene.toml -o x.exr"), 3, {"bad.scene.toml:3:6", "'clay'"});
}

// A scene file is a scene wherever one is named.
TEST_F(BsdfTest, SuitesTakeSceneFiles) {
  write("clay.scene.toml",
        "base = \"cornell-box\"\n[[material]]\nname = \"clay\"\nkind = \"oren_nayar\"\n"
        "[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n");
  std::string suite = kSmallSuite;
  suite.replace(suite.find("cornell-box"), 11, "clay.scene.toml");
  write("suite.toml", suite);
  const ProgramResult result = run("run suite.toml -o results");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(run("info clay.scene.toml").out.find("oren_nayar"), std::string::npos);
}

}  // namespace

}  // namespace restlab::cli_test
