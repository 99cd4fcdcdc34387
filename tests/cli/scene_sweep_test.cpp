// restlab run: sweeps of a scene's parameter against known truths.
#include <cmath>
#include <limits>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

// Returns the small suite without its scene; the next line is the 16th.
std::string settings() {
  std::string text = kSmallSuite;
  const std::string scenes = "scenes = [\"cornell-box\"]\n";
  return text.erase(text.find(scenes), scenes.size());
}

class SceneSweepRun : public ProgramTest {
 protected:
  ProgramResult runSuite(const std::string& scenes, const std::string& more = "") const {
    write("suite.toml", settings() + scenes);
    return run("run suite.toml --out out" + more);
  }
  void refused(const std::string& scenes, int code, const std::vector<std::string>& words) const {
    expectError(runSuite(scenes), code, words);
    EXPECT_FALSE(std::filesystem::exists(path("out"))) << scenes;
  }
};

constexpr const char* kFurnaces = R"([[scene]]
name = "albedo"
scene = ["furnace?albedo=0.5", "furnace?albedo=0.9", "furnace?albedo=0.99"]
truth = "exact"
max_bounces = 16
)";

TEST_F(SceneSweepRun, HoldsAgainstTheExactImage) {
  const ProgramResult result = runSuite(kFurnaces);
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string table = read("out/table.md");
  EXPECT_NE(table.find("## albedo, albedo of furnace, all light, 16 scattering events"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| path | 0.99 | "), std::string::npos) << table;
  EXPECT_NE(table.find("| gi | 0.99 | "), std::string::npos) << table;
  EXPECT_NE(result.out.find("| method | last that holds | energy | error |"), std::string::npos)
      << result.out;
  EXPECT_NE(table.find("reference in closed form"), std::string::npos) << table;
  EXPECT_NE(table.find("max_bounces 16, russian_roulette off"), std::string::npos) << table;
  EXPECT_TRUE(std::filesystem::exists(path("out/plots/sweep-1-albedo-all-error.svg")));
  EXPECT_NE(read("out/report.html").find("last albedo that holds"), std::string::npos);
  const auto reference = readExr(path("out/images/albedo-furnace-albedo-0.9-all-reference.exr"));
  const double expected = 0.5 * (1.0 - std::pow(0.9, 17.0)) / 0.1;
  for (const glm::vec3& pixel : reference.layers.at("").pixels)
    ASSERT_NEAR(double(pixel.y) / expected, 1.0, 1e-6);
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 6u);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("max_bounces"), "16");
    EXPECT_NEAR(std::stod(row.at("energy_ratio")), 1.0, 0.1) << row.at("method");
  }
  // Existing runs are found and shown again; a sweep is selected by its name.
  EXPECT_NE(runSuite(kFurnaces, " --dry-run --scenes albedo").out.find("9 jobs, 9 there"),
            std::string::npos);
  EXPECT_NE(runSuite(kFurnaces, " --dry-run").out.find("9 jobs, 9 there"), std::string::npos);
  std::filesystem::remove(path("out/table.md"));
  ASSERT_EQ(run("report out").code, 0);
  EXPECT_EQ(read("out/table.md"), table);
  ASSERT_EQ(run("clean out").code, 0);
  ASSERT_EQ(run("report out").code, 0) << "clean has left what the tables are made of";
}

// Powers of two scale everything to the last bit, errors included.
TEST_F(SceneSweepRun, RelationsChangeNothing) {
  const ProgramResult result = runSuite(
      "[[scene]]\nscene = [\"cornell-box?radiance=1\", \"cornell-box?radiance=2^10\"]\n"
      "truth = \"same\"\n[[scene]]\nscene = [\"cornell-box?scale=1\", \"cornell-box?scale=2^10\"]\n"
      "truth = \"same\"\n");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 8u);
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(rows[2 + m].at("energy_ratio"), rows[m].at("energy_ratio"));
    EXPECT_NEAR(std::stod(rows[2 + m].at("mse")) / std::stod(rows[m].at("mse")), std::exp2(20.0),
                16.0);
    EXPECT_EQ(rows[4 + m].at("mse"), rows[m].at("mse"));
    EXPECT_EQ(rows[6 + m].at("mse"), rows[m].at("mse"));
  }
  EXPECT_NE(read("out/table.md").find("of cornell-box, times 1024, 32 spp"), std::string::npos);
  ASSERT_EQ(run("clean out").code, 0);
  EXPECT_NE(runSuite("[[scene]]\nscene = [\"cornell-box?scale=1\", \"cornell-box?scale=2^10\"]\n"
                     "truth = \"same\"\n",
                     " --dry-run")
                .out.find("6 jobs, 6 there"),
            std::string::npos)
      << "the rendered part of the truth is kept";
}

