// Markdown of a suite: a method that contradicts its declared class must stand out.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "experiments/certificate/outputs.h"
#include "tests/certificate/made_up_runs.h"

namespace restlab::certificate {
namespace {

constexpr uint32_t kTableSide = 16;

// Makes a certificate of made-up runs, as `certify` would.
Certified planted(const std::string& scene, const std::string& method, const std::string& denoiser,
                  BiasClass declared, const Noise& noise) {
  const Image truth = gradient(kTableSide);
  Certified c;
  c.scene = scene;
  c.method = method;
  c.denoiser = denoiser;
  c.declared = declared;
  c.name = scene + ", " + method + (denoiser == "none" ? "" : ", " + denoiser);
  c.label = "label";
  c.reference = makeReference(truth, 0.002, 2);
  c.reference.spp = 2048;
  const Evidence evidence = makeEvidence(truth, noise, 1, kFewestRuns);
  c.certificate = judgeMadeUp(evidence, noise, truth, c.reference);
  c.mean = evidence.mean();
  return c;
}

const Noise kRight{0.02, 1.0, 1.0}, kWrong{0.1, 1.0, 0.9}, kNoisy{3.0, 1.0, 1.0};

std::vector<Certified> makeSuite() {
  std::vector<Certified> all;
  for (const char* scene : {"one", "two", "three", "four"}) {
    const bool isLast = std::string(scene) == "four";
    all.push_back(planted(scene, "path", "none", BiasClass::unbiased, isLast ? kNoisy : kRight));
    all.push_back(planted(scene, "path", "blur", BiasClass::biased, isLast ? kWrong : kRight));
    if (isLast) all.push_back(planted(scene, "reuse", "none", BiasClass::unbiased, kWrong));
  }
  return all;
}

const std::vector<Certified>& plantedSuite() {
  static const std::vector<Certified> all = makeSuite();
  return all;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string document() { return suiteMarkdownOf(plantedSuite(), Rules(), "restlab bias x.toml"); }

// Returns the lines with this beginning.
std::vector<std::string> linesWith(const std::string& begin) {
  std::vector<std::string> found;
  for (const std::string& line : linesOf(document()))
    if (line.rfind(begin, 0) == 0) found.push_back(line);
  return found;
}

TEST(SuiteTable, CountsVerdictsByWhatIsDeclared) {
  EXPECT_EQ(linesWith("| unbiased |"), std::vector<std::string>{"| unbiased | 3 | 1 | 1 |"});
  EXPECT_EQ(linesWith("| biased |"), std::vector<std::string>{"| biased | 3 | 0 | 1 |"});
  EXPECT_TRUE(linesWith("| consistent |").empty()) << "there is none";
  EXPECT_NE(document().find("`restlab bias x.toml`, 20"), std::string::npos) << document();
  EXPECT_NE(document().find("16x16 pixels, 32 runs a certificate, references of 2048 spp"),
            std::string::npos)
      << document();
}

TEST(SuiteTable, AMethodThatIsNotAsDeclaredStandsOut) {
  // Listed above the tables with the reason, and bold in its cell; a method that is declared biased
  // is neither.
  const std::vector<std::string> said = linesWith("- **");
  ASSERT_EQ(said.size(), 1u) << document();
  EXPECT_EQ(said[0].rfind("- **four, reuse**: luminance of the image by ", 0), 0u) << said[0];
  const std::vector<std::string> wrong = linesWith("| reuse | none | unbiased |");
  ASSERT_EQ(wrong.size(), 1u) << document();
  EXPECT_EQ(wrong[0].rfind("| reuse | none | unbiased | **biased -", 0), 0u) << wrong[0];
  EXPECT_NE(wrong[0].find(", in a cell -"), std::string::npos) << wrong[0];
  const std::vector<std::string> blur = linesWith("| path | blur | biased |");
  ASSERT_EQ(blur.size(), 2u) << document();
  EXPECT_EQ(blur[1].rfind("| path | blur | biased | biased -", 0), 0u) << blur[1];

  std::vector<Certified> right = plantedSuite();
  std::erase_if(right, [](const Certified& c) { return c.method == "reuse"; });
  const std::string text = suiteMarkdownOf(right, Rules(), "x");
  EXPECT_NE(text.find("None that is declared unbiased was found biased."), std::string::npos);
  EXPECT_EQ(text.find("**"), std::string::npos) << text;
}

TEST(SuiteTable, ARowAMethodAndThreeScenesATable) {
  EXPECT_EQ(linesWith("| method |"),
            (std::vector<std::string>{"| method | denoiser | declared | one | two | three |",
                                      "| method | denoiser | declared | four |"}));
  EXPECT_EQ(linesWith("| path | none |").size(), 2u);
  // `reuse` is not in the first three scenes: it has no row there.
  EXPECT_EQ(linesWith("| reuse |").size(), 1u) << document();
  for (const std::string& line : linesOf(document()))
    EXPECT_LE(std::count(line.begin(), line.end(), '|'), 7) << "more than six columns: " << line;
}

// Methods with equal verdicts share a line, as caches and modes render one image in a still view,
// unless their declared classes differ.
TEST(SuiteTable, WhatAgreesSharesALine) {
  std::vector<Certified> all;
  for (const char* method : {"reuse, pixel", "other", "reuse, voxel"})
    all.push_back(planted("one", method, "none", BiasClass::unbiased,
                          method == std::string("other") ? kNoisy : kRight));
  all.push_back(planted("one", "reuse, biased", "none", BiasClass::biased, kRight));
  const std::string text = suiteMarkdownOf(all, Rules(), "x");
  EXPECT_NE(text.find("| reuse, pixel; reuse, voxel | none | unbiased | equivalent "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| reuse, biased | none | biased | equivalent "), std::string::npos) << text;
  EXPECT_NE(text.find("| other | none | unbiased | not decided "), std::string::npos) << text;
}

TEST(SuiteTable, WhatIsNotDecidedSaysHowManyRunsWould) {
  const std::vector<std::string> open = linesWith("| path | none | unbiased | not decided ");
  ASSERT_EQ(open.size(), 1u) << document();
  EXPECT_NE(open[0].find(" more runs |"), std::string::npos) << open[0];
}

// The share of the image that could not be tested is stated.
TEST(SuiteTable, WhatWasNotTestedIsSaid) {
  std::vector<Certified> all = {plantedSuite().front()};
  all[0].certificate.cells.untestableShare = 0.0;
  EXPECT_EQ(suiteMarkdownOf(all, Rules(), "x").find("untested"), std::string::npos);
  all[0].certificate.cells.untestableShare = 0.74;
  const std::string text = suiteMarkdownOf(all, Rules(), "x");
  EXPECT_NE(text.find(", 74 % in untested cells |"), std::string::npos) << text;
}

TEST(SuiteTable, NothingOfNothing) { EXPECT_EQ(suiteMarkdownOf({}, Rules(), "x"), ""); }

}  // namespace
}  // namespace restlab::certificate
