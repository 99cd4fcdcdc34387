// Sweeps and includes: resulting suites and methods, and places of errors.
#include "experiments/runner/suite/sweep.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "experiments/runner/suite/suite.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

using Names = std::vector<std::string>;

constexpr const char* kBase = R"(scenes = ["cornell-box"]
[settings]
width = 8
runs = 2
[[method]]
name = "path"
[[method]]
name = "gi"
integrator = "restir_gi"
[[method]]
integrator = "restir_gi"
)";

class SweepTest : public TemporaryFolder {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name) << text;
    return folder() / name;
  }
  std::vector<Suite> load(const std::string& text, const Names& overrides = {},
                          const Names& sweeps = {}) const {
    return loadSuites(write("suite.toml", text), overrides, sweeps);
  }
  std::string errorOf(const std::string& text, const Names& overrides = {},
                      const Names& sweeps = {}) const {
    try {
      load(text, overrides, sweeps);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      std::string message = error.what();
      const size_t at = message.find(folder().string() + "/");
      return at == std::string::npos ? message : message.substr(folder().string().size() + 1);
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }
  static Names names(const Suite& suite) {
    Names all;
    for (const SuiteMethod& method : suite.methods) all.push_back(method.name);
    return all;
  }
  static Names points(const std::vector<Suite>& suites) {
    Names all;
    for (const Suite& suite : suites) all.push_back(suite.point);
    return all;
  }
};

TEST_F(SweepTest, SettingsMakePoints) {
  const auto suites =
      load(std::string(kBase) + "[sweep]\nmax_bounces = [2, 4]\nwidth = [8, 16, 32]\n");
  EXPECT_EQ(points(suites), (Names{"max_bounces=2, width=8", "max_bounces=2, width=16",
                                   "max_bounces=2, width=32", "max_bounces=4, width=8",
                                   "max_bounces=4, width=16", "max_bounces=4, width=32"}));
  EXPECT_EQ(suites[5].maxBounces, 4u);
  EXPECT_EQ(suites[5].width, 32u);
  EXPECT_EQ(suites[5].runs, 2u);
  EXPECT_EQ(names(suites[5]), (Names{"path", "gi", "restir_gi (unbiased)"}));
  EXPECT_EQ(points(load(kBase)), Names{""});
  EXPECT_EQ(points(load(kBase, {}, {"seed=1,3,5"})), (Names{"seed=1", "seed=3", "seed=5"}));
  EXPECT_EQ(points(load(kBase, {}, {"filter=box,center"})), (Names{"filter=box", "filter=center"}));
  EXPECT_THROW(loadSuite(write("s.toml", std::string(kBase) + "[sweep]\nruns = [2, 3]\n"), {}),
               Error);
}

TEST_F(SweepTest, MethodKeysMakeMethods) {
  const auto suites = load(kBase, {}, {"confidence_cap=4.0,8.0"});
  ASSERT_EQ(suites.size(), 1u);
  EXPECT_EQ(names(suites[0]), (Names{"path", "gi, confidence_cap=4.0", "gi, confidence_cap=8.0",
                                     "restir_gi (unbiased), confidence_cap=4.0",
                                     "restir_gi (unbiased), confidence_cap=8.0"}));
  EXPECT_EQ(std::get<double>(suites[0].methods[2].session.parameters.at("confidence_cap")), 8.0);
  EXPECT_EQ(
      names(load(kBase, {}, {"method.gi.confidence_cap=4.0,8.0"})[0]),
      (Names{"path", "gi, confidence_cap=4.0", "gi, confidence_cap=8.0", "restir_gi (unbiased)"}));
  EXPECT_EQ(names(load(kBase, {}, {"mode=biased,unbiased"})[0]),
            (Names{"path", "gi, mode=biased", "gi, mode=unbiased", "restir_gi (biased)",
                   "restir_gi (unbiased)"}))
      << "path has one mode: it is not meant";
  EXPECT_EQ(
      names(load(kBase, {}, {"backend=cpu,vulkan", "method.gi.kernels=general,exact"})[0]),
      (Names{"path @cpu", "path @vulkan", "gi, kernels=general @cpu", "gi, kernels=exact @cpu",
             "gi, kernels=general @vulkan", "gi, kernels=exact @vulkan",
             "restir_gi (unbiased) @cpu", "restir_gi (unbiased) @vulkan"}));
  EXPECT_EQ(load(kBase, {"sweep.max_bounces=[1,2]"}).size(), 2u);
}

