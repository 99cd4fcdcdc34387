// --variant: the materials of a variant of a glTF file, wherever a scene is named.
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

class VariantsTest : public ProgramTest {
 protected:
  // A red triangle, which is blue in the variant "night".
  void SetUp() override {
    ProgramTest::SetUp();
    auto document = nlohmann::json::parse(triangleGltf({-9, -9, 0, 9, -9, 0, 0, 9, 0}));
    document["extensionsUsed"] = {"KHR_materials_variants"};
    document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
    document["materials"][0]["emissiveFactor"] = {1, 0, 0};
    document["materials"].push_back({{"doubleSided", true}, {"emissiveFactor", {0, 0, 1}}});
    document["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
    write("x.gltf", document.dump());
  }

  glm::vec3 colorOf(const std::string& file) const {
    return readExr(path(file)).layers.at("").at(4, 4);
  }
};

TEST_F(VariantsTest, EveryCommandTakesThem) {
  const std::string size = " --resolution 8x8 --spp 1";
  ASSERT_EQ(run("render x.gltf -o plain.exr" + size).code, 0);
  ASSERT_EQ(run("render x.gltf -o option.exr --variant night" + size).code, 0);
  ASSERT_EQ(run("render x.gltf?variant=night -o name.exr" + size).code, 0);
  EXPECT_EQ(colorOf("plain.exr"), glm::vec3(1, 0, 0));
  EXPECT_EQ(colorOf("option.exr"), glm::vec3(0, 0, 1));
  EXPECT_EQ(colorOf("name.exr"), glm::vec3(0, 0, 1));
  // The image says which variant it shows, so that its scene is found again.
  EXPECT_EQ(run("compare --ref option.exr name.exr --object 1").code, 0);
  expectError(run("render x.gltf -o x.exr --variant nigth"), 3, {"x.gltf", "'nigth'", "'night'"});
  expectError(run("render cornell-box -o x.exr --variant night"), 3, {"cornell-box", "variant"});
}

TEST_F(VariantsTest, InfoListsThem) {
  const auto plain = nlohmann::json::parse(run("info x.gltf --json").out);
  const auto night = nlohmann::json::parse(run("info x.gltf --json --variant night").out);
  EXPECT_EQ(plain["variants"], nlohmann::json::array({"night"}));
  EXPECT_TRUE(plain["variant"].is_null());
  EXPECT_EQ(night["variant"], "night");
  EXPECT_NE(plain["content_hash"], night["content_hash"]) << "they have references of their own";
  EXPECT_NE(run("info x.gltf --variant night").out.find("variant      'night', drawn"),
            std::string::npos);
}

TEST_F(VariantsTest, SuitesSetThemSideBySide) {
  write("s.toml",
        "scenes = ['x.gltf', 'x.gltf?variant=night']\n[settings]\nwidth = 4\nheight = 4\n"
        "runs = 2\nframes = 1\n[reference]\nspp = 2\n[[method]]\nintegrator = 'path'\n");
  ASSERT_EQ(run("run s.toml -o out --set timing=false").code, 0);
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NE(rows[0].at("scene").find("x"), std::string::npos);
  EXPECT_EQ(rows[1].at("scene"), "x?variant=night");
}

}  // namespace

}  // namespace restlab::cli_test
