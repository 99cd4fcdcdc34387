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
  EXPECT_NE(plain.err.find("max_depth 3 is --max-bounces 2"), std::string::npos) << plain.err;
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

// An image names its scene so that compare finds it again.
TEST_F(MitsubaTest, ImagesFindTheirSceneAgain) {
  const std::string size = " --width 16 --height 16 --spp 2";
  ASSERT_EQ(run("render room.xml -D light=3 --allow-unknown -o a.exr" + size).code, 0);
  const ProgramResult compared = run(std::vector<std::string>{
      "compare", "a.exr", "--ref", "a.exr", "--any-reference", "--object", "rectangle 0"});
  EXPECT_EQ(compared.code, 0) << compared.err;
}

TEST_F(MitsubaTest, ConvertsToGltf) {
  const ProgramResult result = run("convert room.xml --allow-unknown -o out.gltf");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("2 instances"), std::string::npos) << result.out;
  const std::string size = " --width 16 --height 16 --spp 2";
  ASSERT_EQ(run("render out.gltf -o b.exr" + size).code, 0);
  ASSERT_EQ(run("render room.xml --allow-unknown -o a.exr" + size).code, 0);
  const Image a = readExr(path("a.exr")).layers.at(""), b = readExr(path("b.exr")).layers.at("");
  for (size_t i = 0; i < a.pixels.size(); ++i)
    EXPECT_NEAR(glm::length(a.pixels[i] - b.pixels[i]), 0.0f, 1e-4f) << i;
  expectError(run("convert room.xml --allow-unknown -o out.glb"), 2, {"must be named *.gltf"});
  expectError(run("convert nothing.xml -o out.gltf"), 3, {"nothing.xml"});
}

}  // namespace

}  // namespace restlab::cli_test