// A size from the command or a sweep replaces that of the file, in either notation.
TEST_F(SweepTest, ASizeReplacesThatOfTheFile) {
  const Suite set = load(kBase, {"resolution=16x9"}).at(0);
  EXPECT_EQ(std::pair(set.width, set.height), std::pair(16u, 9u));
  EXPECT_EQ(load(set.resolved).at(0).width, 16u) << "suite.toml of the results can be read";
  const std::vector<Suite> swept = load(kBase, {}, {"resolution=8x4,16x8"});
  ASSERT_EQ(swept.size(), 2u);
  EXPECT_EQ(std::pair(swept[1].width, swept[1].height), std::pair(16u, 8u));
  std::string text = kBase;
  text.replace(text.find("width = 8"), 9, "resolution = \"8x6\"");
  const Suite side = load(text, {"width=12"}).at(0);
  EXPECT_EQ(std::pair(side.width, side.height), std::pair(12u, 0u)) << "the camera's shape";
  EXPECT_EQ(load(side.resolved).at(0).width, 12u);
  EXPECT_NE(errorOf(std::string(kBase).replace(text.find("resolution"), 9,
                                               "width = 8\nresolution = \"8x6\"")),
            "");
}

TEST_F(SweepTest, ErrorsNameThePlace) {
  const std::string base = kBase;
  EXPECT_EQ(errorOf(base + "[sweep]\nmax_bounce = [1]\n"),
            "suite.toml:13:14: neither a setting nor something of a method in the suite: "
            "'max_bounce'; did you mean 'max_bounces'?");
  EXPECT_EQ(errorOf(base + "[sweep]\nmax_bounces = []\n"),
            "suite.toml:13:15: 'max_bounces' has no values");
  EXPECT_EQ(errorOf(base + "[sweep]\nmax_bounces = [1, 1]\n"),
            "suite.toml:13:15: 'max_bounces' has a value twice");
  EXPECT_EQ(errorOf(base + "[sweep]\nmax_bounces = [1, -1]\n"),
            "suite.toml:13:15: 'max_bounces' must be in 0..1024, not -1");
  EXPECT_NE(errorOf(base, {}, {"method.gy.confidence_cap=1"}).find("did you mean 'gi'"),
            std::string::npos);
  EXPECT_NE(errorOf(base, {}, {"runs"}).find("--sweep runs: must be KEY=VALUE"), std::string::npos);
  EXPECT_NE(errorOf(base, {}, {"runs=3..1"}).find("--sweep runs: 3..1"), std::string::npos);
  EXPECT_EQ(errorOf(base, {}, {"seed=1..3"}),
            "--sweep seed: seeds 1 and 2 have runs in common, as run r has the seed 'seed' + r; "
            "leave at least 2 between them");
  EXPECT_NE(errorOf(base, {"resolution=8x8", "width=4"}).find("exclude each other"),
            std::string::npos);
  EXPECT_NE(errorOf(base, {}, {"runs=1,,2"}).find("empty value"), std::string::npos);
}

