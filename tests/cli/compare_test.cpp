// restlab compare: known errors, exit codes, JSON.
#include <algorithm>
#include <limits>

#include "tests/cli/compare_fixture.h"

namespace restlab::cli_test {

namespace {

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
  // (0.8 - 0.6)(0.8 - 0.4); against the mean of the halves it would be 0.09.
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

TEST_F(CompareTest, MaximumIsForScripts) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.4f);
  EXPECT_EQ(run("compare --ref ref.exr a.exr --max mse=0.02 --max mae=0.11").code, 0);
  const ProgramResult above = run("compare --ref ref.exr a.exr ref.exr --max mse=0.02 --max mae=0");
  EXPECT_EQ(above.code, 1);
  ASSERT_EQ(above.errors().size(), 1u) << "a.exr, but not the reference itself";
  EXPECT_NE(above.errors()[0].find("a.exr: mae is 0.1"), std::string::npos) << above.err;
  EXPECT_NE(above.out.find("mae"), std::string::npos) << "a bound's metric is printed";
  // NaN is below no bound.
  writeConstant("black.exr", 0.0f);
  EXPECT_EQ(run("compare --ref black.exr a.exr --max flip_hdr=1").code, 1);
  EXPECT_EQ(run("compare --ref black.exr a.exr --max relmse_mean2=inf").code, 1);
}

TEST_F(CompareTest, RadianceIsReadAsItIs) {
  writeConstant("ref.exr", 40.0f);
  writeConstant("a.exr", 50.0f);
  writeConstant("b.exr", -1.0f);
  const auto result = json("--ref ref.exr a.exr b.exr --metrics mse,max_err");
  EXPECT_NEAR(result["images"][0]["metrics"]["mse"].get<double>(), 100.0, 1e-9);
  EXPECT_NEAR(result["images"][1]["metrics"]["max_err"].get<double>(), 41.0, 1e-9);
}

TEST_F(CompareTest, ConventionsAreInTheNames) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.4f);
  const auto result = json("--ref ref.exr a.exr --relmse-convention pbrt,jeri --metrics mae");
  const auto& values = result["images"][0]["metrics"];
  EXPECT_EQ(values.size(), 3u);
  EXPECT_NEAR(values["relmse_pbrt"].get<double>(), 0.01 / (0.51 * 0.51), 1e-6);
  EXPECT_NEAR(values["relmse_jeri"].get<double>(), 0.01 / 0.2501, 1e-6);
  const ProgramResult list = run("list metrics");
  for (const char* formula : {"relmse_pbrt           mean d^2 / (r + 1e-2)^2", "mean(r)^2",
                              "Andersson et al. 2020", "Wang et al. 2004", "bias_rms"}) {
    EXPECT_NE(list.out.find(formula), std::string::npos) << list.out;
  }
}

// FLIP takes seconds, and is only computed on request.
TEST_F(CompareTest, FlipIsComputedWhenAsked) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.4f);
  EXPECT_EQ(run("compare --ref ref.exr a.exr").out.find("flip"), std::string::npos);
  const auto all = json("--ref ref.exr a.exr --metrics all");
  EXPECT_NEAR(all["images"][0]["metrics"]["flip_ldr"].get<double>(), 0.2155923, 1e-6);
  EXPECT_FALSE(all.contains("runs")) << "nobody said that the images are runs of one method";
  const auto flip = json(
      "--ref ref.exr a.exr --metrics flip_hdr,flip_ldr --ppd 30 "
      "--flip-exposures -1,2,4");
  const std::string detail = flip["images"][0]["details"]["flip_hdr"].get<std::string>();
  for (const char* part : {"30 pixels per degree", "ACES", "4 exposures"}) {
    EXPECT_NE(detail.find(part), std::string::npos) << detail;
  }
  EXPECT_NE(run("compare --ref ref.exr a.exr --metrics flip_ldr").err.find("67.0206 pixels"),
            std::string::npos)
      << "a number of FLIP comes with how it was computed";
}

TEST_F(CompareTest, ReasonOfNanIsSaid) {
  writeConstant("black.exr", 0.0f);
  writeConstant("a.exr", 0.4f);
  const ProgramResult result = run("compare --ref black.exr a.exr --metrics flip_hdr -q");
  EXPECT_NE(result.out.find("nan"), std::string::npos);
  EXPECT_NE(result.err.find("no light"), std::string::npos) << result.err;
}