TEST_F(SceneSweepRun, TruthsThatAreNotThereAreRefused) {
  refused("[[scene]]\nscene = \"cornell-box\"\ntruth = \"exact\"\n", 2,
          {"suite.toml:18:9", "cornell-box has no exact image", "furnace"});
  refused(
      "[[scene]]\nscene = [\"cornell-box?fov=30\", \"cornell-box?fov=40\"]\ntruth = \"exact\"\n", 2,
      {"suite.toml:18:9", "cornell-box?fov=30 has no exact image", "furnace"});
  refused("[[scene]]\nscene = \"quad-light\"\ntruth = \"exact\"\nreference = \"a.exr\"\n", 2,
          {"suite.toml:18:9", "exclude each other"});
  refused("[[scene]]\nscene = \"sphere-furnace\"\ntruth = \"exact\"\nmax_bounces = 0\n", 2,
          {"suite.toml:18:9", "at 0 scattering events"});
  refused("[[scene]]\nscene = \"furnace\"\ntruth = \"exakt\"\n", 2, {"suite.toml:18:9", "exakt"});
  refused("[[scene]]\nscene = [\"furnace?albedo=0.5\", \"cornell-box\"]\n", 2,
          {"suite.toml:17:9", "'cornell-box' is not of furnace"});
  refused("[[scene]]\nscene = [\"furnace?albdo=0.5\"]\n", 3,
          {"suite.toml:17:9", "no parameter 'albdo'", "did you mean 'albedo'?"});
  refused("[[scene]]\nscene = \"furnace\"\nmax_bounces = 2000\n", 2,
          {"suite.toml:18:15", "max_bounces"});
}

TEST_F(SceneSweepRun, ValuesThatAreNotFiniteFailWhereTheSuiteSaysSo) {
  LayeredImage theirs;
  theirs.layers[""] = Image(24, 16, glm::vec3(0.75f));
  theirs.layers[""].pixels[7].y = std::numeric_limits<float>::quiet_NaN();
  writeExr(path("theirs.exr"), theirs);
  const std::string scene =
      "[[scene]]\nscene = \"furnace\"\ntruth = \"exact\"\n"
      "[[method]]\nname = \"theirs\"\nimage = [\"theirs.exr\"]\n";
  EXPECT_EQ(runSuite(scene).code, 0) << "by default the row says it";
  const ProgramResult result = runSuite(scene, " --set fail_on_nonfinite=true");
  EXPECT_EQ(result.code, 1);
  ASSERT_EQ(result.errors().size(), 1u) << result.err;
  EXPECT_NE(result.errors()[0].find("in 1 row, the first of which is theirs in furnace"),
            std::string::npos)
      << result.err;
  EXPECT_TRUE(std::filesystem::exists(path("out/report.html")));
  EXPECT_NE(read("out/run.json").find("\"status\": \"finished\""), std::string::npos);
}

TEST_F(SceneSweepRun, AnEnergyThatIsFarOffFailsWhereTheSuiteSaysSo) {
  for (size_t run = 0; run < 3; ++run) {
    LayeredImage theirs;
    theirs.layers[""] = Image(24, 16, glm::vec3(0.75f + 1e-3f * float(run)));
    writeExr(path("theirs-" + std::to_string(run) + ".exr"), theirs);
  }
  const std::string scene =
      "[[scene]]\nscene = \"furnace\"\ntruth = \"exact\"\n"
      "[[method]]\nname = \"theirs\"\n"
      "image = [\"theirs-0.exr\", \"theirs-1.exr\", \"theirs-2.exr\"]\n";
  EXPECT_EQ(runSuite(scene).code, 0) << "by default the row says it";
  const ProgramResult result = runSuite(scene, " --set fail_on_energy=true");
  EXPECT_EQ(result.code, 1);
  ASSERT_EQ(result.errors().size(), 1u) << result.err;
  EXPECT_NE(result.errors()[0].find("the energy of 1 row is not that of the reference; the first "
                                    "is theirs in furnace, with 0.80"),
            std::string::npos)
      << result.err;
  EXPECT_TRUE(std::filesystem::exists(path("out/report.html")));
}

