// restlab render: contents of the files, equal for any thread count.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

using RenderTest = ProgramTest;

void expectSame(const Image& a, const Image& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  for (size_t i = 0; i < a.pixels.size(); ++i) ASSERT_EQ(a.pixels[i], b.pixels[i]) << "pixel " << i;
}

double meanOf(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels) sum += double(pixel.x) + pixel.y + pixel.z;
  return sum / (3.0 * double(image.pixels.size()));
}

// Warns about filters at the end of float32.
TEST_F(RenderTest, SaysWhereAFilterLeavesItsRange) {
  const auto errOf = [&](const std::string& scene, const std::string& denoiser) {
    const ProgramResult result = run("render " + scene +
                                     " -o a.exr --resolution 8x8 --frames 1 "
                                     "--denoiser " +
                                     denoiser);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.err;
  };
  EXPECT_NE(errOf("furnace?radiance=2^60", "svgf")
                .find("furnace?radiance=2^60: svgf: the mean luminance of what is lit is"),
            std::string::npos);
  EXPECT_EQ(errOf("furnace?radiance=2^60", "none").find("float32"), std::string::npos);
  EXPECT_EQ(errOf("furnace?radiance=2^30", "svgf").find("float32"), std::string::npos);
}

TEST_F(RenderTest, WritesLayersAndMetadata) {
  const ProgramResult result =
      run("render cornell-box -o image.exr --resolution 40x30 --spp 2 --seed 7 --max-bounces 3 "
          "--component indirect --filter center --aov albedo,normalW --png");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "") << "stdout is for data";
  const LayeredImage image = readExr(path("image.exr"));
  ASSERT_EQ(image.layers.count(""), 1u);
  ASSERT_EQ(image.layers.count("albedo"), 1u);
  ASSERT_EQ(image.layers.count("normalW"), 1u);
  EXPECT_EQ(image.layers.at("").width, 40u);
  EXPECT_EQ(image.layers.at("").height, 30u);
  const std::map<std::string, std::string> expected = {
      {"integrator", "path"},    {"seed", "7"},        {"spp", "2"},         {"max_bounces", "3"},
      {"component", "indirect"}, {"filter", "center"}, {"width", "40"},      {"height", "30"},
      {"scene", "cornell-box"},  {"backend", "cpu"},   {"camera_index", "0"}};
  for (const auto& [key, value] : expected) {
    ASSERT_EQ(image.metadata.count(key), 1u) << key;
    EXPECT_EQ(image.metadata.at(key), value) << key;
  }
  for (const char* key : {"scene_hash", "source_hash", "render_time_s", "health", "camera_to_world",
                          "features_left_out"}) {
    EXPECT_EQ(image.metadata.count(key), 1u) << key;
  }
  EXPECT_GT(std::filesystem::file_size(path("image.png")), 100u);
  EXPECT_EQ(read("image.png").substr(1, 3), "PNG");
}

TEST_F(RenderTest, ParametersWithoutEffectAreSaid) {
  const std::string render =
      "render cornell-box -o image.exr --resolution 8x8 --integrator restir_gi ";
  const auto expect = [&](const std::string& settings, const std::string& line) {
    const ProgramResult result = run(render + settings);
    ASSERT_EQ(result.code, 0) << result.err;
    const bool isSaid = result.err.find("has no effect") != std::string::npos;
    EXPECT_EQ(isSaid, !line.empty()) << result.err;
    EXPECT_NE(result.err.find(line), std::string::npos) << result.err;
  };
  expect("--set temporal=false --set confidence_cap=5",
         "warning: --set confidence_cap has no effect: temporal is false");
  expect("--set spatial_neighbours=0 --set young_frames=3",
         "young_frames has no effect: spatial_neighbours is 0");
  expect("--set shading=winner --set max_reflectance_ratio=2",
         "max_reflectance_ratio has no effect: shading is not control_variate");
  expect("--set spatial_neighbours=0 --set spatial_radius=5",
         "spatial_radius has no effect: spatial_neighbours is 0");
  expect("--set temporal=false --set aged_neighbours=2",
         "aged_neighbours has no effect: young_frames is 8, and no history is older than 1");
  expect("--set temporal=false --set spatial_neighbours=0 --set plane_threshold=1",
         "plane_threshold has no effect: temporal is false and spatial_neighbours is 0");
  expect("--set temporal=false --set spatial_radius=5 --set plane_threshold=1", "");
  expect("--set temporal=false --mode biased", "warning: --mode has no effect: temporal is false");
  expect("--set temporal=false --set spatial_neighbours=0 --set max_jacobian=5",
         "max_jacobian has no effect: temporal is false and spatial_neighbours is 0");
  expect("--set temporal=false --set spatial_neighbours=0", "");
  expect("--set confidence_cap=15 --set aged_neighbours=2", "");
}

