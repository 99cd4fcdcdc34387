// restlab run -j: runs in parallel, and --json: its events.
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::json;

constexpr const char* kPairSuite = R"(name = "small"
scenes = ["cornell-box"]
[settings]
width = 24
height = 16
max_bounces = 3
warmup_frames = 3
frames = 4
runs = 5
accumulate = true
timing = false
[reference]
spp = 32
[[method]]
name = "path"
integrator = "path"
[[method]]
name = "gi"
integrator = "restir_gi"
)";

class SideBySideTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kPairSuite);
  }
  std::vector<Json> events(const std::string& text) const {
    std::vector<Json> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      all.push_back(Json::parse(line, nullptr, false));
      EXPECT_TRUE(all.back().is_object()) << line;
      EXPECT_TRUE(all.back().contains("event")) << line;
    }
    return all;
  }
  std::vector<std::string> jobs(const std::string& folder) const {
    return Json::parse(read(folder + "/run.json"))["plan"][0]["jobs"];
  }
};

TEST_F(SideBySideTest, GiveTheSameNumbers) {
  const ProgramResult one = run("run suite.toml -o one"),
                      several = run("run suite.toml -o many -j 3");
  ASSERT_EQ(one.code, 0) << one.err;
  ASSERT_EQ(several.code, 0) << several.err;
  EXPECT_EQ(read("many/summary.csv"), read("one/summary.csv"));
  EXPECT_EQ(several.out, one.out);
  ASSERT_EQ(jobs("many"), jobs("one")) << "the same keys in the same order";
  ASSERT_EQ(jobs("many").size(), 5u);
  for (const std::string& key : jobs("many")) {
    for (const char* image : {"method0.exr", "method1.exr"}) {
      EXPECT_EQ(readExr(path("many/jobs/" + key + "/" + image)).layers.at("").pixels,
                readExr(path("one/jobs/" + key + "/" + image)).layers.at("").pixels);
    }
  }
  const auto rows = parseCsv(read("many/summary.csv"));
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("time_ms_median"), "nan");
    EXPECT_EQ(row.at("time_ratio"), "nan");
    EXPECT_EQ(row.at("accumulated_slope"), "nan") << "over time";
    EXPECT_NE(row.at("rays_per_pixel"), "nan");
  }
  EXPECT_NE(rows[1].at("mse_ratio"), "nan");
  EXPECT_EQ(several.out.find("nan"), std::string::npos) << several.out;
  EXPECT_EQ(several.out.find("time per frame"), std::string::npos) << "a column of nothing";
  EXPECT_TRUE(fs::exists(path("many/plots/cornell-box-all-error-frames.svg")));
  EXPECT_FALSE(fs::exists(path("many/plots/cornell-box-all-error-time.svg")));
}

TEST_F(SideBySideTest, TakeWhatIsThereAndGoOnAfterAnInterruption) {
  const std::string more = "run suite.toml -o out -j 2 --set runs=2000";
  const ProgramResult cut = runUntil([&] { return entries("out/jobs").size() > 6; }, more);
  EXPECT_EQ(cut.code, 130) << cut.err;
  const ProgramResult rest = run("run suite.toml -o out -j 2");
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.err.find("5 of 5 runs were there already"), std::string::npos) << rest.err;
  ASSERT_EQ(run("run suite.toml -o one").code, 0);
  EXPECT_EQ(read("out/summary.csv"), read("one/summary.csv"));
  const ProgramResult anew = run("run suite.toml -o out -j 2 --force");
  EXPECT_EQ(anew.code, 0) << anew.err;
  EXPECT_EQ(anew.err.find("were there"), std::string::npos) << anew.err;
}

TEST_F(SideBySideTest, AreRefusedWhereTimesAreMeasured) {
  expectError(run("run suite.toml -o out -q -j 2 --set timing=true"), 2,
              {"-j 2", "times", "timing=false"});
  expectError(run("run suite.toml -o out -q -j 2 --set backend=vulkan"), 2, {"-j 2", "vulkan"});
  EXPECT_FALSE(fs::exists(path("out")));
  EXPECT_EQ(run("run suite.toml -o out -q -j 0").code, 2);
}

