// restlab run: rows of images that another program rendered.
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/image/image.h"
#include "experiments/statistics/intervals.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

class ImageRowTest : public ProgramTest {
 protected:
  // Renders the measured frame of run `run` of "gi", as if by another program.
  void renderRun(uint32_t run_, const std::string& file) const {
    const ProgramResult result =
        run("render cornell-box --resolution 24x16 --max-bounces 3 --frames 4 --integrator "
            "restir_gi --seed " +
            std::to_string(1 + run_) + " -o " + file);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  void writeSuite(const std::string& rows) const { write("suite.toml", kSmallSuite + rows); }
  std::vector<std::map<std::string, std::string>> rows() const {
    return parseCsv(read("out/summary.csv"));
  }
  // Writes an image without the metadata of this program.
  void writeImage(const std::string& name, const Image& image) const {
    LayeredImage file;
    file.layers[""] = image;
    writeExr(path(name), file);
  }
};

double number(const std::map<std::string, std::string>& row, const std::string& column) {
  return std::stod(row.at(column));
}

TEST_F(ImageRowTest, IsMeasuredLikeARun) {
  for (uint32_t r = 0; r < 3; ++r) renderRun(r, "their" + std::to_string(r) + ".exr");
  writeSuite(R"([[method]]
name = "theirs"
image = ["their0.exr", "their1.exr", "their2.exr"]
time_ms = [4.0, 9.0, 5.0]
bias = "unbiased"
)");
  const ProgramResult result = run("run suite.toml -o out");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto all = rows();
  ASSERT_EQ(all.size(), 3u);
  const auto &path = all[0], &gi = all[1], &theirs = all[2];
  for (const char* same : {"mse", "mse_ci_lo", "mse_ci_hi", "relmse_e1e-2", "energy_ratio",
                           "mse_without_lights", "bias_squared", "runs", "mse_ratio"})
    EXPECT_EQ(theirs.at(same), gi.at(same)) << same;
  EXPECT_EQ(theirs.at("integrator"), "image");
  EXPECT_EQ(theirs.at("bias_class"), "unbiased");
  EXPECT_EQ(number(theirs, "time_ms_median"), 5.0);
  EXPECT_NEAR(number(theirs, "time_ratio"), 5.0 / number(path, "time_ms_median"), 1e-6);
  EXPECT_EQ(theirs.at("time_ratio_ci_lo"), "nan") << "nobody measured the spread";
  EXPECT_EQ(theirs.at("rays_per_pixel"), "nan");

  // Images are independent of our runs: compared unpaired.
  std::vector<double> pathMse, theirMse;
  double noise = 0.0;  // of the reference, shared by all runs
  std::istringstream text(read("out/results.jsonl"));
  for (std::string line; std::getline(text, line);) {
    const auto json = nlohmann::json::parse(line);
    noise = json["mse_without_lights_variance_of_halves"];
    if (json["method"] == "path") pathMse.push_back(json["mse_without_lights"]);
    if (json["method"] != "theirs") continue;
    theirMse.push_back(json["mse_without_lights"]);
    EXPECT_EQ(json["kind"], "image");
  }
  ASSERT_EQ(theirMse.size(), 3u);
  const Interval ratio =
      ratioOfPositives(ratioInterval(pathMse, theirMse, {noise, noise, 0.6 * noise}));
  const auto isNear = [](double a, double b) {
    return a == b || std::abs(a - b) <= 1e-6 * std::abs(b);  // an end may be infinite
  };
  EXPECT_TRUE(isNear(number(theirs, "mse_ratio_without_lights_ci_lo"), ratio.lo)) << ratio.lo;
  EXPECT_TRUE(isNear(number(theirs, "mse_ratio_without_lights_ci_hi"), ratio.hi)) << ratio.hi;

  EXPECT_NE(result.out.find("| theirs | 5 ms"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(this->path("out/images/cornell-box-all-theirs.exr")));
  const std::string csv = read("out/summary.csv"), page = read("out/table.md");
  fs::remove(this->path("out/summary.csv"));
  for (const char* image : {"their0.exr", "their1.exr", "their2.exr"})
    fs::remove(this->path(image));
  ASSERT_EQ(run("report out").code, 0);
  EXPECT_EQ(read("out/summary.csv"), csv) << "the folder holds what the rows were made of";
  EXPECT_EQ(read("out/table.md"), page);
  const ProgramResult compared = run("compare out out");
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_NE(compared.out.find("| theirs |"), std::string::npos) << compared.out;
}

TEST_F(ImageRowTest, OneImageHasNoIntervalAndABiasedOneDoesNotCount) {
  renderRun(0, "their.exr");
  writeSuite("[[method]]\nname = \"theirs\"\nimage = \"their.exr\"\n");
  const ProgramResult result = run("run suite.toml -o out");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto row = rows().at(2);
  EXPECT_EQ(row.at("runs"), "1");
  EXPECT_EQ(row.at("time_ms_median"), "nan");
  EXPECT_EQ(row.at("time_ratio"), "nan");
  EXPECT_EQ(row.at("mse_ci_lo"), "nan");
  EXPECT_EQ(row.at("bias_class"), "biased") << "nothing is taken on trust";
  EXPECT_EQ(row.at("counts"), "0");
  EXPECT_NE(row.at("flags").find("its bias is unknown"), std::string::npos);
  EXPECT_NE(result.out.find("| theirs (*) | unknown |"), std::string::npos) << result.out;
}

TEST_F(ImageRowTest, ItsNonFinitePixelsAreCounted) {
  renderRun(0, "good.exr");
  Image image = readExr(path("good.exr")).layers.at("");
  image.pixels[7].y = std::numeric_limits<float>::quiet_NaN();
  writeImage("bad.exr", image);
  writeSuite("[[method]]\nname = \"theirs\"\nimage = \"bad.exr\"\nbias = \"unbiased\"\n");
  ASSERT_EQ(run("run suite.toml -o out").code, 0);
  const auto row = rows().at(2);
  EXPECT_EQ(row.at("nonfinite"), "1");
  EXPECT_EQ(row.at("mse"), "nan");
  EXPECT_EQ(row.at("counts"), "0");
}

TEST_F(ImageRowTest, EverySceneAndComponentHasItsOwnFile) {
  renderRun(0, "a.exr");
  const Image image = readExr(path("a.exr")).layers.at("");
  for (const char* scene : {"cornell-box", "quad-light"}) {
    for (const char* component : {"all", "direct"})
      writeImage(std::string(scene) + "_" + component + ".exr", image);
  }
  writeSuite("[[method]]\nname = \"theirs\"\nimage = \"{scene}_{component}.exr\"\n");
  const std::string two =
      "run suite.toml -o out --set scenes=[\"cornell-box\",\"quad-light\"] "
      "--set components=[\"all\",\"direct\"] --set runs=2";
  const ProgramResult result = run(two);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(rows().size(), 12u);
  writeSuite("[[method]]\nname = \"theirs\"\nimage = \"a.exr\"\n");
  expectError(run(two), 2, {"suite.toml:19:9", "'a.exr'", "2 scenes", "{scene}"});
  writeSuite("[[method]]\nname = \"theirs\"\nimage = \"{scene}_all.exr\"\n");
  expectError(run(two), 2, {"suite.toml:19:9", "2 components", "{component}"});
}

TEST_F(ImageRowTest, ImagesOfTheFolderItselfStay) {
  renderRun(0, "a.exr");
  fs::create_directories(path("out/images"));
  fs::rename(path("a.exr"), path("out/images/a.exr"));
  writeSuite("[[method]]\nname = \"theirs\"\nimage = \"out/images/a.exr\"\n");
  const ProgramResult result = run("run suite.toml -o out");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(fs::exists(path("out/images/a.exr")));
}

TEST_F(ImageRowTest, WrongRowsAreToldBeforeAnythingIsRendered) {
  const auto expect = [&](const std::string& row, int code,
                          const std::vector<std::string>& fragments) {
    writeSuite("[[method]]\n" + row);
    expectError(run("run suite.toml -o out -q"), code, fragments);
    EXPECT_FALSE(fs::exists(path("out")));
  };
  ASSERT_EQ(run("render quad-light --resolution 8x8 -o small.exr").code, 0);
  expect("name = \"x\"\nimage = \"absent.exr\"\n", 3, {"suite.toml:19:9", "absent.exr"});
  expect("name = \"x\"\nimage = \"small.exr\"\n", 3, {"suite.toml:19:9", "8x8", "24x16"});
  expect("image = \"small.exr\"\n", 2, {"suite.toml:17:1", "'name'"});
  expect("name = \"x\"\nimage = []\n", 2, {"suite.toml:19:9", "empty"});
  expect("name = \"x\"\nimage = \"small.exr\"\nmode = \"biased\"\n", 2,
         {"suite.toml:20:8", "mode"});
  expect("name = \"x\"\nimage = \"small.exr\"\ntime_ms = [1, 2]\n", 2,
         {"suite.toml:20:11", "time_ms", "number"});
  expect("name = \"x\"\nimage = \"small.exr\"\ntime_ms = 0\n", 2, {"suite.toml:20:11", "time_ms"});
  writeSuite("[[method]]\nname = \"x\"\nimage = \"small.exr\"\n");
  expectError(run("run suite.toml -o out -q --methods x"), 2, {"--methods x", "rendered"});
  expect("name = \"x\"\nimage = \"small.exr\"\nspatial_radius = 3\n", 2,
         {"suite.toml:20:1", "spatial_radius"});
}

// `compare` rejects such an image, too.
TEST_F(ImageRowTest, IsOfTheSuitesScene) {
  for (const auto& [scene, more, what] :
       {std::tuple("door-ajar", "", "scene_hash"), {"cornell-box", " --filter center", "filter"}}) {
    SCOPED_TRACE(what);
    ASSERT_EQ(run(std::string("render ") + scene +
                  " --resolution 24x16 --max-bounces 3 -o theirs.exr" + more)
                  .code,
              0);
    const std::string row = "[[method]]\nname = \"theirs\"\nimage = [\"theirs.exr\"]\n";
    writeSuite(row);
    expectError(run("run suite.toml -o out"), 3,
                {"suite.toml:19:9: scene cornell-box: the reference is of another configuration: ",
                 what, "theirs.exr", "says nothing of them"});
    const Image image = readExr(path("theirs.exr")).layers.at("");
    writeImage("theirs.exr", image);
    EXPECT_EQ(run("run suite.toml -o out --set runs=1").code, 0);
  }
}

}  // namespace

}  // namespace restlab::cli_test
