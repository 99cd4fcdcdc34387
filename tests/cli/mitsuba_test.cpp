// Mitsuba's XML as a user gives it: definitions on the command line and in suites, and `convert`.
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

class MitsubaTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("room.xml", R"(<scene version="3.0.0">
<default name="light" value="2"/>
<integrator type="path"><integer name="max_depth" value="3"/></integrator>
<sensor type="perspective"><float name="fov" value="40"/>
<transform name="to_world"><lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform></sensor>
<shape type="rectangle"><emitter type="area"><rgb name="radiance" value="$light"/></emitter></shape>
<shape type="cube"><bsdf type="velvet"/><transform name="to_world"><translate x="3"/></transform></shape>
</scene>)");
  }
  glm::vec3 middleOf(const std::string& file) {
    const Image image = readExr(path(file)).layers.at("");
    return image.at(image.width / 2, image.height / 2);
  }
};

TEST_F(MitsubaTest, DefinitionsStandBehindTheName) {
  expectError(run("render room.xml -o a.exr"), 3,
              {"room.xml:7:20", "'velvet' is unknown", "--allow-unknown"});
  const std::string size = " --width 16 --height 16 --spp 1";
  const ProgramResult plain = run("render room.xml -o a.exr --allow-unknown" + size);
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_NE(plain.err.find("drawn as mid grey"), std::string::npos) << plain.err;
  EXPECT_NE(plain.err.find("its paths have 2 bounces, unless --max-bounces says otherwise"),
            std::string::npos)
      << plain.err;
  const ProgramResult bright =
      run("render room.xml --define light=5 --allow-unknown -o b.exr" + size);
  ASSERT_EQ(bright.code, 0) << bright.err;
  EXPECT_FLOAT_EQ(middleOf("a.exr").x, 2.0f);
  EXPECT_FLOAT_EQ(middleOf("b.exr").x, 5.0f);
  const ProgramResult info = run("info room.xml?light=5&allow_unknown=1 --json");
  ASSERT_EQ(info.code, 0) << info.err;
  const auto json = nlohmann::json::parse(info.out);
  EXPECT_EQ(json["scene"], "room?light=5&allow_unknown=1");
  EXPECT_EQ(json["emissive_triangles"], 2);
  expectError(run("info room.xml --define light"), 2, {"--define light"});
  expectError(run("info room.xml -D lihgt=5"), 3, {"'lihgt'", "did you mean 'light'?"});
}

// A scene with a film of 18 x 12 pixels and paths of 3 segments.
constexpr const char* kOwnSettings = R"(<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="3"/></integrator>
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="18"/>
<integer name="height" value="12"/></film></sensor>
<shape type="sphere"><point name="center" x="0" y="0" z="3"/>
<bsdf type="diffuse"><rgb name="reflectance" value="0.25 0.5 0.75"/></bsdf></shape>
<emitter type="constant"/>
</scene>)";