TEST_F(SideBySideTest, EventsAreOneObjectALine) {
  const ProgramResult result = run("run suite.toml -o out --json --set timing=true");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto all = events(result.err);
  std::vector<uint32_t> runs;
  for (const Json& event : all) {
    EXPECT_EQ(event["utc"].get<std::string>().size(), 20u);
    if (event["event"] != "run") continue;
    runs.push_back(event["run"]);
    EXPECT_EQ(event["table"], "cornell-box-all");
    EXPECT_EQ(event["job"], jobs("out")[event["run"].get<size_t>()]);
    EXPECT_EQ(event["was_there"], false);
  }
  EXPECT_EQ(runs, (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(all.back()["event"], "finished");
  EXPECT_EQ(all.back()["made"], 5);
  EXPECT_NE(result.out.find("| gi |"), std::string::npos) << "data stay on stdout";

  const auto again = events(run("run suite.toml -o out --json --set timing=true").err);
  size_t there = 0;
  for (const Json& event : again) there += event["event"] == "run" && event["was_there"] == true;
  EXPECT_EQ(there, 5u);

  // Parallel runs have one event each, when they end.
  const auto beside = events(run("run suite.toml -o beside --json -j 2 --set runs=40").err);
  std::set<uint32_t> ended;
  for (const Json& event : beside) {
    if (event["event"] != "run") continue;
    EXPECT_TRUE(ended.insert(event["run"].get<uint32_t>()).second) << event;
    EXPECT_EQ(event["was_there"], false);
  }
  EXPECT_EQ(ended.size(), 40u);

  const ProgramResult wrong = run("run absent.toml --json");
  EXPECT_EQ(wrong.code, 2);
  const auto said = events(wrong.err);
  ASSERT_EQ(said.size(), 1u) << wrong.err;
  EXPECT_EQ(said[0]["event"], "error");
  EXPECT_NE(said[0]["text"].get<std::string>().find("absent.toml"), std::string::npos);

  const ProgramResult cut = runUntil([&] { return isSaid("\"total\":1000000000"); },
                                     "run suite.toml -o cut --json --set reference.spp=1000000000");
  EXPECT_EQ(cut.code, 130);
  bool isProgress = false;
  for (const Json& event : events(cut.err)) {
    if (event["event"] != "progress") continue;
    isProgress = true;
    EXPECT_GT(event["done"].get<uint64_t>(), 0u);
    EXPECT_GT(event["left_s"].get<double>(), 0.0);
  }
  EXPECT_TRUE(isProgress) << cut.err;
}

// Events must come when each run ends, not at the end of the table.
TEST_F(SideBySideTest, EventsOfRunsComeWhenTheyEnd) {
  const ProgramResult cut =
      runUntil([&] { return isSaid("\"suite_total\""); },
               "run suite.toml -o out --json -j 2 --set runs=2000 --set width=96 "
               "--set height=64 --sweep max_bounces=2,3");
  EXPECT_EQ(cut.code, 130);
  size_t ended = 0;
  bool isProgress = false;
  for (const Json& event : events(cut.err)) {
    ended += event["event"] == "run";
    if (event["event"] != "progress" || !event.contains("suite_total")) continue;
    isProgress = true;
    EXPECT_EQ(event["suite_total"], 4000);
    EXPECT_EQ(event["suite_done"], event["done"]) << "of the first table";
    EXPECT_GT(event["suite_left_s"].get<double>(), 0.0);  // its excess over left_s depends on load
  }
  EXPECT_GT(ended, 0u);
  EXPECT_TRUE(isProgress) << cut.err;
}

TEST_F(SideBySideTest, RunsThatAreThereAreNotLeft) {
  ASSERT_EQ(run("run suite.toml -o out -j 2 --set runs=5").code, 0);
  const ProgramResult rest = run("run suite.toml -o out --json -j 2 --set runs=7");
  ASSERT_EQ(rest.code, 0) << rest.err;
  for (const Json& event : events(rest.err)) {
    if (event["event"] != "progress" || !event.contains("suite_total")) continue;
    EXPECT_EQ(event["suite_done"], event["done"]) << event;
    EXPECT_GE(event["suite_done"], 6);
  }
}

}  // namespace

}  // namespace restlab::cli_test