constexpr const char* kTurning =
    "camera_path = \"turning\"\n"
    "[[camera_path]]\nname = \"turning\"\nkind = \"pan\"\ndegrees_per_frame = 2.0\n";

// The truth uses the camera of the measured frame, and the light times its factor.
TEST_F(SceneSweepRun, TruthsOfAMovingCamera) {
  const std::string scene =
      "[[scene]]\nscene = [\"cornell-box?radiance=1\", \"cornell-box?radiance=2^10\"]\n"
      "truth = \"same\"\n";
  ASSERT_EQ(runSuite(scene).code, 0);
  const auto still = readExr(path("out/images/cornell-box-radiance-1-all-reference.exr"));
  const ProgramResult result = runSuite(scene + kTurning);
  ASSERT_EQ(result.code, 0) << result.err;
  const auto turned = readExr(path("out/images/cornell-box-radiance-1-all-turning-reference.exr"));
  EXPECT_NE(still.layers.at("").pixels, turned.layers.at("").pixels);
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 4u);
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(rows[2 + m].at("energy_ratio"), rows[m].at("energy_ratio"));
    EXPECT_NEAR(std::stod(rows[m].at("energy_ratio")), 1.0, 0.3) << rows[m].at("method");
  }
  // Both views keep their truths.
  size_t plain = 0;
  for (const auto& file : std::filesystem::directory_iterator(path("out/references")))
    plain += file.path().filename().string().find("-plain.exr") != std::string::npos;
  EXPECT_EQ(plain, 2u);
}

TEST_F(SceneSweepRun, WhatATruthOfAMovingCameraIsNotOf) {
  expectError(
      runSuite("[[scene]]\nscene = \"furnace\"\ntruth = \"exact\"\n" + std::string(kTurning),
               " --set temporal=true"),
      2, {"suite.toml:18:9", "is of one frame, but 'temporal' needs a second reference"});
  expectError(runSuite("[[scene]]\nscene = \"furnace?scale=4\"\ntruth = \"exact\"\n" +
                       std::string(kTurning)),
              2, {"suite.toml:18:9", "without 'scale' and 'move'"});
}

// For a scene with its own `runs`, further runs are reported with that key.
TEST_F(SceneSweepRun, FurtherRunsAreTakenWhereTheyAreSaid) {
  const std::string scene = "[[scene]]\nscene = \"furnace\"\ntruth = \"exact\"\nruns = ";
  const ProgramResult first = runSuite(scene + "4\n");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.err.find("1 scene, 2 methods, 4 runs;"), std::string::npos) << first.err;
  const ProgramResult second = runSuite(scene + "2\n");
  EXPECT_NE(second.err.find("furnace-all: not taken, though there: 2 of further runs; runs = 4 in "
                            "its [[scene]] takes them"),
            std::string::npos)
      << second.err;
  EXPECT_NE(runSuite(scene + "1\n").err.find("runs = 1: no interval"), std::string::npos);
}

TEST_F(SceneSweepRun, NamesWithParametersWorkEverywhere) {
  const ProgramResult list = run("list scenes");
  EXPECT_NE(list.out.find("?albedo=0.5 in 0..1: "), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("?scale=1.0 in "), std::string::npos) << list.out;
  EXPECT_NE(run("list scenes --json").out.find("\"name\": \"albedo\""), std::string::npos);
  EXPECT_EQ(run("info furnace?albedo=0.9").code, 0);
  ASSERT_EQ(run("render furnace?albedo=0.75 -o a.exr --resolution 8x8 --max-bounces 0").code, 0);
  const LayeredImage image = readExr(path("a.exr"));
  EXPECT_EQ(image.metadata.at("scene"), "furnace?albedo=0.75");
  ASSERT_EQ(
      run("reference furnace?albedo=0.75 -o r.exr --resolution 8x8 --max-bounces 0 --spp 2").code,
      0);
  EXPECT_EQ(run("compare --ref r.exr a.exr --object block").code, 0) << "its scene is found again";
  expectError(run("render furnace?albedo=2 -o b.exr"), 3, {"albedo is 2", "0..1"});
  expectError(run("render furnase?albedo=1 -o b.exr"), 3, {"did you mean 'furnace'?"});
  expectError(run("run furnace?albedo=0.9"), 2, {"is a scene"});
}

}  // namespace

}  // namespace restlab::cli_test
