// --multiscatter and the suite's key `multiscatter`: their effect and where they are recorded.
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

using MultiscatterTest = ProgramTest;

TEST_F(MultiscatterTest, OfRenderReferenceAndInfo) {
  const std::string scene = " glossy-gallery --resolution 16x9 -q ";
  ASSERT_EQ(run("render" + scene + "-o off.exr").code, 0);
  ASSERT_EQ(run("render" + scene + "-o on.exr --multiscatter").code, 0);
  const LayeredImage off = readExr(path("off.exr")), on = readExr(path("on.exr"));
  EXPECT_EQ(off.metadata.at("multiscatter"), "off");
  EXPECT_EQ(on.metadata.at("multiscatter"), "on");
  EXPECT_NE(on.metadata.at("features_needed").find("multiscatter"), std::string::npos);
  EXPECT_EQ(off.metadata.at("features_needed").find("multiscatter"), std::string::npos);
  EXPECT_NE(off.layers.at("").pixels, on.layers.at("").pixels);

  ASSERT_EQ(run("reference" + scene + "-o plain.exr --spp 2").code, 0);
  ASSERT_EQ(run("reference" + scene + "-o full.exr --spp 2 --multiscatter").code, 0);
  EXPECT_NE(readExr(path("plain.exr")).metadata.at("reference_key"),
            readExr(path("full.exr")).metadata.at("reference_key"));
  EXPECT_EQ(run("compare --ref full.exr on.exr").code, 0);
  expectError(run("compare --ref full.exr off.exr"), 3, {"multiscatter is on, not off"});

  const auto needed = [&](const std::string& arguments) {
    const ProgramResult result = run("info --json " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out)["features_needed"].get<std::string>();
  };
  EXPECT_NE(needed("glossy-gallery --multiscatter").find("multiscatter"), std::string::npos);
  EXPECT_EQ(needed("glossy-gallery").find("multiscatter"), std::string::npos);
  EXPECT_EQ(needed("cornell-box --multiscatter"), "area_lights") << "nothing to compensate";
}

TEST_F(MultiscatterTest, OfASuite) {
  write("suite.toml", R"(scenes = ["glossy-gallery"]

[settings]
width = 16
height = 9
warmup_frames = 0
frames = 1
runs = 2
multiscatter = true

[reference]
spp = 2

[[method]]
integrator = "path"
)");
  ASSERT_EQ(run("run suite.toml --out out -q").code, 0);
  std::istringstream text(read("out/results.jsonl"));
  std::string line;
  ASSERT_TRUE(std::getline(text, line));
  EXPECT_EQ(nlohmann::json::parse(line)["multiscatter"], true);
  EXPECT_NE(read("out/table.md").find("multiscatter on"), std::string::npos);
  EXPECT_EQ(parseCsv(read("out/summary.csv")).at(0).at("multiscatter"), "on");
  ASSERT_EQ(run("render glossy-gallery -q -o again.exr --resolution 16x9 --multiscatter").code, 0);
  EXPECT_EQ(readExr(path("out/images/glossy-gallery-all-path.exr")).layers.at("").pixels,
            readExr(path("again.exr")).layers.at("").pixels);
  const ProgramResult off = run("run suite.toml --out out --set multiscatter=false");
  ASSERT_EQ(off.code, 0) << off.err;
  EXPECT_NE(off.err.find("rendered anew"), std::string::npos) << "the same reference: " << off.err;
  expectError(run("run suite.toml --out out -q --set multiscatter=3"), 2, {"multiscatter"});
}

}  // namespace

}  // namespace restlab::cli_test
