// restlab run: lights that are switched during histories.
#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

class LightEventsRun : public ProgramTest {};

constexpr const char* kSwitched =
    "[[camera_path]]\nname = \"lamp dimmed\"\nkind = \"still\"\n"
    "[[event]]\nframe = 2\nlight = \"Light\"\nfactor = 0.125\ncamera_path = \"lamp dimmed\"\n";

TEST_F(LightEventsRun, AreMeasuredAgainstTheLightOfTheFrame) {
  write("suite.toml", std::string(kSmallSuite) + kSwitched);
  const std::vector<std::string> words = {
      "run",   "suite.toml",        "--out",   "out",
      "--set", "reference.spp=256", "--sweep", "camera_path=still,lamp dimmed",
      "--set", "ages=[1,2]",        "--set",   "temporal=true"};
  const ProgramResult result = run(words);
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 4u);
  const auto ratio = [&](size_t row) { return std::stod(rows[row].at("energy_ratio")); };
  EXPECT_EQ(rows[2].at("camera_path"), "lamp dimmed");
  EXPECT_EQ(rows[2].at("method"), "path");
  for (const size_t row : {0u, 1u, 2u}) EXPECT_NEAR(ratio(row), 1.0, 0.35) << row;
  EXPECT_GT(ratio(3), 2.0) << "gi holds the light that was";
  EXPECT_EQ(rows[1].at("bias_class"), "unbiased");
  EXPECT_EQ(rows[2].at("bias_class"), "unbiased");
  EXPECT_EQ(rows[3].at("bias_class"), "biased");
  const auto bright = readExr(path("out/images/cornell-box-all-camera_path-still-reference.exr"));
  const auto dim =
      readExr(path("out/images/cornell-box-all-camera_path-lamp-dimmed-reference.exr"));
  EXPECT_EQ(dim.metadata.at("lights"), "Light x0.125 from frame 2");
  EXPECT_NE(dim.metadata.at("scene_hash"), bright.metadata.at("scene_hash"));
  const auto path =
      readExr(this->path("out/images/cornell-box-all-camera_path-lamp-dimmed-path.exr"));
  EXPECT_EQ(path.metadata.at("scene_hash"), dim.metadata.at("scene_hash"));
  double sumBright = 0.0, sumDim = 0.0;
  for (const glm::vec3& pixel : bright.layers.at("").pixels) sumBright += double(pixel.y);
  for (const glm::vec3& pixel : dim.layers.at("").pixels) sumDim += double(pixel.y);
  EXPECT_NEAR(sumDim / sumBright, 0.125, 1e-4) << "the same samples";
  EXPECT_NE(read("out/table.md").find("lights: Light x0.125 from frame 2"), std::string::npos);
  // All runs are found again; after a change of the event only those of the other path are.
  std::vector<std::string> dry = words;
  dry.push_back("--dry-run");
  EXPECT_NE(run(dry).out.find("6 jobs, 6 there"), std::string::npos) << run(dry).out;
  std::string later = std::string(kSmallSuite) + kSwitched;
  later.replace(later.find("frame = 2\nlight"), 9, "frame = 1");
  write("suite.toml", later);
  EXPECT_NE(run(dry).out.find("6 jobs, 3 there"), std::string::npos) << run(dry).out;
}

TEST_F(LightEventsRun, UnknownLightsAreFoundBeforeTheFirstFrame) {
  std::string text = std::string(kSmallSuite) + kSwitched;
  text.replace(text.find("\"Light\""), 7, "\"Lihgt\"");
  write("suite.toml", text);
  const ProgramResult result =
      run({"run", "suite.toml", "--out", "out", "-q", "--set", "camera_path=lamp dimmed"});
  expectError(result, 2, {"suite.toml:22:9", "'Lihgt'", "'Light'"});
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace

}  // namespace restlab::cli_test
