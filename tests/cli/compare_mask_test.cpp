// restlab compare with a mask, and over runs of one method.
#include <cmath>

#include "tests/cli/compare_fixture.h"

namespace restlab::cli_test {

namespace {

class CompareMaskTest : public CompareTest {
 protected:
  // Writes 8x8 pixels of 0.5 with one different pixel.
  void writeSpot(const std::string& name, uint32_t x, uint32_t y, float value) const {
    LayeredImage image;
    image.layers[""] = Image(8, 8, glm::vec3(0.5f));
    image.layers[""].at(x, y) = glm::vec3(value);
    writeExr(path(name), image);
  }
  double mse(const std::string& arguments) const {
    return json(arguments)["images"][0]["metrics"]["mse"].get<double>();
  }
};

TEST_F(CompareMaskTest, Rectangles) {
  writeConstant("ref.exr", 0.5f);
  writeSpot("a.exr", 6, 1, 2.5f);
  const std::string base = "--ref ref.exr a.exr ";
  EXPECT_NEAR(mse(base), 4.0 / 64.0, 1e-7);
  EXPECT_NEAR(mse(base + "--rect 6,1,7,2"), 4.0, 1e-6);
  EXPECT_EQ(mse(base + "--rect 1,6,2,7"), 0.0) << "x before y, row 0 on top";
  EXPECT_NEAR(mse(base + "--rect 6,1,7,2 --rect 0,0,3,1"), 1.0, 1e-6) << "united";
  const auto result = json(base + "--rect 6,1,8,3 --metrics mse,ssim,flip_ldr,max_err");
  EXPECT_EQ(result["mask"]["pixels"], 4);
  EXPECT_EQ(result["mask"]["selects"], "--rect 6,1,8,3");
  expectError(run("compare " + base + "--rect 0,0,9,1"), 3, {"0,0,9,1", "8"});
  expectError(run("compare " + base + "--rect 0,0,1"), 2, {"--rect 0,0,1", "X0,Y0,X1,Y1"});
  expectError(run("compare " + base + "--rect 0,0,1,-1"), 2, {"--rect"});
}

TEST_F(CompareMaskTest, FromAFile) {
  writeConstant("ref.exr", 0.5f);
  writeSpot("a.exr", 6, 1, 2.5f);
  LayeredImage mask;
  mask.layers[""] = Image(8, 8);
  mask.layers[""].at(6, 1).y = 1.0f;
  mask.layers[""].at(2, 2).x = -1.0f;
  writeExr(path("mask.exr"), mask);
  EXPECT_NEAR(mse("--ref ref.exr a.exr --mask mask.exr"), 2.0, 1e-6);
  EXPECT_NEAR(mse("--ref ref.exr a.exr --mask mask.exr --rect 4,0,8,8"), 4.0, 1e-6);
  expectError(run("compare --ref ref.exr a.exr --mask mask.exr --rect 7,0,8,8"), 3,
              {"no pixel", "mask.exr"});
  writeConstant("small.exr", 1.0f, 4);
  expectError(run("compare --ref ref.exr a.exr --mask small.exr"), 3, {"small.exr", "4x4", "8x8"});
}

// An option that cannot be applied is an error, not ignored.
TEST_F(CompareMaskTest, ImageWithoutASceneHasNoObjects) {
  writeConstant("ref.exr", 0.5f);
  for (const char* option : {"--object 1", "--without-lights"}) {
    expectError(run(std::string("compare --ref ref.exr ref.exr ") + option), 3,
                {"ref.exr", "scene"});
  }
}

TEST_F(CompareMaskTest, ObjectsAndLightsOfTheScene) {
  const std::string size = " --resolution 32x32 -q ";
  ASSERT_EQ(run("reference cornell-box -o ref.exr --spp 4" + size).code, 0);
  ASSERT_EQ(run("render cornell-box -o a.exr --filter center --aov object" + size).code, 0);
  // The AOV layer and the mask have the same object numbers.
  const LayeredImage image = readExr(path("a.exr"));
  size_t block = 0, light = 0;
  for (const glm::vec3& id : image.layers.at("object").pixels) {
    ASSERT_EQ(id.x, std::floor(id.x));
    ASSERT_GE(id.x, 0.0f);
    ASSERT_LE(id.x, 8.0f);
    ASSERT_EQ(id.x, id.y);
    block += id.x == 6.0f ? 1 : 0;
    light += id.x == 8.0f ? 1 : 0;
  }
  EXPECT_GT(block, 20u);
  EXPECT_GT(light, 1u);
  const std::string base = "--ref ref.exr a.exr --any-reference ";
  const auto byName = json(base + "--object ShortBlock"), byNumber = json(base + "--object 6");
  EXPECT_EQ(byName["mask"]["pixels"], block);
  EXPECT_EQ(byName["images"], byNumber["images"]);
  const auto both = json(base + "--object 6 --object Light");
  EXPECT_EQ(both["mask"]["pixels"], block + light);
  const auto dark = json(base + "--without-lights");
  EXPECT_LT(dark["mask"]["pixels"], 32 * 32 - int(light)) << "edges of the light do not count";
  EXPECT_GT(dark["mask"]["pixels"], 32 * 32 - 4 * int(light) - 20);
  expectError(run("compare " + base + "--object Light --without-lights"), 3, {"no pixel"});
  expectError(run("compare " + base + "--object Shortblock"), 2, {"'ShortBlock'", "1 to 8"});
  expectError(run("compare " + base + "--object 9"), 2, {"1 to 8"});
  expectError(run("compare " + base + "--object 0"), 2, {"1 to 8"});
}

// Also one with settings behind its name and a sky of its own.
TEST_F(CompareMaskTest, SceneFileIsFoundAgain) {
  write("x.scene.toml",
        "base = \"cornell-box\"\n[environment]\nradiance = 1.0\n[[material]]\nname = \"m\"\n"
        "kind = \"diffuse\"\n[[assign]]\nmesh = \"ShortBlock\"\nto = \"m\"\n");
  const std::string scene = "x.scene.toml?material.m.color=0.3";
  ASSERT_EQ(run("render " + scene + " -o a.exr --resolution 32x32 -q").code, 0);
  const auto block = json("--ref a.exr a.exr --any-reference --object ShortBlock");
  EXPECT_GT(block["mask"]["pixels"], 20);
  // The sky of a built-in scene has a name, but no file.
  write("y.scene.toml", "base = \"courtyard\"\n[camera]\nposition = [0.0, 1.0, 0.0]\n");
  ASSERT_EQ(run("render y.scene.toml -o b.exr --resolution 32x32 -q").code, 0);
  EXPECT_EQ(run("compare --ref b.exr b.exr --any-reference --without-lights").code, 0);
}

TEST_F(CompareMaskTest, SceneIsFoundAgainWithItsEnvironment) {
  write("triangle.gltf", triangleGltf({-9, -9, 0, 0.3F, -9, 0, 0.3F, 9, 0}));
  LayeredImage sky;
  sky.layers[""] = Image(8, 4, glm::vec3(0.25f));
  sky.layers[""].at(5, 1) = glm::vec3(9.0f);
  writeExr(path("sky.exr"), sky);
  ASSERT_EQ(
      run("reference triangle.gltf -o ref.exr --spp 2 --resolution 16x16 --environment sky.exr "
          "--environment-rotation 33.3333333 --environment-scale 0.7 -q")
          .code,
      0);
  const auto result = json("--ref ref.exr ref.exr --object 1");
  EXPECT_EQ(result["mask"]["pixels"], 16 * 8) << "the left half";
  expectError(run("compare --ref ref.exr ref.exr --without-lights"), 3, {"no pixel"});
  // Another scene under the same file name is not accepted.
  write("triangle.gltf", triangleGltf({-9, -9, 0, 0.2F, -9, 0, 0.2F, 9, 0}));
  expectError(run("compare --ref ref.exr ref.exr --object 1"), 3, {"ref.exr", "not the scene"});
  std::filesystem::remove(path("triangle.gltf"));
  expectError(run("compare --ref ref.exr ref.exr --object 1"), 3, {"ref.exr", "triangle.gltf"});
}

class CompareRunsTest : public CompareTest {};

TEST_F(CompareRunsTest, BiasIsSignedAndOfAllImages) {
  writeReferenceWithHalves();  // 0.5 +- 0.1
  writeConstant("a.exr", 0.8f);
  writeConstant("b.exr", 0.9f);
  // Average of both orders of the pair: ((0.8 - 0.6)(0.9 - 0.4) + (0.9 - 0.6)(0.8 - 0.4)) / 2.
  const auto biased = json("--ref ref.exr a.exr b.exr --metrics bias_rms,mae");
  EXPECT_EQ(biased["runs"]["count"], 2);
  EXPECT_NEAR(biased["runs"]["squared_bias"].get<double>(), 0.11, 1e-6);
  EXPECT_NEAR(biased["runs"]["metrics"]["bias_rms"].get<double>(), std::sqrt(0.11), 1e-6);
  EXPECT_FALSE(biased["images"][0]["metrics"].contains("bias_rms"));
  // Noise around the truth: 0.8 and 0.2.
  writeConstant("c.exr", 0.2f);
  const auto noise = json("--ref ref.exr a.exr c.exr --metrics bias_rms");
  EXPECT_NEAR(noise["runs"]["squared_bias"].get<double>(), -0.1, 1e-6);
  EXPECT_EQ(noise["runs"]["metrics"]["bias_rms"], 0.0);
  const ProgramResult table = run("compare --ref ref.exr a.exr c.exr --metrics bias_rms");
  EXPECT_NE(table.out.find("squared bias -0.1"), std::string::npos) << table.out;
  EXPECT_EQ(run("compare --ref ref.exr a.exr b.exr --max bias_rms=0.3").code, 1);
  EXPECT_EQ(run("compare --ref ref.exr a.exr b.exr --max bias_rms=0.4").code, 0);
}

TEST_F(CompareRunsTest, RunsAreIndependentAndOfOneMethod) {
  const std::string size = " --resolution 8x8 -q ";
  ASSERT_EQ(run("reference cornell-box -o ref.exr --spp 2" + size).code, 0);
  ASSERT_EQ(run("render cornell-box -o a.exr --seed 1" + size).code, 0);
  ASSERT_EQ(run("render cornell-box -o b.exr --seed 2" + size).code, 0);
  LayeredImage again = readExr(path("a.exr"));
  again.layers.at("").at(3, 3).x += 0.5f;
  writeExr(path("again.exr"), again);
  ASSERT_EQ(run("render cornell-box -o other.exr --seed 3 --integrator restir_gi" + size).code, 0);
  const std::string base = "compare --ref ref.exr --metrics bias_rms a.exr ";
  EXPECT_EQ(run(base + "b.exr").code, 0);
  expectError(run(base), 2, {"bias_rms", "two images"});
  expectError(run(base + "a.exr"), 3, {"a.exr", "pixels"});
  expectError(run(base + "again.exr"), 3, {"again.exr", "the seed 1", "a.exr"});
  expectError(run(base + "other.exr"), 3, {"other.exr", "a.exr"});
  EXPECT_NE(run("compare --ref ref.exr a.exr other.exr --metrics all").out, "");
}

}  // namespace

}  // namespace restlab::cli_test