TEST_F(RenderTest, FirstHitLayersHoldTheSceneThatIsSeen) {
  // A triangle in the plane z = 0, far from the middle of its bounds, that faces the camera at
  // (0.3, 0.3, 2) and fills the left half.
  write("triangle.gltf",
        triangleGltf({-9, -9, 0, 0.3F, -9, 0, 0.3F, 9, 0},
                     R"(, "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0, 1],
                        "metallicFactor": 0})"));
  ASSERT_EQ(run("render triangle.gltf -o x.exr --resolution 16x16 --filter center "
                "--aov radiance,positionW,normalW,albedo,depth,object,emission,motion")
                .code,
            0);
  const LayeredImage image = readExr(path("x.exr"));
  const glm::vec3 zero(0.0F), eye(0.3F, 0.3F, 2.0F);
  for (uint32_t y = 0; y < 16; ++y) {
    for (uint32_t x = 0; x < 16; ++x) {
      const size_t i = size_t(y) * 16 + x;
      const auto layer = [&](const char* name) { return image.layers.at(name).pixels[i]; };
      SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
      EXPECT_EQ(layer("radiance"), image.layers.at("").pixels[i]);
      if (x >= 8) {
        for (const char* name : {"positionW", "normalW", "albedo", "depth", "object", "emission"})
          EXPECT_EQ(layer(name), zero) << name;
        EXPECT_NEAR(glm::length(layer("motion")), 0.0F, 1e-4F);
        continue;
      }
      const glm::vec3 posW = layer("positionW");
      EXPECT_NEAR(posW.z, 0.0F, 1e-5F);
      EXPECT_LT(posW.x, 0.3F);
      EXPECT_NEAR(layer("depth").x, glm::length(posW - eye), 1e-5F);
      EXPECT_NEAR(glm::length(layer("normalW") - glm::vec3(0, 0, 1)), 0.0F, 1e-5F);
      EXPECT_EQ(layer("object"), glm::vec3(1.0F));
      EXPECT_NEAR(glm::length(layer("motion") - glm::vec3(0, 0, layer("depth").x)), 0.0F, 1e-4F);
      // Diffuse colour plus 4 % of specular reflection at normal incidence.
      EXPECT_NEAR(glm::length(layer("albedo") - glm::vec3(0.54F, 0.29F, 0.04F)), 0.0F, 1e-5F);
    }
  }
}

TEST_F(RenderTest, LayersOfTheMethodAndTheirPreviews) {
  const ProgramResult result =
      run("render cornell-box -o x.exr --png --resolution 32x32 --frames 4 --integrator restir_gi "
          "--cache voxel --aov entry,confidence,depth");
  ASSERT_EQ(result.code, 0) << result.err;
  const LayeredImage image = readExr(path("x.exr"));
  float most = 0.0F;
  for (const glm::vec3& c : image.layers.at("confidence").pixels) most = std::max(most, c.x);
  EXPECT_GT(most, 3.5F);
  EXPECT_GT(meanOf(image.layers.at("entry")), 1.0);
  for (const char* name : {"x.png", "x.entry.png", "x.confidence.png", "x.depth.png"})
    EXPECT_EQ(read(name).substr(1, 3), "PNG") << name;
  EXPECT_NE(result.err.find("x.confidence.png: black is "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" samples\n"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("x.entry.png"), std::string::npos) << "names have no range";
}

TEST_F(RenderTest, PreviewGoesWhereItIsTold) {
  ASSERT_EQ(run("render -o a.exr --png=b.png --resolution 8x8 cornell-box").code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("b.png")));
  ASSERT_EQ(run("render -o a.exr --resolution 8x8 --png cornell-box").code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("a.png"))) << "the scene is not the preview's name";
  expectError(run("render cornell-box -o x.exr --png=absent/b.png"), 3, {"absent"});
}

TEST_F(RenderTest, SameSeedSameImageForAnyThreadCount) {
  for (const char* method : {"path", "restir_gi"}) {
    const std::string base = std::string(
                                 "render door-ajar --resolution 48x27 --frames 5 "
                                 "--seed 3 --integrator ") +
                             method;
    ASSERT_EQ(run(base + " -o one.exr -t 1").code, 0);
    ASSERT_EQ(run(base + " -o three.exr --nthreads 3").code, 0);
    ASSERT_EQ(run(base + " -o other.exr --seed 4").code, 2) << "an option given twice";
    const Image one = readExr(path("one.exr")).layers.at("");
    expectSame(one, readExr(path("three.exr")).layers.at(""));
    ASSERT_EQ(run(std::string("render door-ajar --resolution 48x27 --frames 5 --seed 4 "
                              "--integrator ") +
                  method + " -o other.exr")
                  .code,
              0);
    const Image other = readExr(path("other.exr")).layers.at("");
    EXPECT_NE(std::vector<glm::vec3>(one.pixels), std::vector<glm::vec3>(other.pixels));
  }
}

