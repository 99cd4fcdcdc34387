// restlab bias: verdicts, files, continuing, and errors.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/image/image.h"

#include <algorithm>
#include "tests/cli/program.h"

namespace restlab::cli_test {
namespace {

using Json = nlohmann::json;

class BiasTest : public ProgramTest {
 protected:
  // One bounce from a lamp to a floor: little noise, and an exact image.
  const std::string small_ = "bias quad-light --resolution 16x16 --max-bounces 1 -o out";
};

TEST_F(BiasTest, PathIsEquivalentAndGoesOnWhereItWas) {
  const ProgramResult first = run(small_ + " --runs 40 --frames 32");
  ASSERT_EQ(first.code, 0) << first.err << first.out;
  EXPECT_EQ(first.out.rfind("quad-light, path: equivalent", 0), 0u) << first.out;
  EXPECT_NE(first.out.find("luminance  bias "), std::string::npos) << first.out;
  for (const char* part : {"smallest that is found ", "MSE of a run ", "bias^2 ",
                           "cells: ", "not finite: 0 values of the images, 0 of samples; health: "})
    EXPECT_NE(first.out.find(part), std::string::npos) << part << "\n" << first.out;
  for (const char* file : {"out/report.html", "out/certificates.json", "out/certificates.md"})
    EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
  const std::string page = read("out/report.html");
  for (const char* part : {"<li>MSE of a run ", "<li>cells: ", "<li>not finite: 0 values"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(entries("out/runs").size(), 1u);
  const std::string folder = "out/runs/" + entries("out/runs").at(0).filename().string();
  EXPECT_EQ(entries(folder).size(), 40u);
  const auto untouched = std::filesystem::last_write_time(entries(folder).at(0));

  const ProgramResult more = run(small_ + " --runs 48 --frames 32 --json");
  ASSERT_EQ(more.code, 0) << more.err;
  EXPECT_EQ(entries(folder).size(), 48u);
  EXPECT_EQ(std::filesystem::last_write_time(entries(folder).at(0)), untouched);
  const Json document = Json::parse(more.out);
  EXPECT_EQ(document.at("verdict"), "equivalent");
  EXPECT_EQ(document.at("runs"), 48);
  EXPECT_EQ(document.at("image").size(), 4u);
  EXPECT_EQ(document.at("nonfinite"), 0);

  // The map is the difference of the images beside it.
  const std::string name = "out/maps/" + document.at("label").get<std::string>() + "-bias";
  EXPECT_TRUE(std::filesystem::exists(path(name + ".png")));
  const LayeredImage map = readExr(path(name + ".exr"));
  const Image &difference = map.layers.at(""), &mean = map.layers.at("mean"),
              &reference = map.layers.at("reference"), &p = map.layers.at("p_value");
  for (size_t i = 0; i < difference.pixels.size(); ++i) {
    EXPECT_EQ(difference.pixels[i], mean.pixels[i] - reference.pixels[i]) << name;
  }
  // Each pixel has the p-value of its cell's luminance.
  size_t cells = 0;
  for (const Json& cell : document.at("cells")) {
    if (cell.at("quantity") != "luminance" || cell.at("whole_image") || !cell.at("tested"))
      continue;
    ++cells;
    const uint32_t x = 2 * cell.at("x").get<uint32_t>(), y = 2 * cell.at("y").get<uint32_t>();
    EXPECT_EQ(p.at(x, y).x, float(cell.at("p_value").get<double>())) << x << " " << y;
  }
  EXPECT_GT(cells, 1u) << "blocks are of 2x2 pixels";
}

// Runs rendered in parallel or in two calls equal runs rendered one by one.
TEST_F(BiasTest, RunsDoNotDependOnHowTheyAreMade) {
  const int code = run(small_ + " --runs 32 -j 1 --json -q").code;
  const Json one = Json::parse(read("out/certificates.json")).at("certificates").at(0);
  std::filesystem::remove_all(path("out/runs"));
  EXPECT_EQ(run(small_ + " --runs 32 -j 4 --json -q").code, code);
  EXPECT_LE(code, 1);
  EXPECT_EQ(Json::parse(read("out/certificates.json")).at("certificates").at(0), one);
}

TEST_F(BiasTest, AWrongWeightIsBiasedWithItsSize) {
  const std::string box = "bias cornell-box --integrator restir_gi --resolution 24x24 -o out ";
  const ProgramResult wrong =
      run(box + "--set mis=confidence --runs 128 --warmup 4 --frames 4 --json");
  ASSERT_EQ(wrong.code, 1) << wrong.err << wrong.out;
  const Json document = Json::parse(wrong.out);
  EXPECT_EQ(document.at("verdict"), "biased") << document.at("reason");
  EXPECT_GT(document.at("confirmed").get<int>(), 0);
  EXPECT_LT(document.at("image").at(0).at("relative_bias").at("hi").get<double>(), 0.0);
  EXPECT_GT(document.at("squared_bias").at("lo").get<double>(), 0.0);
  const std::string replay = document.at("replay");
  EXPECT_NE(replay.find("--set mis=confidence"), std::string::npos) << replay;
  // The replay is a command that works.
  const size_t begin = replay.find("render");
  std::string command = replay.substr(begin);
  command.replace(command.find("X,Y"), 3, "3,4");
  const ProgramResult pixel = run(command);
  EXPECT_EQ(pixel.code, 0) << pixel.err;
  EXPECT_NE(pixel.out.find("confidence"), std::string::npos) << pixel.out;
}

// The command renders the frame of a one-frame run pixel by pixel, with any options for scene,
// light, film and method.
TEST_F(BiasTest, TheReplayIsTheFrameOfTheRun) {
  Image sky(4, 2);
  for (size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = glm::vec3(float(i), 2.0f, 1.0f);
  writeExr(path("sky.exr"), {{{"", sky}}, {}});
  for (const std::string& settings :
       {std::string("cornell-box --integrator restir_gi --set mis=defensive --component indirect "
                    "--max-bounces 12 --filter center --rr --seed 7"),
        std::string(
            "quad-light --camera low --environment sky.exr --environment-rotation 30 "
            "--environment-scale 0.5 --integrator path --multiscatter --kernels general")}) {
    const ProgramResult result =
        run("bias " + settings +
            " --resolution 12x8 --runs 32 --warmup 2 --frames 1 --margin 50 -o out --json -q");
    ASSERT_LE(result.code, 1) << result.err;
    std::string command = Json::parse(result.out).at("replay");
    command = command.substr(command.find("render"));
    command.replace(command.find("X,Y"), 3, "3,4");
    const ProgramResult replayed = run(command + " -o frame.exr --json -q");
    ASSERT_EQ(replayed.code, 0) << command << "\n" << replayed.err;
    const std::string folder = entries("out/runs").at(0).string();
    const Image frame = readExr(path("frame.exr")).layers.at("");
    EXPECT_EQ(frame.pixels, readExr(folder + "/run-00000.exr").layers.at("").pixels) << command;
    EXPECT_NE(frame.pixels, readExr(folder + "/run-00001.exr").layers.at("").pixels);
    const Json pixel = Json::parse(replayed.out);
    EXPECT_EQ(pixel.at("frame"), 3);
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(BiasTest, AnInterruptKeepsFinishedRuns) {
  const std::string command =
      "bias cornell-box --integrator restir_gi --resolution 48x48 --runs 2000 -o out -q";
  const ProgramResult stopped = runUntil(
      [&] { return entries("out/runs").size() == 1 && entries(entries("out/runs")[0]).size() > 2; },
      command);
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  expectError(stopped, 130, {"finished runs are kept"});
  EXPECT_FALSE(std::filesystem::exists(path("out/report.html")));
  EXPECT_GT(entries(entries("out/runs")[0]).size(), 2u);
}

TEST_F(BiasTest, ASuiteIsCertifiedMethodByMethod) {
  write("two.toml", R"(name = "two"
scenes = ["quad-light"]
[settings]
width = 16
height = 16
max_bounces = 1
warmup_frames = 2
frames = 32
runs = 2
[reference]
spp = 64
[[method]]
name = "plain"
integrator = "path"
[[method]]
name = "reuse"
integrator = "restir_gi"
)");
  const ProgramResult result = run("bias two.toml --runs 48 -o out");
  EXPECT_EQ(result.code, 0) << result.err << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 2) << result.out;
  EXPECT_NE(result.out.find("quad-light, path: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("restir_gi unbiased"), std::string::npos) << result.out;
  const std::string table = read("out/certificates.md");
  EXPECT_NE(table.find("| unbiased | 2 | 0 | 0 |"), std::string::npos) << table;
  for (const char* row :
       {"| method | denoiser | declared | quad-light |", "| path | none | unbiased | equivalent ",
        "| restir_gi unbiased, pixel | none | unbiased | equivalent "})
    EXPECT_NE(table.find(row), std::string::npos) << row << "\n" << table;
  const Json first = Json::parse(read("out/certificates.json")).at("certificates").at(0);
  EXPECT_EQ(first.at("scene"), "quad-light");
  EXPECT_EQ(first.at("declared"), "unbiased");
  // The page lists quantities, not methods.
  EXPECT_NE(read("out/report.html").find(">quantity<"), std::string::npos);
  expectError(run("bias two.toml --resolution 8x8 -o out"), 2, {"--resolution", "two.toml"});
}

// An interrupted suite leaves the table of the finished scenes, and the same command continues.
TEST_F(BiasTest, AStoppedSuiteLeavesATableOfItsFinishedScenes) {
  write("two.toml", R"(name = "two"
[settings]
width = 16
height = 16
max_bounces = 1
frames = 4
[reference]
spp = 64
[[scene]]
scene = "quad-light"
[[scene]]
scene = "cornell-box"
width = 48
height = 48
[[method]]
integrator = "path"
)");
  const std::string command = "bias two.toml --runs 32 --margin 20 -q -o out";
  const ProgramResult stopped =
      runUntil([&] { return std::filesystem::exists(path("out/certificates.md")); }, command);
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_NE(read("out/certificates.md").find("| method | denoiser | declared | quad-light |\n"),
            std::string::npos)
      << read("out/certificates.md");
  EXPECT_FALSE(std::filesystem::exists(path("out/report.html")));
  EXPECT_EQ(run(command).code, 0);
  EXPECT_NE(read("out/certificates.md")
                .find("| method | denoiser | declared | quad-light | cornell-box |\n"),
            std::string::npos)
      << read("out/certificates.md");
}

// A clearly biased method gets no more runs than cells need; a correct one needs more.
TEST_F(BiasTest, ASuiteSpendsNoRunsOnWhatIsClearlyBiased) {
  write("two.toml", R"(name = "two"
scenes = ["door-ajar"]
[settings]
width = 16
height = 9
warmup_frames = 4
frames = 4
threads = 1
[[method]]
integrator = "path"
[[method]]
integrator = "restir_gi"
mis = "confidence"
)");
  const ProgramResult result = run("bias two.toml --margin 4 --max-runs 192 --json -q -o out");
  EXPECT_EQ(result.code, 1) << result.err << result.out;
  const Json document = Json::parse(result.out);
  EXPECT_GT(document.at(0).at("runs"), 128) << document.at(0).at("reason");
  EXPECT_EQ(document.at(1).at("verdict"), "biased") << document.at(1).at("reason");
  EXPECT_EQ(document.at(1).at("runs"), 128);
}

// Uses experiments/suites/certificates.toml, with fewer runs than in its document.
TEST_F(BiasTest, NightlyNothingThatIsDeclaredUnbiasedIsFoundBiased) {
  const ProgramResult result =
      run("bias " RESTLAB_SOURCE_DIR
          "/experiments/suites/certificates.toml --runs 64 --margin 2 --json -q -o out");
  EXPECT_LE(result.code, 1) << result.err;
  const Json all = Json::parse(result.out);
  // path, template and restir_gi with two modes and three caches; seven denoisers; six scenes.
  EXPECT_EQ(all.size(), (1u + 1u + 2u * 3u) * 7u * 6u);
  size_t unbiased = 0, found = 0;
  for (const Json& c : all) {
    const bool isBiased = c.at("verdict") == "biased";
    found += isBiased;
    if (c.at("declared") != "unbiased") continue;
    ++unbiased;
    EXPECT_FALSE(isBiased) << c.at("name") << ": " << c.at("reason");
  }
  EXPECT_EQ(unbiased, (1u + 1u + 3u) * 2u * 6u) << "without a denoiser and with accumulate";
  EXPECT_GT(found, 0u) << "filters blur: what finds none of them finds nothing";
  EXPECT_NE(read("out/certificates.md").find("None that is declared unbiased was found biased."),
            std::string::npos);
}

// A furnace with a known image; each certificate has its own maps.
TEST_F(BiasTest, ASuiteIsHeldAgainstItsTruths) {
  const std::string settings = R"(name = "truths"
[settings]
width = 8
height = 8
warmup_frames = 1
frames = 4
runs = 2
[reference]
spp = 64
[[method]]
name = "plain"
integrator = "path"
)";
  write("exact.toml", settings +
                          "[[scene]]\nname = \"f\"\nscene = [\"furnace?albedo=0.5\", "
                          "\"furnace?albedo=0.75\"]\ntruth = \"exact\"\n");
  const ProgramResult result = run("bias exact.toml --runs 128 --margin 2 -o out -q");
  EXPECT_EQ(result.code, 0) << result.err << result.out;
  const Json all = Json::parse(read("out/certificates.json")).at("certificates");
  ASSERT_EQ(all.size(), 2u);
  for (const Json& one : all)
    EXPECT_NE(one.at("how").get<std::string>().find("in closed form"), std::string::npos);
  EXPECT_EQ(entries("out/references").size(), 0u);

  // Two scenes that give the same certificate name.
  write("cameras.toml", settings +
                            "[[scene]]\nname = \"a\"\nscene = \"quad-light\"\nmax_bounces = 1\n"
                            "[[scene]]\nname = \"b\"\nscene = \"quad-light\"\nmax_bounces = 1\n"
                            "camera = \"low\"\n");
  EXPECT_LE(run("bias cameras.toml --runs 32 --margin 50 -o two -q").code, 1);
  EXPECT_EQ(entries("two/maps").size(), 2u * 7u);

  // Missing truths of a sweep are reported before the first run.
  write("none.toml", settings +
                         "[[scene]]\nscene = [\"cornell-box?fov=30\", "
                         "\"cornell-box?fov=40\"]\ntruth = \"exact\"\n");
  expectError(run("bias none.toml --runs 32 -o none"), 2,
              {"none.toml:15:9", "cornell-box?fov=30 has no exact image", "furnace"});
  EXPECT_EQ(entries("none").size(), 0u);
  write("file.toml", settings + "[[scene]]\nscene = \"furnace\"\nreference = \"a.exr\"\n");
  expectError(run("bias file.toml --runs 32 -o none"), 2, {"file.toml:15:13", "--ref"});
}

// The truth of a camera that moves is that of the counted frames, and of switched lamps as well.
TEST_F(BiasTest, TheTruthMovesWithTheCamera) {
  const std::string small =
      "bias quad-light --resolution 16x16 --max-bounces 1 --runs 192 -o out -q ";
  const auto verdictOf = [&](const std::string& more) {
    const ProgramResult result = run(small + more + " --json");
    const Json document = Json::parse(result.out, nullptr, false);
    return document.is_object() ? document.at("verdict").get<std::string>() : result.err;
  };
  // Fast enough that the views of the counted frames differ by more than the margin.
  const std::string orbit =
      "--camera-path orbit,degrees_per_frame=3 --frames 4 --warmup 2 --margin 2";
  EXPECT_EQ(verdictOf(orbit), "equivalent");
  const Json document = Json::parse(read("out/certificates.json")).at("certificates").at(0);
  EXPECT_NE(document.at("name").get<std::string>().find("orbit"), std::string::npos);
  EXPECT_NE(document.at("how").get<std::string>().find("over the views"), std::string::npos);
  EXPECT_EQ(entries("out/references").size(), 4u);
  // After a cut the view stands still: one reference.
  EXPECT_EQ(verdictOf("--camera-path cut,frame=2 --frames 4 --warmup 2 --margin 2"), "equivalent");
  EXPECT_EQ(entries("out/references").size(), 5u);
  // A history that goes on through a switch of the lamp is declared biased, and is.
  write("switched.toml",
        "name = \"switched\"\n[settings]\nwidth = 16\nheight = 16\nmax_bounces = 1\n"
        "warmup_frames = 4\nframes = 1\n[[scene]]\nscene = \"quad-light\"\n"
        "[[method]]\nname = \"path\"\nintegrator = \"path\"\n"
        "[[method]]\nname = \"average\"\nintegrator = \"path\"\ndenoiser = \"accumulate\"\n"
        "[[event]]\nframe = 4\nlight = \"all\"\nfactor = 0.5\n");
  const ProgramResult result = run("bias switched.toml --runs 192 --margin 4 --json -q -o two");
  const Json both = Json::parse(result.out, nullptr, false);
  ASSERT_TRUE(both.is_array()) << result.err;
  EXPECT_EQ(both.at(0).at("verdict"), "equivalent") << both.at(0).at("reason");
  EXPECT_EQ(both.at(1).at("verdict"), "biased") << both.at(1).at("reason");
  EXPECT_EQ(both.at(1).at("declared"), "biased");

  expectError(run("bias quad-light --camera-path orbti"), 2, {"--camera-path", "orbit"});
  expectError(run("bias quad-light --camera-path orbit,degrees_per_frame"), 2, {"KEY=VALUE"});
  expectError(run("bias quad-light --camera-path orbit,degrees=3"), 2,
              {"--camera-path", "degrees"});
}

// A failed command leaves no folder; each method has its own.
TEST_F(BiasTest, EachMethodHasAFolder) {
  expectError(run("bias no-such-scene"), 3, {"no-such-scene"});
  write("broken.toml", "name = \"broken\"\nscenes = [\"no-such-scene\"]\n");
  EXPECT_NE(run("bias broken.toml").code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("results")));
  const std::string command =
      "bias quad-light --resolution 8x8 --max-bounces 1 --runs 32 --frames 2 --margin 50 -q";
  EXPECT_LE(run(command).code, 1);
  EXPECT_LE(run(command + " --integrator restir_gi --set mis=confidence").code, 1);
  EXPECT_TRUE(std::filesystem::exists(path("results/bias-quad-light-path/report.html")));
  EXPECT_EQ(entries("results").size(), 2u);
}

// Replaces and names another certificate's page and maps, but leaves other files in the folder.
TEST_F(BiasTest, WhatIsReplacedIsNamedAndNothingElseGoes) {
  std::filesystem::create_directories(path("out/maps"));
  write("out/maps/terrain.txt", "mine");
  ASSERT_LE(run(small_ + " --runs 32 --frames 2 --margin 50").code, 1);
  EXPECT_TRUE(std::filesystem::exists(path("out/maps/quad-light-path-bias.png")));
  const ProgramResult other =
      run(small_ + " --integrator restir_gi --runs 32 --frames 2 --margin 50");
  ASSERT_LE(other.code, 1) << other.err;
  EXPECT_NE(other.err.find("out: page, tables and maps will replace those of "), std::string::npos)
      << other.err;
  EXPECT_EQ(read("out/maps/terrain.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(path("out/maps/quad-light-path-bias.png")));
  EXPECT_EQ(entries("out/maps").size(), 1u + 7u);
  // A foreign certificates.json does no harm.
  write("out/certificates.json", "{\"command\": 3, \"certificates\": [{\"label\": \"../x\"}]}");
  EXPECT_LE(run(small_ + " --runs 32 --frames 2 --margin 50").code, 1);
}

// File names are limited in length.
TEST_F(BiasTest, ManySettingsMakeAShortName) {
  const ProgramResult result = run(
      "bias quad-light --resolution 8x8 --max-bounces 1 --runs 32 --frames 2 --margin 50 -q "
      "--integrator restir_gi --set mis=defensive --set confidence_cap=17 --set max_jacobian=11 "
      "--set normal_threshold=0.25 --set plane_threshold=0.125 --set spatial_radius=12.5 "
      "--set spatial_neighbours=2 --set moving_confidence_cap=9 --set aged_neighbours=1");
  EXPECT_LE(result.code, 1) << result.err;
  ASSERT_EQ(entries("results").size(), 1u);
  EXPECT_LT(entries("results").at(0).filename().string().size(), 160u);
}

TEST_F(BiasTest, RowsOfImagesAreSaidToBeLeftOut) {
  writeExr(path("theirs.exr"), {{{"", Image(8, 8, glm::vec3(1.0f))}}, {}});
  write("rows.toml", R"(name = "rows"
scenes = ["quad-light"]
[settings]
width = 8
height = 8
max_bounces = 1
frames = 2
[reference]
spp = 64
[[method]]
integrator = "path"
[[method]]
name = "theirs"
image = ["theirs.exr"]
)");
  const ProgramResult result = run("bias rows.toml --runs 32 --margin 50 -o out");
  EXPECT_NE(result.err.find("'theirs' is a row of images and gets no certificate"),
            std::string::npos)
      << result.err;
}

// A reference that does not reach the wanted error ends at the bound, and states the wanted error.
TEST_F(BiasTest, TheReferenceHasABound) {
  const std::string box = "bias cornell-box --resolution 16x16 --frames 2 --margin 1 -o out ";
  const ProgramResult bounded = run(box + "--runs 32 --max-reference-spp 64");
  EXPECT_LE(bounded.code, 1) << bounded.err;
  for (const char* part : {"reference: its error is ",
                           " after 64 spp; wanted is 0.20 %, a fifth of "
                           "the margin: about ",
                           "stopped by --max-reference-spp"})
    EXPECT_NE(bounded.err.find(part), std::string::npos) << part << "\n" << bounded.err;
  const ProgramResult limited =
      run("bias cornell-box --resolution 16x16 --frames 2 --margin 0.01 -o out --time-limit 1 "
          "--max-runs 100000");
  EXPECT_LE(limited.code, 1) << limited.err;
  EXPECT_NE(limited.err.find("--time-limit"), std::string::npos) << limited.err;
}

TEST_F(BiasTest, ADryRunSaysWhatItTakesAndWritesNothing) {
  const ProgramResult plan = run("bias cornell-box --resolution 16x16 --dry-run");
  EXPECT_EQ(plan.code, 0) << plan.err;
  for (const char* part : {"cornell-box-path\n",
                           "  reference: an error of 0.10 % of the mean is "
                           "wanted, a fifth of the margin: about ",
                           "  runs: 64 first ones, ", "at most 4096 (--max-runs)"})
    EXPECT_NE(plan.out.find(part), std::string::npos) << part << "\n" << plan.out;
  EXPECT_FALSE(std::filesystem::exists(path("results")));
}

TEST_F(BiasTest, WhatIsMissingIsSaid) {
  expectError(run("bias"), 2, {"needs a scene or a suite", "--images"});
  expectError(run("bias --images x*.exr"), 2, {"--images", "--ref"});
  expectError(run("bias quad-light --ref r.exr"), 2, {"--ref", "--images"});
  expectError(run("bias --images x*.exr --ref r.exr"), 3, {"x*.exr", "no file"});
  expectError(run("bias quad-light --runs 1"), 2, {"--runs", "32"});
  expectError(run("bias quad-light --margin 0"), 2, {"--margin"});
  expectError(run("bias quad-light --runs 64 --max-runs 64"), 2, {"--max-runs", "one of the two"});
  expectError(run("bias no-such-scene"), 3, {"no-such-scene"});
}

}  // namespace
}  // namespace restlab::cli_test