TEST_F(MitsubaTest, FilmAndIntegratorAreTakenUnlessTheUserSaysOtherwise) {
  write("own.xml", kOwnSettings);
  const auto metadataOf = [&](const std::string& options) {
    const ProgramResult result = run("render own.xml -o own.exr --spp 1" + options);
    EXPECT_EQ(result.code, 0) << result.err;
    const auto words = readExr(path("own.exr")).metadata;
    return words.at("width") + "x" + words.at("height") + " " + words.at("max_bounces");
  };
  EXPECT_EQ(metadataOf(""), "18x12 2");
  EXPECT_EQ(metadataOf(" --width 9"), "9x6 2");
  EXPECT_EQ(metadataOf(" --resolution 20x10 --max-bounces 5"), "20x10 5");
  const ProgramResult info = run("info own.xml");
  EXPECT_NE(info.out.find("a film of 18x12 pixels"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("max_bounces  2 unless given"), std::string::npos) << info.out;
  const auto json = nlohmann::json::parse(run("info own.xml --json").out);
  EXPECT_EQ(json["max_bounces"], 2);
  EXPECT_EQ(json["cameras"][0]["film_pixels"], nlohmann::json({18, 12}));
}

// Results keep the bounces that the scene had, also where its file is gone.
TEST_F(MitsubaTest, SuitesTakeThemToo) {
  write("own.xml", kOwnSettings);
  const auto suite = [](const std::string& settings) {
    return "scenes = [\"own.xml\"]\n[settings]\nframes = 1\nruns = 2\nwarmup_frames = 0\n" +
           settings + "[reference]\nspp = 4\n[[method]]\nname = \"path\"\n";
  };
  const auto table = [&](const std::string& name, const std::string& settings) {
    write(name + ".toml", suite(settings));
    const ProgramResult result = run("run " + name + ".toml --out " + name);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out + read(name + "/run.json");
  };
  const std::string own = table("own", ""), given = table("given", "max_bounces = 4\nwidth = 9\n");
  EXPECT_NE(own.find("18x12"), std::string::npos) << own;
  EXPECT_NE(own.find("max_bounces 2"), std::string::npos) << own;
  EXPECT_NE(given.find("9x6"), std::string::npos) << given;
  EXPECT_NE(given.find("max_bounces 4"), std::string::npos) << given;
  std::filesystem::remove(path("own.xml"));
  const std::string kept = read("own/suite.toml");
  EXPECT_NE(kept.find("[scene_bounces]"), std::string::npos) << kept;
  const ProgramResult report = run("report own");
  EXPECT_EQ(report.code, 0) << report.err;
}

// Each material of a scene by name, to be edited.
TEST_F(MitsubaTest, ConvertsToASceneFile) {
  write("own.xml", kOwnSettings);
  ASSERT_EQ(run("convert own.xml -o o.gltf").code, 0);
  const ProgramResult result = run("convert o.gltf -o named.scene.toml");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("1 materials, 0 more in comments"), std::string::npos) << result.out;
  const std::string text = read("named.scene.toml");
  EXPECT_NE(text.find("base = \"o.gltf\""), std::string::npos) << text;
  EXPECT_NE(text.find("kind = \"diffuse\"\ncolor = [0.25, 0.5, 0.75]"), std::string::npos) << text;
  const std::string size = " --width 16 --height 16 --spp 2";
  ASSERT_EQ(run("render o.gltf -o a.exr" + size).code, 0);
  ASSERT_EQ(run("render named.scene.toml -o b.exr" + size).code, 0);
  const Image a = readExr(path("a.exr")).layers.at(""), b = readExr(path("b.exr")).layers.at("");
  for (size_t i = 0; i < a.pixels.size(); ++i) EXPECT_EQ(a.pixels[i], b.pixels[i]) << i;
}

// An image names its scene so that compare finds it again.
TEST_F(MitsubaTest, ImagesFindTheirSceneAgain) {
  const std::string size = " --width 16 --height 16 --spp 2";
  ASSERT_EQ(run("render room.xml -D light=3 --allow-unknown -o a.exr" + size).code, 0);
  const ProgramResult compared = run(std::vector<std::string>{
      "compare", "a.exr", "--ref", "a.exr", "--any-reference", "--object", "rectangle 0"});
  EXPECT_EQ(compared.code, 0) << compared.err;
}

// Settings behind the name do not hide which file it is.
TEST_F(MitsubaTest, ConvertDoesNotWriteOverItsScene) {
  const std::string text = "base = \"cornell-box\"\n";
  write("box.scene.toml", text);
  expectError(run("convert box.scene.toml?camera.yfov=60 -o box.scene.toml"), 2,
              {"box.scene.toml", "is the same file as the scene"});
  write("second.scene.toml", "base = \"box.scene.toml\"\n");
  expectError(run("convert second.scene.toml -o box.scene.toml"), 2,
              {"box.scene.toml", "is a file that the scene is made from"});
  EXPECT_EQ(read("box.scene.toml"), text);
}

TEST_F(MitsubaTest, ConvertsToGltf) {
  const ProgramResult result = run("convert room.xml --allow-unknown -o out.gltf");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("2 instances"), std::string::npos) << result.out;
  const std::string size = " --width 16 --height 16 --spp 2 --max-bounces 2";
  ASSERT_EQ(run("render out.gltf -o b.exr" + size).code, 0);
  ASSERT_EQ(run("render room.xml --allow-unknown -o a.exr" + size).code, 0);
  const Image a = readExr(path("a.exr")).layers.at(""), b = readExr(path("b.exr")).layers.at("");
  for (size_t i = 0; i < a.pixels.size(); ++i)
    EXPECT_NEAR(glm::length(a.pixels[i] - b.pixels[i]), 0.0f, 1e-4f) << i;
  expectError(run("convert room.xml --allow-unknown -o out.glb"), 2,
              {"must be named *.gltf, or *.scene.toml"});
  expectError(run("convert nothing.xml -o out.gltf"), 3, {"nothing.xml"});
}

}  // namespace

}  // namespace restlab::cli_test
