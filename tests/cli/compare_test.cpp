// restlab compare: known errors, exit codes, JSON.
#include <limits>
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

class CompareTest : public ProgramTest {
 protected:
  void writeConstant(const std::string& name, float value, uint32_t side = 8) const {
    LayeredImage image;
    image.layers[""] = Image(side, side, glm::vec3(value));
    writeExr(path(name), image);
  }
  // A reference of value 0.5 whose halves are 0.5 +- 0.1.
  void writeReferenceWithHalves() const {
    LayeredImage image;
    image.layers[""] = Image(8, 8, glm::vec3(0.5f));
    image.layers["half0"] = Image(8, 8, glm::vec3(0.6f));
    image.layers["half1"] = Image(8, 8, glm::vec3(0.4f));
    writeExr(path("ref.exr"), image);
  }
  nlohmann::json json(const std::string& arguments) const {
    const ProgramResult result = run("compare " + arguments + " --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }
};

TEST_F(CompareTest, KnownErrors) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.4f);
  writeConstant("b.exr", 0.75f);
  const auto result = json("--ref ref.exr a.exr b.exr --metrics mse,relmse_e1e-2,mae,energy_ratio");
  EXPECT_EQ(result["reference_has_halves"], false);
  const auto &a = result["images"][0]["metrics"], &b = result["images"][1]["metrics"];
  EXPECT_NEAR(a["mse"].get<double>(), 0.01, 1e-7);
  EXPECT_NEAR(a["relmse_e1e-2"].get<double>(), 0.01 / 0.26, 1e-6);
  EXPECT_NEAR(a["mae"].get<double>(), 0.1, 1e-7);
  EXPECT_NEAR(a["energy_ratio"].get<double>(), 0.8, 1e-7);
  EXPECT_NEAR(b["mse"].get<double>(), 0.0625, 1e-7);
  EXPECT_EQ(result["images"][1]["file"], "b.exr");
}

TEST_F(CompareTest, HalvesTakeTheReferencesNoiseOut) {
  writeReferenceWithHalves();
  writeConstant("a.exr", 0.8f);
  const auto result = json("--ref ref.exr a.exr --metrics mse");
  // (0.8 - 0.6)(0.8 - 0.4); against the mean it would be 0.09.
  EXPECT_NEAR(result["images"][0]["metrics"]["mse"].get<double>(), 0.08, 1e-6);
  EXPECT_NE(result["images"][0]["details"]["mse"].get<std::string>().find("halves"),
            std::string::npos);
}

TEST_F(CompareTest, ImageAgainstItselfIsZero) {
  writeReferenceWithHalves();
  const auto result = json("--ref ref.exr ref.exr --metrics all");
  for (const char* metric : {"mse", "rmse", "mae", "relmse_e1e-2", "max_err"}) {
    EXPECT_EQ(result["images"][0]["metrics"][metric].get<double>(), 0.0) << metric;
  }
  EXPECT_EQ(result["images"][0]["metrics"]["energy_ratio"].get<double>(), 1.0);
  EXPECT_EQ(result["images"][0]["metrics"]["psnr"], "inf") << "JSON has no infinity";
}

TEST_F(CompareTest, ImageAsReferenceIsSaid) {
  ASSERT_EQ(run("render cornell-box -o image.exr --resolution 16x16").code, 0);
  ASSERT_EQ(run("reference cornell-box -o ref.exr --resolution 16x16 --spp 2").code, 0);
  EXPECT_NE(run("compare --ref image.exr image.exr").err.find("image.exr: is an image, not a"),
            std::string::npos);
  EXPECT_EQ(run("compare --ref ref.exr image.exr").err.find("not a reference"), std::string::npos);
}

TEST_F(CompareTest, TableHasOneRowAnImage) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.4f);
  const ProgramResult result = run("compare --ref ref.exr a.exr ref.exr --metrics mse");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
  EXPECT_EQ(result.out.rfind("image", 0), 0u);
  EXPECT_NE(result.out.find("a.exr"), std::string::npos);
}

TEST_F(CompareTest, BrokenExpectationIsExitCode1) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.4f);
  EXPECT_EQ(run("compare --ref ref.exr a.exr --expect mse<0.02").code, 0);
  EXPECT_EQ(run("compare --ref ref.exr a.exr --expect energy_ratio>=0.7").code, 0);
  const ProgramResult broken = run("compare --ref ref.exr a.exr --expect mse<0.001");
  EXPECT_EQ(broken.code, 1);
  ASSERT_EQ(broken.errors().size(), 1u);
  EXPECT_NE(broken.errors()[0].find("mse<0.001"), std::string::npos);
  EXPECT_NE(broken.out, "") << "the table is printed all the same";
}

TEST_F(CompareTest, NonfiniteImageFails) {
  writeConstant("ref.exr", 0.5f);
  LayeredImage image;
  image.layers[""] = Image(8, 8, glm::vec3(0.5f));
  image.layers[""].at(3, 2).y = std::numeric_limits<float>::quiet_NaN();
  writeExr(path("nan.exr"), image);
  const ProgramResult result = run("compare --ref ref.exr nan.exr --json");
  EXPECT_EQ(result.code, 1);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["images"][0]["nonfinite"], 1);
  EXPECT_EQ(json["images"][0]["metrics"]["mse"], "nan") << "never silently skipped";
}

TEST_F(CompareTest, OtherSizeIsExitCode3) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("small.exr", 0.5f, 4);
  expectError(run("compare --ref ref.exr small.exr"), 3, {"small.exr", "4x4", "ref.exr", "8x8"});
}

TEST_F(CompareTest, ReferenceOfAnotherConfigurationIsExitCode3) {
  const std::string size = " --resolution 16x16 -q ";
  ASSERT_EQ(run("reference cornell-box -o ref.exr --spp 4" + size).code, 0);
  ASSERT_EQ(run("render cornell-box -o same.exr --integrator restir_gi" + size).code, 0);
  ASSERT_EQ(run("render cornell-box -o bounces.exr --max-bounces 2" + size).code, 0);
  ASSERT_EQ(run("render quad-light -o scene.exr" + size).code, 0);
  EXPECT_EQ(run("compare --ref ref.exr same.exr").code, 0);
  expectError(run("compare --ref ref.exr bounces.exr"), 3, {"ref.exr", "max_bounces", "8", "2"});
  expectError(run("compare --ref ref.exr scene.exr"), 3, {"ref.exr", "scene_hash"});
  EXPECT_EQ(run("compare --ref ref.exr bounces.exr --any-reference").code, 0);
}

TEST_F(CompareTest, BadArguments) {
  writeConstant("ref.exr", 0.5f);
  write("broken.exr", read("ref.exr").substr(0, 200));
  expectError(run("compare --ref ref.exr ref.exr --metrics msee"), 2, {"msee", "'mse'"});
  expectError(run("compare --ref ref.exr ref.exr --expect mse=1"), 2, {"mse=1"});
  expectError(run("compare --ref ref.exr ref.exr --expect mse<x"), 2, {"'x'"});
  expectError(run("compare --ref absent.exr ref.exr"), 3, {"absent.exr"});
  expectError(run("compare --ref ref.exr absent.exr"), 3, {"absent.exr"});
  expectError(run("compare --ref broken.exr ref.exr"), 3, {"broken.exr"});
  expectError(run("compare ref.exr"), 2, {"--ref"});
  expectError(run("compare --ref ref.exr"), 2, {"images"});
}

}  // namespace

}  // namespace restlab::cli_test
