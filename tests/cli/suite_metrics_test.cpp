// restlab run: further metrics and masks of a suite.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSettings = R"(name = "small"
scenes = ["cornell-box"]
[settings]
width = 24
height = 16
max_bounces = 3
warmup_frames = 1
frames = 1
runs = 2
)";
constexpr const char* kRest = R"([reference]
spp = 32
[[method]]
name = "path"
integrator = "path"
)";
constexpr const char* kMasks = R"([[mask]]
name = "left"
rectangle = [0, 0, 12, 16]
[[mask]]
name = "block"
scene = "cornell-box"
objects = ["ShortBlock", "TallBlock"]
without_lights = true
[[mask]]
name = "elsewhere"
scene = "quad-light"
without_lights = true
)";

class SuiteMetricsTest : public ProgramTest {
 protected:
  void writeSuite(const std::string& settings, const std::string& rest) const {
    write("suite.toml", kSettings + settings + kRest + rest);
  }
  // Returns the result of `compare` on the measured image of a run: a mean over runs has no image.
  double compared(const std::string& metric, const std::string& mask) const {
    std::string reference;
    for (const auto& entry : fs::directory_iterator(path("out/references")))
      if (entry.path().filename().string().rfind("cornell", 0) == 0) reference = entry.path();
    const ProgramResult result = run("compare --json --metrics " + metric + " --ref " + reference +
                                     " out/images/cornell-box-all-path.exr " + mask);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out)["images"][0]["metrics"][metric].get<double>();
  }
};

TEST_F(SuiteMetricsTest, AreWhatCompareSays) {
  writeSuite("metrics = [\"flip_ldr\", \"rmse\", \"max_err\"]\n", kMasks);
  const ProgramResult result =
      run("run suite.toml -o out --set scenes=[\"cornell-box\",\"quad-light\"]");
  ASSERT_EQ(result.code, 0) << result.err;
  std::string text = read("out/results.jsonl");
  const auto line = nlohmann::json::parse(text.substr(0, text.find('\n')));
  ASSERT_EQ(line["scene"], "cornell-box");
  ASSERT_EQ(line["run"], 0);
  const auto& figures = line["figures"];
  EXPECT_EQ(figures.size(), 11u) << figures << ": none of the mask of the other scene";
  const auto pixelOf = [&](const char* name) {
    return line["figure_details"][name].get<std::string>();
  };
  EXPECT_NE(pixelOf("max_err").find("at x "), std::string::npos) << pixelOf("max_err");
  EXPECT_EQ(line["figure_details"].count("rmse"), 0u);
  const std::string left = "--rect 0,0,12,16",
                    block = "--object ShortBlock --object TallBlock --without-lights";
  for (const auto& [name, metric, mask] :
       {std::tuple<std::string, std::string, std::string>{"flip_ldr", "flip_ldr", ""},
        {"rmse", "rmse", ""},
        {"mse@left", "mse", left},
        {"rmse@left", "rmse", left},
        {"flip_ldr@left", "flip_ldr", left},
        {"mse@block", "mse", block},
        {"rmse@block", "rmse", block}}) {
    const double expected = compared(metric, mask);
    EXPECT_NEAR(figures.at(name).get<double>(), expected, 1e-9 * std::abs(expected)) << name;
  }

  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("mse@elsewhere"), "nan");
  EXPECT_EQ(rows[1].at("mse@block"), "nan");
  EXPECT_NE(rows[1].at("mse@elsewhere"), "nan");
  EXPECT_LT(std::stod(rows[0].at("flip_ldr_ci_lo")), std::stod(rows[0].at("flip_ldr")));
  const std::string tex = read("out/table.tex");
  EXPECT_NE(tex.find("\nmethod & flip\\_ldr & rmse & max\\_err & mse@left & "), std::string::npos)
      << tex;
  EXPECT_EQ(tex.find("\\textbf"), std::string::npos) << "one row has no best";
  EXPECT_GT(tex.find("@elsewhere"), tex.rfind("@left")) << "in the other scene's alone";
  EXPECT_NE(result.out.find("| method | flip_ldr | rmse | max_err | mse@left |"), std::string::npos)
      << result.out;
  EXPECT_NE(read("out/report.html").find("flip_ldr@left"), std::string::npos);
  const std::string csv = read("out/summary.csv");
  ASSERT_EQ(run("report out").code, 0);
  EXPECT_EQ(read("out/summary.csv"), csv);
}

TEST_F(SuiteMetricsTest, AnotherMaskIsAnotherJob) {
  writeSuite("metrics = [\"rmse\"]\n", "[[mask]]\nname = \"left\"\nrectangle = [0, 0, 12, 16]\n");
  ASSERT_EQ(run("run suite.toml -o out").code, 0);
  const std::string left = parseCsv(read("out/summary.csv"))[0].at("mse@left");
  EXPECT_NE(run("run suite.toml -o out").err.find("2 of 2 runs were there"), std::string::npos);
  writeSuite("metrics = [\"rmse\"]\n", "[[mask]]\nname = \"left\"\nrectangle = [0, 0, 11, 16]\n");
  const ProgramResult other = run("run suite.toml -o out");
  EXPECT_EQ(other.err.find("were there"), std::string::npos) << other.err;
  EXPECT_NE(parseCsv(read("out/summary.csv"))[0].at("mse@left"), left);
}

TEST_F(SuiteMetricsTest, MistakesAreToldBeforeAnythingIsRendered) {
  const auto expect = [&](const std::string& settings, const std::string& rest, int code,
                          const std::vector<std::string>& fragments) {
    writeSuite(settings, rest);
    expectError(run("run suite.toml -o out -q"), code, fragments);
    EXPECT_FALSE(fs::exists(path("out")));
  };
  expect("metrics = [\"flip\"]\n", "", 2, {"suite.toml:10:11", "'flip'", "did you mean"});
  expect("metrics = [\"bias_rms\"]\n", "", 2, {"suite.toml:10:11", "bias_rms", "several runs"});
  expect("metrics = [\"rmse\", \"rmse\"]\n", "", 2, {"suite.toml:10:11", "twice"});
  const std::string mask = "[[mask]]\nname = \"m\"\n";
  expect("", "[[mask]]\nrectangle = [0, 0, 1, 1]\n", 2, {"suite.toml:15:1", "'name'"});
  expect("", mask, 2, {"suite.toml:15:1", "'objects'"});
  expect("", mask + "without_lights = true\n" + mask + "without_lights = true\n", 2,
         {"suite.toml:19:8", "two masks are named 'm'"});
  expect("", mask + "rectangle = [0, 0, 1]\n", 2, {"suite.toml:17:13", "X0, Y0"});
  expect("", mask + "rectangle = [0, 0, 25, 16]\n", 3, {"suite.toml:17:13", "mask 'm'", "<= 24"});
  expect("", mask + "objects = [\"Shortblock\"]\n", 2,
         {"suite.toml:17:11", "mask 'm'", "'ShortBlock'"});
  expect("", mask + "without_lights = true\nscene = \"cornell\"\n", 2,
         {"suite.toml:18:9", "'cornell'", "cornell-box"});
  expect("", mask + "objects = [\"Light\"]\nwithout_lights = true\n", 3,
         {"suite.toml:15:1", "no pixel"});
}

}  // namespace

}  // namespace restlab::cli_test
