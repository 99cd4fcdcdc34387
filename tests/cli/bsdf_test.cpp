// restlab bsdf, and scene files as a user gives them.
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

using BsdfTest = ProgramTest;

// The words of a law's verdict.
std::string verdictOf(const std::string& text, const std::string& law) {
  const auto json = nlohmann::json::parse(text);
  for (const auto& v : json["laws"]) {
    if (v["law"] == law) return v["verdict"];
  }
  return "no such law";
}

TEST_F(BsdfTest, RawPhongBreaksTwoLawsAndTheModifiedOneNone) {
  const ProgramResult raw = run("bsdf phong --json --samples 20000");
  ASSERT_EQ(raw.code, 0) << raw.err;
  EXPECT_EQ(verdictOf(raw.out, "energy"), "broken, as declared");
  EXPECT_EQ(verdictOf(raw.out, "reciprocity"), "broken, as declared");
  EXPECT_EQ(verdictOf(raw.out, "non-negative"), "holds");
  EXPECT_EQ(verdictOf(raw.out, "sampling"), "holds");
  const ProgramResult modified = run("bsdf phong --set model=modified --json --samples 20000");
  ASSERT_EQ(modified.code, 0) << modified.err;
  for (const char* law : {"energy", "reciprocity", "non-negative", "sampling"})
    EXPECT_EQ(verdictOf(modified.out, law), "holds") << law;
}

TEST_F(BsdfTest, WritesFiguresLobesAndABall) {
  const ProgramResult result = run("bsdf mirror -o out --samples 1000 --size 32");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("reciprocity   holds"), std::string::npos) << result.out;
  EXPECT_EQ(nlohmann::json::parse(read("out/mirror.json"))["albedo"].size(), 10u);
  EXPECT_NE(read("out/mirror.svg").find("light from 80 degrees"), std::string::npos);
  EXPECT_EQ(read("out/mirror.png").substr(1, 3), "PNG");
}

TEST_F(BsdfTest, BadInputIsOneLine) {
  expectError(run("bsdf phnog"), 2, {"unknown kind of material", "did you mean 'phong'?"});
  expectError(run("bsdf phong --set powr=3"), 2, {"--set powr=3", "did you mean 'power'?"});
  expectError(run("bsdf phong --set power=-1"), 2, {"--set power=-1", "must be in 0..100000"});
  expectError(run("bsdf phong --set diffuse=0.9"), 2, {"'diffuse' + 'specular' is 1.4"});
  expectError(run("bsdf all --set power=3"), 2, {"--set goes with one kind"});
  write("bad.scene.toml", "base = \"cornell-box\"\n[[assign]]\nto = \"clay\"\n");
  expectError(run("render bad.scene.toml -o x.exr"), 3, {"bad.scene.toml:3:6", "'clay'"});
}

// A BRDF as a table is the BRDF again, within what its cells resolve.
TEST_F(BsdfTest, TabulatesAndReadsBack) {
  const std::string kind = "conductor --set alpha=0.3 --set metal=Cu";
  ASSERT_EQ(run("bsdf " + kind + " --tabulate cu.binary").code, 0);
  ASSERT_EQ(run("bsdf " + kind + " --tabulate cu.exr --angles directions").code, 0);
  const auto albedo = [&](const std::string& material) {
    const ProgramResult result = run("bsdf " + material + " --json --samples 1000");
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out)["albedo"];
  };
  const auto exact = albedo(kind);
  for (const char* file : {"cu.binary", "cu.exr"}) {
    const auto read = albedo(std::string("table --set file=") + file);
    for (const size_t row : {0u, 3u, 5u}) {
      EXPECT_NEAR(read[row]["albedo"][0], exact[row]["albedo"][0].get<double>(), 0.02) << file;
      EXPECT_NEAR(read[row]["albedo"][2], exact[row]["albedo"][2].get<double>(), 0.02) << file;
    }
  }
}

TEST_F(BsdfTest, SimulatesAHeightField) {
  LayeredImage heights;
  heights.layers[""] = Image(8, 8, glm::vec3(1.0F));
  heights.layers[""].at(3, 4).x = 1.5F;
  writeExr(path("heights.exr"), heights);
  const ProgramResult result =
      run("bsdf --simulate heights.exr --albedo 0.5 --sizes 8,8,4 --samples 20000 -o t.exr");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("t.exr: 8 x 8 x 4 values, 20000 rays"), std::string::npos);
  const ProgramResult read = run("bsdf table --set file=t.exr --json --samples 1000");
  ASSERT_EQ(read.code, 0) << read.err;
  EXPECT_NEAR(nlohmann::json::parse(read.out)["albedo"][2]["albedo"][1], 0.5, 0.03);
}