TEST_F(RenderTest, SppIsTheMeanOfFrames) {
  const std::string base = "render cornell-box --resolution 16x16 --seed 5 -q -o ";
  for (int frame = 1; frame <= 3; ++frame) {
    const std::string n = std::to_string(frame);
    ASSERT_EQ(run(base + "frame" + n + ".exr --frames " + n).code, 0);
  }
  ASSERT_EQ(run(base + "mean.exr --spp 3").code, 0);
  const Image mean = readExr(path("mean.exr")).layers.at("");
  std::vector<glm::dvec3> sum(mean.pixels.size(), glm::dvec3(0.0));
  for (int frame = 1; frame <= 3; ++frame) {
    const Image image = readExr(path("frame" + std::to_string(frame) + ".exr")).layers.at("");
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += glm::dvec3(image.pixels[i]);
  }
  for (size_t i = 0; i < sum.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const double expected = sum[i][channel] / 3.0;
      EXPECT_NEAR(mean.pixels[i][channel], expected, 1e-6 * (1.0 + std::abs(expected)));
    }
  }
}

TEST_F(RenderTest, SppOfAMethodWithHistorySaysWhatItIs) {
  const ProgramResult result =
      run("render cornell-box -o image.exr --resolution 16x16 --integrator restir_gi --spp 2");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("mean of 2 consecutive frames of one history"), std::string::npos);
  EXPECT_EQ(readExr(path("image.exr")).metadata.at("warmup_frames"), "32");
}

TEST_F(RenderTest, ZeroBouncesIsEmissionAndComponentsAddUp) {
  const std::string base = "render cornell-box --resolution 32x32 --spp 64 -q ";
  ASSERT_EQ(run(base + "-o direct.exr --component direct").code, 0);
  ASSERT_EQ(run(base + "-o indirect.exr --component indirect").code, 0);
  ASSERT_EQ(run(base + "-o all.exr").code, 0);
  ASSERT_EQ(run(base + "-o none.exr --max-bounces 0").code, 0);
  ASSERT_EQ(run(base + "-o noindirect.exr --max-bounces 1 --component indirect").code, 0);
  const double direct = meanOf(readExr(path("direct.exr")).layers.at(""));
  const double indirect = meanOf(readExr(path("indirect.exr")).layers.at(""));
  const double all = meanOf(readExr(path("all.exr")).layers.at(""));
  EXPECT_NEAR(direct + indirect, all, 0.05 * all);
  EXPECT_GT(indirect, 0.0);
  EXPECT_EQ(meanOf(readExr(path("noindirect.exr")).layers.at("")), 0.0);
  const Image emission = readExr(path("none.exr")).layers.at("");
  size_t black = 0;
  for (const glm::vec3& pixel : emission.pixels) black += pixel == glm::vec3(0.0f) ? 1 : 0;
  EXPECT_GT(black, emission.pixels.size() / 2);
  EXPECT_LT(black, emission.pixels.size());
}

TEST_F(RenderTest, ParametersAndTheGeneralKernelChangeWhatTheySay) {
  const std::string base =
      "render cornell-box --resolution 24x24 --frames 4 --integrator restir_gi -q ";
  ASSERT_EQ(run(base + "-o plain.exr").code, 0);
  ASSERT_EQ(run(base + "-o alone.exr --set spatial_neighbours=0 --set temporal=false").code, 0);
  ASSERT_EQ(run(base + "-o general.exr --kernels general").code, 0);
  const Image plain = readExr(path("plain.exr")).layers.at("");
  EXPECT_NE(plain.pixels, readExr(path("alone.exr")).layers.at("").pixels);
  EXPECT_EQ(readExr(path("alone.exr")).metadata.at("parameter.spatial_neighbours"), "0");
  const LayeredImage general = readExr(path("general.exr"));
  EXPECT_EQ(general.metadata.at("kernel"), "general");
  EXPECT_EQ(general.metadata.at("features_left_out"), "none");
  EXPECT_NE(readExr(path("plain.exr")).metadata.at("features_left_out"), "none");
}