// --set of a swept key is refused: the sweep would replace it.
TEST_F(SweepTest, WhatIsSweptIsNotSet) {
  const std::string swept = std::string(kBase) +
                            "[sweep]\nmax_bounces = [2, 4]\n"
                            "\"method.gi.spatial_radius\" = [4.0, 8.0]\n";
  EXPECT_EQ(
      errorOf(swept, {"method.gi.spatial_radius=12"}),
      "suite.toml:14:30: the values of this sweep replace that of --set "
      "method.gi.spatial_radius; --sweep method.gi.spatial_radius=VALUE gives it a single one");
  for (const char* set : {"max_bounces=8", "settings.max_bounces=8"})
    EXPECT_NE(errorOf(swept, {set}).find("--sweep max_bounces=VALUE"), std::string::npos) << set;
  const std::string all = std::string(kBase) + "[sweep]\n\"method.spatial_radius\" = [4.0, 8.0]\n";
  EXPECT_NE(errorOf(all, {"method.gi.spatial_radius=12"}).find("--sweep method.spatial_radius"),
            std::string::npos);
  const std::string backends = std::string(kBase) + "[sweep]\nbackend = [\"cpu\", \"vulkan\"]\n";
  EXPECT_NE(errorOf(backends, {"backend=vulkan"}).find("--sweep backend=VALUE"), std::string::npos);
  // Allowed: keys of another method, or of methods that the sweep leaves out.
  EXPECT_EQ(load(swept, {"method.spatial_radius=12", "method.restir_gi.spatial_radius=3"}).size(),
            2u);
}

TEST_F(SweepTest, IncludesAreMergedAndKeepTheirPlaces) {
  write("parts/base.toml", kBase);
  write("parts/more.toml", "include = \"base.toml\"\n[settings]\nruns = 5\nmax_bounces = 3\n");
  const auto suites = load(
      "include = [\"parts/more.toml\"]\nname = \"top\"\n[settings]\nmax_bounces = 7\n"
      "[[method]]\nname = \"third\"\n");
  ASSERT_EQ(suites.size(), 1u);
  EXPECT_EQ(suites[0].name, "top");
  EXPECT_EQ(suites[0].runs, 5u) << "the later file wins";
  EXPECT_EQ(suites[0].maxBounces, 7u) << "the including file wins";
  EXPECT_EQ(suites[0].width, 8u);
  EXPECT_EQ(names(suites[0]), (Names{"path", "gi", "restir_gi (unbiased)", "third"}));
  // The resolved text gives the same suite.
  const auto again = load(suites[0].resolved);
  EXPECT_EQ(again[0].maxBounces, 7u);
  EXPECT_EQ(names(again[0]), names(suites[0]));

  write("parts/more.toml", "[settings]\nruns = \"many\"\n");
  EXPECT_EQ(errorOf("include = \"parts/more.toml\"\nscenes = [\"cornell-box\"]\n[[method]]\n"),
            "parts/more.toml:2:8: 'runs' must be an integer, not a string");
  write("parts/more.toml", "include = \"../suite.toml\"\n");
  EXPECT_NE(errorOf("include = \"parts/more.toml\"\n").find("parts/more.toml:1:11"),
            std::string::npos);
  EXPECT_NE(errorOf("include = \"absent.toml\"\n").find("absent.toml: no such file"),
            std::string::npos);
  EXPECT_EQ(errorOf("include = 3\n"), "suite.toml:1:11: 'include' must hold names of files");
}

TEST_F(SweepTest, EndlessSweepsAreRefused) {
  std::string axes;
  for (const char* key : {"max_bounces", "width", "height", "warmup_frames"}) {
    axes += std::string(key) + " = [";
    for (int i = 1; i <= 30; ++i) axes += std::to_string(i) + ", ";
    axes += "]\n";
  }
  const std::string error = errorOf(std::string(kBase) + "[sweep]\n" + axes);
  EXPECT_NE(error.find("'height'"), std::string::npos) << error;  // 30^3 is more than 2000
  EXPECT_NE(error.find("more than 2000 combinations"), std::string::npos) << error;
}

TEST_F(SweepTest, IncludesThatDoubleAreRefused) {
  // 2^30 readings of the last file.
  for (int i = 0; i < 30; ++i) {
    const std::string next = std::to_string(i + 1) + ".toml";
    write(std::to_string(i) + ".toml", "include = [\"" + next + "\", \"" + next + "\"]\n");
  }
  write("30.toml", "");
  const std::string error = errorOf("include = \"0.toml\"\n" + std::string(kBase));
  EXPECT_NE(error.find("more than 100 files are included"), std::string::npos) << error;
}

}  // namespace

}  // namespace restlab
