// restlab run: ratios relative to a method that the suite names, and methods selected by name.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/statistics/intervals.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

class BaselineTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", suite());
  }
  static std::string suite() {
    return std::string(kSmallSuite) + "[sweep]\n\"method.gi.spatial_radius\" = [4.0, 8.0]\n";
  }
  std::vector<std::map<std::string, std::string>> rows() const {
    return parseCsv(read("out/summary.csv"));
  }
};

// With fewer runs than exist the tables lose some of them, which must be reported.
TEST_F(BaselineTest, FewerRunsThanThereAreIsSaid) {
  ASSERT_EQ(run("run suite.toml -o out --set runs=5").code, 0);
  const ProgramResult result = run("run suite.toml -o out");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(
      result.err.find("cornell-box-all: not taken, though there: 2 of further runs; --set runs=5 "),
      std::string::npos)
      << result.err;
  const ProgramResult whole = run("run suite.toml -o out --set runs=5");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.err.find("not taken"), std::string::npos) << whole.err;
}

TEST_F(BaselineTest, CountsTheRunsThatAreThereAnew) {
  ASSERT_EQ(run("run suite.toml -o out").code, 0);
  std::vector<double> four, eight;
  double noise = 0.0;  // of the reference, shared by all runs
  std::istringstream text(read("out/results.jsonl"));
  for (std::string line; std::getline(text, line);) {
    const auto json = nlohmann::json::parse(line);
    noise = json["mse_without_lights_variance_of_halves"];
    if (json["method"] == "gi, spatial_radius=4.0") four.push_back(json["mse_without_lights"]);
    if (json["method"] == "gi, spatial_radius=8.0") eight.push_back(json["mse_without_lights"]);
  }
  const ProgramResult result =
      run({"run", "suite.toml", "-o", "out", "--set", "baseline=gi, spatial_radius=4.0"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("3 of 3 runs were there"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("| than gi, spatial_radius=4.0 |"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("than path"), std::string::npos) << result.out;
  EXPECT_NE(read("out/table.tex").find("against gi, spatial\\_radius=4.0"), std::string::npos);
  EXPECT_NE(read("out/report.html").find("MSE of gi, spatial_radius=4.0 / MSE"), std::string::npos);
  const auto all = rows();
  ASSERT_EQ(all.size(), 3u);
  for (const auto& row : all) EXPECT_EQ(row.at("baseline"), "gi, spatial_radius=4.0");
  EXPECT_EQ(std::stod(all[1].at("mse_ratio_without_lights")), 1.0);
  EXPECT_EQ(std::stod(all[1].at("time_ratio")), 1.0);
  // Paired by seed.
  const Interval ratio = pairedRatioInterval(four, eight, {noise, noise, 0.6 * noise});
  const auto near = [](double value) { return 1e-6 * std::abs(value); };
  EXPECT_NEAR(std::stod(all[2].at("mse_ratio_without_lights")), ratio.value, near(ratio.value));
  EXPECT_NEAR(std::stod(all[2].at("mse_ratio_without_lights_ci_lo")), ratio.lo, near(ratio.lo));
  EXPECT_NEAR(std::stod(all[2].at("mse_ratio_without_lights_ci_hi")), ratio.hi, near(ratio.hi));
  EXPECT_LT(std::stod(all[0].at("mse_ratio_without_lights")), 1.0) << "path is the worse one";
  EXPECT_NE(read("out/report.html").find("--set &#39;baseline=gi, spatial_radius=4.0&#39;"),
            std::string::npos)
      << "a command that can be pasted";
  const std::string csv = read("out/summary.csv");
  ASSERT_EQ(run("report out").code, 0);
  EXPECT_EQ(read("out/summary.csv"), csv);
}

TEST_F(BaselineTest, MustBeThere) {
  expectError(run("run suite.toml -o out -q --set baseline=gi"), 2,
              {"--set baseline", "'gi'", "'gi, spatial_radius=4.0'"});
  expectError(run("run suite.toml -o out -q --set baseline=path --methods gi"), 2,
              {"--methods", "'path'", "baseline"});
  EXPECT_FALSE(fs::exists(path("out")));
}

// The baseline may be named with another notation of a number, and without the backend.
TEST_F(BaselineTest, IsFollowedWhereItsNameIsWrittenOtherwise) {
  ASSERT_EQ(
      run({"run", "suite.toml", "-o", "out", "-q", "--set", "baseline=gi, spatial_radius=8"}).code,
      0);
  EXPECT_EQ(rows().at(0).at("baseline"), "gi, spatial_radius=8.0");
}

TEST_F(BaselineTest, MethodsAreChosenByAnyOfTheirNames) {
  ASSERT_EQ(run("run suite.toml -o out -q --methods path,gi").code, 0);
  EXPECT_EQ(rows().size(), 3u);
  ASSERT_EQ(
      run({"run", "suite.toml", "-o", "out", "-q", "--methods", "gi, spatial_radius=8.0"}).code, 0);
  ASSERT_EQ(rows().size(), 1u);
  EXPECT_EQ(rows()[0].at("method"), "gi, spatial_radius=8.0");
  expectError(run("run suite.toml -o out -q --methods g"), 2, {"'gi, spatial_radius=4.0'"});
}

TEST_F(BaselineTest, ABlackReferenceIsSaid) {
  std::string text = suite();
  text.replace(text.find("runs = 3"), 8, "runs = 2\ncamera_path = \"away\"");
  write("suite.toml",
        text + "[[camera_path]]\nname = \"away\"\nkind = \"pan\"\ndegrees_per_frame = 60\n");
  const ProgramResult result = run("run suite.toml -o out");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("warning: cornell-box-all-away: its reference is black"),
            std::string::npos)
      << result.err;
  EXPECT_NE(read("out/table.md").find("its reference is black"), std::string::npos);
}

TEST_F(BaselineTest, ComparisonNotesTheLoadAndWhatIsTheSame) {
  ASSERT_EQ(run("run suite.toml -o out -q").code, 0);
  fs::copy(path("out"), path("busy"), fs::copy_options::recursive);
  auto record = nlohmann::ordered_json::parse(read("busy/run.json"));
  record["machine"]["load_1min"] = 57.0;
  write("busy/run.json", record.dump());
  const ProgramResult result = run("compare out busy");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("and 57.0 on"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("| 1 [1, 1] | the same |"), std::string::npos) << result.out;
  expectError(run("compare out absent"), 3, {"absent", "no such file or folder"});
}

}  // namespace

}  // namespace restlab::cli_test
