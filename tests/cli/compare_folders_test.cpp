// restlab compare DIR DIR: is the new version better? Pairing, verdicts and output for scripts.
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

using Json = nlohmann::json;

class CompareFoldersTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSmallSuite);
  }
  void runInto(const std::string& folder, const std::string& options = "") const {
    const ProgramResult result = run("run suite.toml -q --out " + folder + " " + options);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  Json compared(const std::string& arguments) const {
    const ProgramResult result = run("compare --json " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return Json::parse(result.out);
  }
  // Writes images as if by another program: the picture plus noise, as rows of this suite.
  void writeNoisy(const std::string& stem, const Image& picture, float noise, float factor) const {
    for (int i = 0; i < 4; ++i) {
      LayeredImage file;
      Image& image = file.layers[""] = picture;
      for (size_t p = 0; p < image.pixels.size(); ++p) {
        const bool isUp = ((p * 2654435761u) >> (i + 8)) % 2 == 0;
        image.pixels[p] += glm::vec3((isUp ? noise : -noise) * (1.0f + factor * float(i)));
      }
      writeExr(path(stem + std::to_string(i) + ".exr"), file);
    }
  }
  static bool hasNote(const Json& comparison, const std::string& text) {
    for (const Json& note : comparison["notes"]) {
      if (note.get<std::string>().find(text) != std::string::npos) return true;
    }
    return false;
  }
};

TEST_F(CompareFoldersTest, MethodByMethod) {
  runInto("a", "--set runs=6");
  runInto("b", "--set runs=6");
  // Same sources and seeds give the same errors, bit for bit.
  const Json same = compared("a b");
  ASSERT_EQ(same["rows"].size(), 2u);
  for (const Json& row : same["rows"]) {
    EXPECT_EQ(row["mse_after_over_before"]["value"], 1.0);
    EXPECT_EQ(row["error"], "the same");
    EXPECT_EQ(row["times_over"], row["method"] == "gi" ? "path" : "");
    EXPECT_NE(row["time"], "worse") << "of one program, however long it took";
    EXPECT_EQ(row["unlike"].size(), 0u);
  }
  // A note may say that times of two hours differ: that is up to the machine.
  for (const char* words : {"made differently", "settings differ", "differ as well"})
    EXPECT_FALSE(hasNote(same, words)) << same["notes"];
  for (const char* side : {"before", "after"}) {
    EXPECT_EQ(same[side]["status"], "finished");
    EXPECT_FALSE(same[side]["git_commit"].get<std::string>().empty());
    EXPECT_FALSE(same[side]["compiler"].get<std::string>().empty());
    EXPECT_FALSE(same[side]["cpu"].get<std::string>().empty());
  }
  runInto("c", "--set scenes=door-ajar");
  const ProgramResult table = run("compare a b");
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_NE(table.out.find("| cornell-box-all | gi |"), std::string::npos) << table.out;
  EXPECT_EQ(table.out.find("- before: a: finished; commit "), 0u) << table.out;
  EXPECT_NE(table.out.find("\n- after: b: finished; commit "), std::string::npos) << table.out;
  expectError(run("compare a c -q"), 3, {"no method of a table in common"});
  expectError(run("compare a -q"), 2, {"two folders"});
  expectError(run("compare a suite.toml -q"), 2, {"--ref"});
}

// Folders with different numbers of runs: the common runs are compared in pairs.
TEST_F(CompareFoldersTest, FewerRunsArePairedWithTheirs) {
  runInto("a", "--set runs=5");
  runInto("b", "--set runs=2");
  const Json pairs = compared("a b");
  for (const Json& row : pairs["rows"]) {
    EXPECT_EQ(row["error"], "the same") << row;
    EXPECT_EQ(row["mse_ratio_is"], "of the 2 runs whose seeds both have");
  }
  EXPECT_TRUE(hasNote(pairs, "ratios of the MSE are of the 2 runs whose seeds both have"))
      << pairs["notes"];
  runInto("c", "--set runs=3 --set seed=4");
  const Json others = compared("a c");  // seeds 1-5 and 4-6
  for (const Json& row : others["rows"]) EXPECT_EQ(row["error"], "not told apart") << row;
  EXPECT_TRUE(hasNote(others, "of runs that are not paired")) << others["notes"];
}

// A single run has no interval.
TEST_F(CompareFoldersTest, NothingKnownIsNotWorse) {
  runInto("a", "--set runs=1");
  runInto("b", "--set runs=1");
  const Json comparison = compared("a b");  // outlives the loop
  for (const Json& row : comparison["rows"]) {
    EXPECT_EQ(row["time_after_over_before"]["lo"], "nan");
    EXPECT_EQ(row["time"], "not judged") << row;
    EXPECT_EQ(row["error"], "the same") << "to the last bit, whatever their interval";
    EXPECT_EQ(row["is_worse"], false);
  }
  EXPECT_EQ(run("compare a b --fail-if-worse").code, 0);
}

// Times of one program are not judged: with few runs, other load or a disturbed machine they may
// look worse, which is no reason to fail.
TEST_F(CompareFoldersTest, TimesOfOneProgramAreNotJudged) {
  runInto("a", "--set runs=5");
  runInto("b", "--set runs=2");
  const ProgramResult table = run("compare a b --fail-if-worse");
  EXPECT_EQ(table.code, 0) << table.out << table.err;
  EXPECT_NE(table.out.find("not judged"), std::string::npos) << table.out;
  const Json comparison = compared("a b");
  for (const Json& row : comparison["rows"]) {
    EXPECT_EQ(row["time"], "not judged") << row;
    EXPECT_NE(row["time_not_judged"], "") << row;
    EXPECT_EQ(row["is_worse"], false);
  }
}

// If the folders have different baselines, times are compared without them.
TEST_F(CompareFoldersTest, BaselinesThatDifferAreSaid) {
  runInto("a");
  runInto("b", "--set baseline=gi");
  const Json comparison = compared("a b");
  EXPECT_TRUE(hasNote(comparison, "the baseline is 'path' before and 'gi' after"))
      << comparison["notes"];
  for (const Json& row : comparison["rows"]) EXPECT_EQ(row["times_over"], "");
}

TEST_F(CompareFoldersTest, BetterAndWorseAreTheExitCodeOfScripts) {
  runInto("a");
  const Image picture = readExr(path("a/images/cornell-box-all-reference.exr")).layers.at("");
  const std::string rows =
      "[[method]]\nname = \"theirs\"\nimage = [\"t0.exr\", \"t1.exr\", \"t2.exr\", "
      "\"t3.exr\"]\ntime_ms = [4.0, 4.1, 4.2, 4.3]\n";
  write("suite.toml", kSmallSuite + rows);
  writeNoisy("t", picture, 0.6f, 0.02f);
  runInto("before", "--set timing=false");
  writeNoisy("t", picture, 1.2f, 0.02f);
  runInto("after", "--set timing=false");
  const ProgramResult worse = run("compare before after --fail-if-worse --json");
  EXPECT_EQ(worse.code, 1) << worse.out;
  ASSERT_EQ(worse.errors().size(), 1u) << worse.err;
  EXPECT_NE(worse.errors()[0].find("cornell-box-all, theirs: the MSE is worse"), std::string::npos);
  const Json row = Json::parse(worse.out)["rows"][2];
  EXPECT_EQ(row["method"], "theirs");
  EXPECT_EQ(row["error"], "worse");
  EXPECT_EQ(row["time"], "not told apart") << "their own, which are the same";
  EXPECT_EQ(row["is_worse"], true);
  EXPECT_NEAR(row["mse_after_over_before"]["value"].get<double>(), 4.0, 0.5);
  EXPECT_EQ(run("compare before after").code, 0) << "nobody asked";
  const ProgramResult better = run("compare after before --fail-if-worse --json");
  EXPECT_EQ(better.code, 0) << better.err;
  EXPECT_EQ(Json::parse(better.out)["rows"][2]["error"], "better");
  // Only the time is worse.
  const std::string text = kSmallSuite + rows;
  write("suite.toml",
        std::string(text).replace(text.find("[4.0, 4.1, 4.2, 4.3]"), 20, "[8.0, 8.1, 8.2, 8.3]"));
  runInto("slow", "--set timing=false");
  const ProgramResult slow = run("compare after slow --fail-if-worse --json");
  EXPECT_EQ(slow.code, 1);
  EXPECT_NE(slow.err.find("theirs: the time is worse"), std::string::npos) << slow.err;
  EXPECT_EQ(Json::parse(slow.out)["rows"][2]["time"], "worse");
  EXPECT_EQ(compared("slow after")["rows"][2]["time"], "better");
}

TEST_F(CompareFoldersTest, UnlikeThingsAreSaid) {
  runInto("a");
  runInto("b", "--set max_bounces=2 --set method.gi.spatial_radius=4 --set frames=3");
  const Json comparison = compared("a b");
  for (const Json& row : comparison["rows"]) {
    EXPECT_EQ(row["error"].get<std::string>().rfind("unlike things: ", 0), 0u) << row;
    EXPECT_EQ(row["time"].get<std::string>().rfind("unlike things: ", 0), 0u) << row;
    EXPECT_EQ(row["unlike"].size(), row["method"] == "gi" ? 3u : 2u) << row;
  }
  EXPECT_TRUE(hasNote(comparison,
                      "cornell-box-all: settings differ: max_bounces 3 / 2, timed_frames 2 / 3"))
      << comparison["notes"];
  EXPECT_TRUE(hasNote(comparison, "cornell-box-all, gi: settings differ: spatial_radius 3 / 4"));
  EXPECT_TRUE(hasNote(comparison, "differ as well: reference (key ")) << comparison["notes"];
  const ProgramResult table = run("compare a b");
  EXPECT_NE(table.out.find("| unlike things: "), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("settings differ: max_bounces 3 / 2"), std::string::npos);
}

TEST_F(CompareFoldersTest, ADifferentReferenceOfTheSamePictureIsNoUnlikeThing) {
  runInto("a");
  runInto("b", "--set seed=11 --set reference.spp=64 --set metrics=[\"mae\"]");
  const Json comparison = compared("a b");
  EXPECT_TRUE(hasNote(comparison, "seeds 1-3 / 11-13")) << comparison["notes"];
  EXPECT_TRUE(hasNote(comparison, ", 32 spp, ")) << comparison["notes"];
  EXPECT_TRUE(hasNote(comparison, ", 64 spp, ")) << comparison["notes"];
  for (const Json& row : comparison["rows"]) {
    EXPECT_EQ(row["unlike"].size(), 0u) << row;
    EXPECT_EQ(row["error"], "not told apart");
  }
  // A reference without metadata.
  LayeredImage file;
  file.layers[""] = readExr(path("a/images/cornell-box-all-reference.exr")).layers.at("");
  writeExr(path("ref.exr"), file);
  const std::string text = kSmallSuite;
  write("suite.toml", std::string(text).replace(text.find("scenes = [\"cornell-box\"]\n"), 25, "") +
                          "[[scene]]\nscene = \"cornell-box\"\nreference = \"ref.exr\"\n");
  runInto("c");
  const Json unknown = compared("a c");
  EXPECT_NE(unknown["rows"][0]["unlike"][0].get<std::string>().find("no key"), std::string::npos)
      << unknown;
}

TEST_F(CompareFoldersTest, UnfinishedFoldersAndOtherBuildsAreSaid) {
  runInto("a");
  runInto("b");
  Json record = Json::parse(read("b/run.json"));
  record["status"] = "interrupted";
  record["devices"][0]["device"] = "another device";
  write("b/run.json", record.dump());
  const Json comparison = compared("a b");
  EXPECT_TRUE(hasNote(comparison, "b: is not finished (interrupted)")) << comparison["notes"];
  EXPECT_TRUE(hasNote(comparison, "made differently: devices cpu: ")) << comparison["notes"];
  EXPECT_EQ(comparison["rows"][0]["unlike"].size(), 0u) << "the same quantity on another device";
  EXPECT_EQ(comparison["after"]["status"], "interrupted");
}

TEST_F(CompareFoldersTest, OptionsWithoutAMeaningAreRefused) {
  runInto("a");
  for (const char* option : {"--max mse=1e-5", "--expect mse<1", "--metrics foo", "--rect 1,2",
                             "--object x", "--without-lights", "--mask m.exr", "--any-reference",
                             "--ppd 60", "--flip-exposures 1,2,3", "--relmse-convention pbrt"}) {
    const std::string text = option;
    const ProgramResult result = run("compare a a -q " + text);
    expectError(result, 2, {text.substr(0, text.find(' ')), "two folders"});
    EXPECT_EQ(result.out, "");
  }
  expectError(run("compare --ref a/images/cornell-box-all-reference.exr "
                  "a/images/cornell-box-all-gi.exr --fail-if-worse -q"),
              2, {"--fail-if-worse", "two folders"});
  EXPECT_NE(run("compare --help").out.find("--fail-if-worse"), std::string::npos);
}

}  // namespace

}  // namespace restlab::cli_test