TEST_F(BsdfTest, BadTablesAreOneLine) {
  expectError(run("bsdf"), 2, {"a kind of material expected"});
  expectError(run("bsdf mirror --tabulate m.exr"), 2, {"a smooth mirror", "no table holds that"});
  expectError(run("bsdf dielectric --set alpha=0.3 --tabulate m.exr"), 2, {"light that passes"});
  expectError(run("bsdf conductor --set anisotropic=0.5 --tabulate m.exr"), 2, {"the tangent"});
  expectError(run("bsdf diffuse --tabulate m.txt"), 2, {"--tabulate m.txt", ".binary", ".exr"});
  expectError(run("bsdf diffuse --tabulate m.binary --sizes 8,8,8"), 2, {"90 x 90 x 180"});
  expectError(run("bsdf diffuse --tabulate m.exr --angles directions --sizes 8,9,8"), 2,
              {"equal numbers expected"});
  expectError(run("bsdf diffuse --tabulate m.exr --sizes 4096,4096,4096"), 2, {"cells; at most"});
  write("short.binary", "not a table");
  expectError(run("bsdf table --set file=short.binary"), 3, {"short.binary", "90 90 180 expected"});
  expectError(run("bsdf table --set file=none.binary"), 3, {"none.binary"});
  expectError(run("bsdf mixture --set first=glass"), 3, {"no [[material]] above is named 'glass'"});
  LayeredImage heights;
  heights.layers[""] = Image(1, 1);
  writeExr(path("one.exr"), heights);
  expectError(run("bsdf --simulate one.exr -o t.exr"), 3, {"one.exr", "at least 2x2 heights"});
  expectError(run("bsdf --simulate one.exr -o t.png"), 2, {"-o FILE.exr expected"});
  expectError(run("bsdf phong --simulate one.exr -o t.exr"), 2, {"no kind, --set or --tabulate"});
  expectError(run("bsdf --simulate none.exr -o t.exr"), 3, {"none.exr"});
}

// Ambient light is a layer of its own, and no wall holds it back; what is behind all is seen.
TEST_F(BsdfTest, AmbientLightAndABackground) {
  write("ambient.scene.toml",
        "base = \"sphere-furnace\"\n[environment]\nradiance = 0.0\n[[light]]\nkind = \"ambient\"\n"
        "radiance = [0.1, 0.2, 0.4]\n[background]\nradiance = [0.0, 3.0, 0.0]\n"
        "[[material]]\nname = \"grey\"\nkind = \"diffuse\"\ncolor = 0.5\n"
        "[[assign]]\nmaterial = \"*\"\nto = \"grey\"\n");
  for (const char* integrator : {"path", "restir_di", "restir_gi", "restir_pt"}) {
    const ProgramResult result =
        run(std::string("render ambient.scene.toml -o x.exr --spp 2 --resolution 16x16 ") +
            "--filter center --max-bounces 1 --aov ambient,depth --integrator " + integrator);
    ASSERT_EQ(result.code, 0) << result.err;
    const LayeredImage image = readExr(path("x.exr"), {ExrLayers::all});
    uint32_t seen = 0;
    for (size_t i = 0; i < 256; ++i) {
      const glm::vec3& pixel = image.layers.at("").pixels[i];
      const glm::vec3& ambient = image.layers.at("ambient").pixels[i];
      if (image.layers.at("depth").pixels[i].x == 0.0F) {
        EXPECT_NEAR(pixel.y, 3.0F, 1e-5F) << integrator;
        EXPECT_EQ(pixel.x, 0.0F) << integrator;
        EXPECT_EQ(ambient, glm::vec3(0.0F));
        continue;
      }
      ++seen;
      EXPECT_NEAR(pixel.z, 0.2F, 1e-6F) << integrator;
      EXPECT_NEAR(ambient.z, 0.2F, 1e-6F) << integrator;
    }
    EXPECT_GT(seen, 20u);
    EXPECT_LT(seen, 256u);
  }
}

// A scene file is a scene wherever one is named.
TEST_F(BsdfTest, SuitesTakeSceneFiles) {
  write("clay.scene.toml",
        "base = \"cornell-box\"\n[[material]]\nname = \"clay\"\nkind = \"oren_nayar\"\n"
        "[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n");
  std::string suite = kSmallSuite;
  suite.replace(suite.find("cornell-box"), 11, "clay.scene.toml");
  write("suite.toml", suite);
  const ProgramResult result = run("run suite.toml -o results");
  EXPECT_EQ(result.code, 0) << result.err;
  const ProgramResult info = run("info clay.scene.toml?material.clay.sigma=0.25");
  EXPECT_NE(info.out.find("'White' oren_nayar, color 0.8 0.8 0.8, sigma 0.25, model full"),
            std::string::npos)
      << info.out << info.err;
  // bias and view take a scene file for a scene, not for a suite.
  expectError(run("bias clay.scene.toml --seed 2 --integrator none"), 2,
              {"unknown integrator 'none'"});
  expectError(run("info cornell-box.gltf?x=1"), 3, {"cornell-box.gltf"});
  EXPECT_NE(run("info clay.scene.toml").out.find("oren_nayar"), std::string::npos);
}

// A material that breaks a law renders, and the run says so.
TEST_F(BsdfTest, RunsSayWhichLawsTheirMaterialsBreak) {
  write("raw.scene.toml",
        "base = \"cornell-box\"\n[[material]]\nname = \"old\"\nkind = \"phong\"\n"
        "[[assign]]\nmaterial = \"White\"\nto = \"old\"\n");
  const ProgramResult result = run("render raw.scene.toml -o a.exr --resolution 16x16");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string note = "material 'old' (phong, model = raw) breaks laws of a BSDF";
  EXPECT_NE((result.out + result.err).find(note), std::string::npos) << result.out << result.err;
  const auto info = nlohmann::json::parse(run("info raw.scene.toml --json").out);
  EXPECT_EQ(info["notes"].size(), 1u);
}

}  // namespace

}  // namespace restlab::cli_test