TEST_F(CompareTest, NonfiniteImageFails) {
  writeConstant("ref.exr", 0.5f);
  LayeredImage image;
  image.layers[""] = Image(8, 8, glm::vec3(0.5f));
  image.layers[""].at(3, 2).y = std::numeric_limits<float>::quiet_NaN();
  writeExr(path("nan.exr"), image);
  const ProgramResult result = run("compare --ref ref.exr nan.exr --json");
  EXPECT_EQ(result.code, 1);
  auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["images"][0]["nonfinite"], 1);
  EXPECT_EQ(json["images"][0]["metrics"]["mse"], "nan") << "never silently skipped";
  EXPECT_NE(json["images"][0]["details"]["mse"].get<std::string>().find("1 non-finite"),
            std::string::npos);
  // A NaN outside the mask does not change the metric, but still fails the image.
  const ProgramResult masked = run("compare --ref ref.exr nan.exr --rect 0,0,3,3 --json");
  EXPECT_EQ(masked.code, 1);
  EXPECT_EQ(nlohmann::json::parse(masked.out)["images"][0]["metrics"]["mse"], 0.0);
}

TEST_F(CompareTest, NonfiniteReferenceFails) {
  writeConstant("a.exr", 0.5f);
  for (const char* layer : {"", "half1"}) {
    writeReferenceWithHalves();
    LayeredImage reference = readExr(path("ref.exr"));
    reference.layers.at(layer).at(3, 2).y = std::numeric_limits<float>::quiet_NaN();
    writeExr(path("ref.exr"), reference);
    const ProgramResult result = run("compare --ref ref.exr a.exr --json");
    EXPECT_EQ(result.code, 1) << layer;
    EXPECT_NE(result.err.find("ref.exr: the reference holds 1 non-finite values"),
              std::string::npos)
        << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out)["reference_nonfinite"], 1);
  }
}

// Equal pixels at another position are different pixels.
TEST_F(CompareTest, AnotherWindowIsExitCode3) {
  writeConstant("ref.exr", 0.5f);
  writeConstant("a.exr", 0.5f);
  LayeredImage shifted = readExr(path("a.exr"));
  shifted.frame.origin = {1, 0};
  writeExr(path("shifted.exr"), shifted);
  expectError(run("compare --ref ref.exr shifted.exr"), 3,
              {"shifted.exr: is 8x8 from pixel (1, 0) on", "ref.exr is 8x8 from pixel (0, 0) on"});
  expectError(run("compare --ref ref.exr a.exr --mask shifted.exr"), 3,
              {"shifted.exr: the mask is 8x8 from pixel (1, 0) on"});
  EXPECT_EQ(run("compare --ref shifted.exr shifted.exr").code, 0);
  shifted.frame.pixelAspectRatio = 2.0f;
  writeExr(path("wide.exr"), shifted);
  const ProgramResult wide = run("compare --ref shifted.exr wide.exr");
  EXPECT_EQ(wide.code, 0);
  EXPECT_NE(wide.err.find("wide.exr: its pixelAspectRatio is 2:"), std::string::npos) << wide.err;
  // An aspect ratio is ignored while no pixel of 8x8 moves by half a pixel; 1.0625 reaches that.
  for (const auto& [ratio, text] :
       {std::pair(1.0000001f, ""), {0.9375f + 1e-6f, ""}, {1.0625f, "is 1.0625:"}}) {
    shifted.frame.pixelAspectRatio = ratio;
    writeExr(path("near.exr"), shifted);
    const std::string said = run("compare --ref shifted.exr near.exr").err;
    EXPECT_EQ(said.find("pixelAspectRatio") == std::string::npos, *text == 0) << said;
    EXPECT_NE(said.find(text), std::string::npos) << said;
  }
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
  expectError(run("compare --ref ref.exr ref.exr --max mse<1"), 2, {"mse<1", "METRIC=VALUE"});
  expectError(run("compare --ref ref.exr ref.exr --max mse=x"), 2, {"'x'"});
  expectError(run("compare --ref ref.exr ref.exr --max msee=1"), 2, {"msee", "'mse'"});
  expectError(run("compare --ref ref.exr ref.exr --relmse-convention tve"), 2, {"'tev'"});
  expectError(run("compare --ref ref.exr ref.exr --ppd 0"), 2, {"--ppd"});
  for (const char* exposures : {"1,2", "1,2,0", "1,2,3.5", "1,2,x", "2,1,3", "1,200,3"}) {
    expectError(run(std::string("compare --ref ref.exr ref.exr --flip-exposures ") + exposures), 2,
                {"xposures"});
  }
  expectError(run("compare --ref absent.exr ref.exr"), 3, {"absent.exr"});
  expectError(run("compare --ref ref.exr absent.exr"), 3, {"absent.exr"});
  expectError(run("compare --ref broken.exr ref.exr"), 3, {"broken.exr"});
  expectError(run("compare ref.exr"), 2, {"--ref"});
  expectError(run("compare --ref ref.exr"), 2, {"images"});
}

}  // namespace

}  // namespace restlab::cli_test