TEST_F(RenderTest, EnvironmentIsRotatedAndScaled) {
  LayeredImage map;
  map.layers[""] = Image(8, 4, glm::vec3(0.5f));
  writeExr(path("sky.exr"), map);
  write("triangle.gltf", triangleGltf({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  ASSERT_EQ(run("render triangle.gltf -o sky-1.exr --environment sky.exr --resolution 8x8 "
                "--environment-scale 2 --environment-rotation -90 --max-bounces 0")
                .code,
            0);
  const LayeredImage image = readExr(path("sky-1.exr"));
  const Image& pixels = image.layers.at("");
  EXPECT_NEAR(pixels.at(0, 0).x, 1.0f, 1e-5f) << "a corner sees the sky, 0.5 times 2";
  EXPECT_EQ(image.metadata.at("environment_rotation"), "-90");
}

TEST_F(RenderTest, PrintsWhatIsKeptOfAPixel) {
  const std::string render =
      "render cornell-box --resolution 24x16 --integrator restir_gi --seed 3 ";
  const ProgramResult text = run(render + "--pixel 5,15 --frame 4");
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.out.rfind("shaded radiance ", 0), 0u) << text.out;
  EXPECT_NE(text.out.find("\nconfidence "), std::string::npos) << text.out;
  // The same frame as in the file.
  const ProgramResult both = run(render + "--pixel 5,15 --frames 4 --json -o image.exr");
  ASSERT_EQ(both.code, 0) << both.err;
  const auto json = nlohmann::json::parse(both.out);
  EXPECT_EQ(json["frame"], 4);
  EXPECT_EQ(json["seed"], 3);
  const glm::vec3 shown = readExr(path("image.exr")).layers.at("").at(5, 15);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(json["values"][0]["value"][size_t(c)], shown[c], 1e-5F * shown[c]);
  std::istringstream lines(text.out);
  std::string line;
  for (const auto& value : json["values"]) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line.rfind(value["name"].get<std::string>() + " ", 0), 0u) << line;
  }
  ASSERT_EQ(json["path"].size(), 2u);
  for (const auto& vertex : json["path"]) {
    ASSERT_TRUE(std::getline(lines, line));
    const std::string begin =
        fmt::format("path {}: {} at ", vertex["name"].get<std::string>(),
                    vertex["reconnected"].get<bool>() ? "reconnected" : "replayed");
    EXPECT_EQ(line.rfind(begin, 0), 0u) << line;
  }
  // Own sample first, then donors over space, last the pixel itself over time.
  ASSERT_GE(json["donors"].size(), 2u);
  EXPECT_EQ(json["donors"].front()["reuse"], "canonical");
  EXPECT_EQ(json["donors"].back()["reuse"], "time");
  for (const auto& donor : json["donors"]) {
    ASSERT_TRUE(std::getline(lines, line));
    const std::string begin =
        fmt::format("donor {} {},{}: {}, confidence ", donor["reuse"].get<std::string>(),
                    donor["x"].dump(), donor["y"].dump(), donor["shift"].get<std::string>());
    EXPECT_EQ(line.rfind(begin, 0), 0u) << line << " for " << begin;
    EXPECT_EQ(line.ends_with(", selected"), donor["selected"].get<bool>()) << line;
    EXPECT_EQ(line.find(", share ") != std::string::npos, donor["share"].is_number()) << line;
  }
  EXPECT_FALSE(std::getline(lines, line)) << line;
}

TEST_F(RenderTest, PixelsThatCannotBePrinted) {
  const std::string render = "render cornell-box --resolution 24x16 ";
  expectError(run(render + "--pixel 24,3"), 2, {"--pixel 24,3", "24x16", "23,15"});
  expectError(run(render + "--pixel 3,16"), 2, {"--pixel 3,16", "24x16"});
  for (const char* pixel : {"3", "3,", ",3", "3,4,5", "3.5,4", "-1,4", "3;4", "99999999999,0"})
    expectError(run(render + "--pixel=" + pixel), 2, {pixel, "X,Y"});
  expectError(run(render + "--pixel 3,4 --spp 8"), 2, {"--pixel", "--spp"});
  expectError(run(render + "--json -o a.exr"), 2, {"--json", "--pixel"});
  expectError(run(render + "--pixel 3,4 --aov depth"), 2, {"--aov", "--output"});
  expectError(run(render + "--pixel 3,4 --png"), 2, {"--png", "--output"});
  expectError(run(render), 2, {"--output is required", "--pixel"});
}

TEST_F(RenderTest, InterruptedRenderWritesNothing) {
  const ProgramResult result = runUntil(
      [] { return true; }, "render door-ajar -o long.exr --resolution 320x180 --spp 100000");
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_EQ(result.errors().size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(path("long.exr")));
}

}  // namespace

}  // namespace restlab::cli_test
