// restlab run: files in its folder, ratios, references, overrides, interruption.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "core/base/memory.h"
#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSuite = R"(name = "small"
question = "Does it run?"
scenes = ["cornell-box"]

[settings]
width = 24
height = 16
max_bounces = 3
warmup_frames = 3
frames = 2
runs = 3
ages = [1, 2]
components = ["all"]

[reference]
spp = 32

[[method]]
name = "path"
integrator = "path"

[[method]]
name = "gi"
integrator = "restir_gi"
mode = "unbiased"
confidence_cap = 8.0
)";

constexpr const char* kContract =
    "scene,camera,integrator,mode,cache,backend,denoiser,width,height,frames,runs,time_ms_median,"
    "time_ms_p95,mse,mse_ci_lo,mse_ci_hi,relmse_e1e-2,energy_ratio,nonfinite,mse_ratio,time_ratio,"
    "efficiency_ratio,features_left_out,";

class RunTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSuite);
  }
  std::vector<nlohmann::json> lines(const std::string& file) const {
    std::vector<nlohmann::json> all;
    std::istringstream text(read(file));
    for (std::string line; std::getline(text, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  void replaceInSuite(const std::string& from, const std::string& to) const {
    std::string text = read("suite.toml");
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
    write("suite.toml", text);
  }
};

double number(const std::map<std::string, std::string>& row, const std::string& column) {
  return std::stod(row.at(column));
}

TEST_F(RunTest, LeavesWhatTheContractSays) {
  const ProgramResult result = run("run suite.toml --out out -t 2");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string csv = read("out/summary.csv");
  EXPECT_EQ(csv.rfind(kContract, 0), 0u) << csv;
  const auto rows = parseCsv(csv);
  ASSERT_EQ(rows.size(), 2u);
  const auto &path = rows[0], &gi = rows[1];
  EXPECT_EQ(path.at("integrator"), "path");
  EXPECT_EQ(path.at("cache"), "none");
  EXPECT_EQ(gi.at("integrator"), "restir_gi");
  EXPECT_EQ(gi.at("mode"), "unbiased");
  EXPECT_EQ(gi.at("cache"), "pixel");
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("scene"), "cornell-box");
    EXPECT_EQ(row.at("width"), "24");
    EXPECT_EQ(row.at("height"), "16");
    EXPECT_EQ(row.at("frames"), "2");
    EXPECT_EQ(row.at("runs"), "3");
    EXPECT_EQ(row.at("nonfinite"), "0");
    EXPECT_GT(number(row, "time_ms_median"), 0.0);
    EXPECT_GE(number(row, "time_ms_p95"), number(row, "time_ms_median"));
    EXPECT_LE(number(row, "mse_ci_lo"), number(row, "mse"));
    EXPECT_GE(number(row, "mse_ci_hi"), number(row, "mse"));
    EXPECT_NEAR(number(row, "mse_ratio"), number(path, "mse") / number(row, "mse"),
                1e-6 * number(row, "mse_ratio"));
    EXPECT_NEAR(number(row, "efficiency_ratio"),
                number(row, "mse_ratio") / number(row, "time_ratio"),
                1e-6 * number(row, "efficiency_ratio"));
    EXPECT_NE(row.at("features_left_out").find("environment"), std::string::npos);
  }
  EXPECT_EQ(number(path, "mse_ratio"), 1.0);
  EXPECT_EQ(number(path, "time_ratio"), 1.0);
  EXPECT_EQ(number(path, "efficiency_ratio"), 1.0);

  const auto results = lines("out/results.jsonl");
  EXPECT_EQ(results.size(), 2u * 3u * 3u) << "methods x runs x (two ages and the run)";
  double mse = 0.0;
  for (const auto& line : results) {
    EXPECT_EQ(line["schema"], 3);
    if (line["kind"] == "run" && line["method"] == "gi") {
      mse += line["mse"].get<double>() / 3.0;
      EXPECT_EQ(line["frame"], 3);
      EXPECT_EQ(line["parameters"]["confidence_cap"], 8.0);
      EXPECT_EQ(line["time_ms"]["frames"].size(), 2u);
    }
  }
  EXPECT_NEAR(mse, number(gi, "mse"), 1e-6 * mse) << "the row is the mean of its runs";

  EXPECT_NE(result.out.find("| gi |"), std::string::npos) << result.out;
  EXPECT_NE(read("out/table.md").find(result.out), std::string::npos)
      << "the printed table is the one in the file";
  EXPECT_EQ(nlohmann::json::parse(read("out/run.json"))["status"], "finished");
  for (const char* image : {"path", "gi", "reference"}) {
    const fs::path stem = folder_ / ("out/images/cornell-box-all-" + std::string(image));
    EXPECT_TRUE(fs::exists(stem.string() + ".png")) << stem;
    const LayeredImage exr = readExr(stem.string() + ".exr");
    EXPECT_EQ(exr.layers.at("").width, 24u);
    EXPECT_EQ(exr.metadata.count("scene_hash"), 1u);
  }
}

TEST_F(RunTest, MeasuredImageIsTheFrameAfterTheWarmup) {
  ASSERT_EQ(run("run suite.toml --out out --set seed=11").code, 0);
  ASSERT_EQ(run("render cornell-box -o again.exr --resolution 24x16 --max-bounces 3 --frames 4 "
                "--seed 11 --integrator restir_gi --mode unbiased --set confidence_cap=8")
                .code,
            0);
  EXPECT_EQ(readExr(path("out/images/cornell-box-all-gi.exr")).layers.at("").pixels,
            readExr(path("again.exr")).layers.at("").pixels);
  // Its MSE is that of `compare`.
  std::string reference;
  for (const auto& entry : fs::directory_iterator(path("out/references"))) {
    reference = entry.path().string();
  }
  const ProgramResult again = run({"compare", "--json", "--metrics", "mse", "--ref", reference,
                                   "out/images/cornell-box-all-gi.exr"});
  ASSERT_EQ(again.code, 0) << again.err;
  const double mse = nlohmann::json::parse(again.out)["images"][0]["metrics"]["mse"].get<double>();
  for (const auto& line : lines("out/results.jsonl")) {
    if (line["kind"] == "run" && line["method"] == "gi" && line["run"] == 0) {
      EXPECT_NEAR(line["mse"].get<double>(), mse, 1e-9 * std::abs(mse));
    }
  }
}

TEST_F(RunTest, ReferencesAreReusedUnderTheirKeyOnly) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  const std::string fresh = run("run suite.toml --out out").err;
  EXPECT_EQ(fresh.find("relmse"), std::string::npos) << "rendered again: " << fresh;
  const std::string elsewhere = run("run suite.toml --out other").err;
  EXPECT_NE(elsewhere.find("/cache/"), std::string::npos) << elsewhere;
  const std::string stale = run("run suite.toml --out out --set max_bounces=2").err;
  EXPECT_NE(stale.find("rendered anew"), std::string::npos) << stale;
  const std::string more = run("run suite.toml --out out --set max_bounces=2 "
                               "--set reference.spp=64")
                               .err;
  EXPECT_NE(more.find("less than wanted"), std::string::npos) << more;
  EXPECT_EQ(lines("out/results.jsonl").size(), 3u * 18u)
      << "append-only; the second time every run was there";
}

TEST_F(RunTest, GivenReferenceMustAgree) {
  ASSERT_EQ(
      run("reference cornell-box -o good.exr --resolution 24x16 --max-bounces 3 --spp 8").code, 0);
  ASSERT_EQ(run("reference cornell-box -o bad.exr --resolution 24x16 --max-bounces 4 --spp 8").code,
            0);
  replaceInSuite("scenes = [\"cornell-box\"]", "");
  write("suite.toml",
        read("suite.toml") + "[[scene]]\nscene = \"cornell-box\"\nreference = \"good.exr\"\n");
  EXPECT_EQ(run("run suite.toml --out out").code, 0);
  replaceInSuite("good.exr", "bad.exr");
  expectError(run("run suite.toml --out out -q"), 3,
              {"suite.toml:29:13", "bad.exr", "max_bounces", "4", "3"});
  EXPECT_FALSE(parseCsv(read("out/summary.csv")).empty()) << "a wrong suite costs no results";
  replaceInSuite("width = 24", "width = 23");
  expectError(run("run suite.toml --out out -q"), 3, {"suite.toml:29:13", "24x16", "23x16"});
  replaceInSuite("bad.exr", "absent.exr");
  expectError(run("run suite.toml --out out -q"), 3, {"suite.toml:29:13", "absent.exr"});
  // Files that are no references: an image with the noise of one sample, and one with a NaN.
  replaceInSuite("width = 23", "width = 24");
  replaceInSuite("absent.exr", "out/images/cornell-box-all-path.exr");
  expectError(run("run suite.toml --out out -q"), 3,
              {"suite.toml:29:13", "is an image of path with 1 spp, not a reference"});
  LayeredImage hole;
  hole.layers[""] = Image(24, 16);
  hole.layers[""].pixels[24 * 3 + 5].y = std::numeric_limits<float>::quiet_NaN();
  writeExr(path("hole.exr"), hole);
  replaceInSuite("out/images/cornell-box-all-path.exr", "hole.exr");
  expectError(run("run suite.toml --out out -q"), 3,
              {"suite.toml:29:13", "1 values of its image are not finite", "pixel (5, 3)"});
}

TEST_F(RunTest, NothingIsRenderedBeforeEverySceneIsChecked) {
  replaceInSuite("scenes = [\"cornell-box\"]", "");
  const std::string base = read("suite.toml") + "[[scene]]\nscene = \"quad-light\"\n";
  const auto last = [&](const std::string& keys, int code,
                        const std::vector<std::string>& fragments) {
    write("suite.toml", base + "[[scene]]\nscene = \"cornell-box\"\n" + keys);
    expectError(run("run suite.toml --out out -q"), code, fragments);
    EXPECT_FALSE(fs::exists(path("out"))) << "rendered, or left a folder";
  };
  last("camera = \"nobody\"\n", 2, {"suite.toml:31:10", "'nobody'"});
  last("camera = \"7\"\n", 2, {"suite.toml:31:10", "camera 7"});
  last("environment_scale = 2\n", 2, {"suite.toml:30:9", "environment"});
  last("environment = \"absent.hdr\"\n", 3, {"suite.toml:31:15", "absent.hdr", "not found"});
  last("reference = \"absent.exr\"\n", 3, {"suite.toml:31:13", "absent.exr"});
  last("width = 16384\nheight = 16384\n", 2,
       {"suite.toml:30:9", "16384x16384", "4 layers", "8192x8192"});
}

TEST_F(RunTest, MemoryIsCheckedBeforeAnythingIsRendered) {
  const auto available = availableMemory();
  if (!available) GTEST_SKIP() << "this system does not say how much memory there is";
  std::string suite = kSuite;
  // Enough methods for four times the available memory, at no less than 64 bytes per pixel each.
  const uint64_t methods = 1 + *available / 16 / (uint64_t(8192) * 8192);
  for (uint64_t i = 0; i < methods; ++i) {
    suite += "[[method]]\nintegrator = \"restir_gi\"\nname = \"gi" + std::to_string(i) + "\"\n";
  }
  write("suite.toml", suite);
  expectError(run("run suite.toml --out out -q --set width=8192 --set height=8192"), 4,
              {"suite.toml:3:10", "cornell-box", "MiB", "smaller resolution"});
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(RunTest, EarlierResultsDoNotPassForNewOnes) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  write("out/images/notes.txt", "mine");
  fs::create_directory(path("out/images/folder.png"));
  fs::remove_all(path("cache"));
  fs::remove_all(path("out/references"));
  // Interrupted in the reference, before any row exists.
  const ProgramResult result =
      runUntil([&] { return isSaid("\"total\":100000000"); },
               "run suite.toml --out out --json --set reference.spp=100000000");
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_FALSE(fs::exists(path("out/summary.csv")));
  EXPECT_EQ(read("out/table.md").find("| gi |"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(path("out/images"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "notes.txt" || name == "folder.png") << name;
  }
  EXPECT_EQ(lines("out/results.jsonl").size(), 18u) << "append-only";
}

TEST_F(RunTest, ReferenceAmongEarlierImagesStays) {
  ASSERT_EQ(run("reference cornell-box -o ref.exr --resolution 24x16 --max-bounces 3 --spp 8").code,
            0);
  fs::create_directories(path("out/images"));
  fs::rename(path("ref.exr"), path("out/images/ref.exr"));
  replaceInSuite("scenes = [\"cornell-box\"]", "");
  write("suite.toml", read("suite.toml") +
                          "[[scene]]\nscene = \"cornell-box\"\n"
                          "reference = \"out/images/ref.exr\"\n");
  const ProgramResult result = run("run suite.toml --out out");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(fs::exists(path("out/images/ref.exr")));
}

TEST_F(RunTest, SelectionAndOverrides) {
  ASSERT_EQ(run("run suite.toml --out out --methods gi --set runs=2 --set settings.frames=1 "
                "--set method.gi.confidence_cap=3 --set scenes=[\"quad-light\",\"cornell-box\"] "
                "--scenes quad-light --set components=[\"all\",\"direct\"]")
                .code,
            0);
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("component"), "all");
  EXPECT_EQ(rows[1].at("component"), "direct");
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("scene"), "quad-light");
    EXPECT_EQ(row.at("runs"), "2");
    EXPECT_EQ(row.at("mse_ratio"), "nan") << "no path to compare with";
  }
  EXPECT_EQ(lines("out/results.jsonl")[0]["parameters"]["confidence_cap"], 3.0);
}

TEST_F(RunTest, OptionalSceneIsSkippedVisibly) {
  write("suite.toml",
        read("suite.toml") + "[[scene]]\nscene = \"absent/absent.gltf\"\noptional = true\n");
  const ProgramResult result = run("run suite.toml --out out --set runs=2");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("skipped absent"), std::string::npos) << result.err;
  EXPECT_NE(read("out/table.md").find("skipped absent"), std::string::npos);
  replaceInSuite("optional = true", "optional = false");
  expectError(run("run suite.toml --out out2 -q"), 3, {"absent/absent.gltf", "suite.toml"});
  EXPECT_FALSE(fs::exists(path("out2/summary.csv"))) << "nothing is rendered before the check";
}

TEST_F(RunTest, InterruptKeepsFinishedRuns) {
  const ProgramResult result = runUntil([&] { return entries("out/jobs").size() >= 2; },
                                        "run suite.toml --out out --set runs=100000");
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_EQ(result.errors().size(), 1u) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 2u);
  const auto finished = std::stoul(rows[0].at("runs"));
  EXPECT_GE(finished, 1u);
  EXPECT_LT(finished, 100000u);
  EXPECT_EQ(lines("out/results.jsonl").size(), finished * 2u * 3u) << "whole lines only";
  EXPECT_NE(read("out/table.md").find("Not finished"), std::string::npos);
}

// The launcher distinguishes `run` with a suite from `run` without one: it must know which options
// take a value.
TEST_F(RunTest, LauncherKnowsTheOptionsThatTakeValues) {
  std::ifstream file(fs::path(RESTLAB_SOURCE_DIR) / "lab");
  const std::string launcher((std::istreambuf_iterator<char>(file)),
                             std::istreambuf_iterator<char>());
  const size_t begin = launcher.find("names_suite() {");
  ASSERT_NE(begin, std::string::npos);
  std::string known = launcher.substr(begin, launcher.find("\n}", begin) - begin);
  std::replace(known.begin(), known.end(), ')', ' ');
  std::istringstream help(run("run --help").out);
  const std::regex withValue(R"(^  (-[-,a-z]+) (TEXT|INT|UINT|FLOAT).*)");
  size_t options = 0;
  for (std::string line; std::getline(help, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, withValue)) continue;
    std::istringstream names(match[1]);
    for (std::string name; std::getline(names, name, ',');) {
      ++options;
      EXPECT_NE(known.find(" " + name + " "), std::string::npos) << name;
    }
  }
  EXPECT_GE(options, 8u) << "-o --out --set --scenes --methods -t --threads --nthreads";
}

TEST_F(RunTest, BadSuitesNameThePlace) {
  const auto broken = [&](const std::string& from, const std::string& to, int code,
                          const std::vector<std::string>& fragments) {
    write("suite.toml", kSuite);
    replaceInSuite(from, to);
    expectError(run("run suite.toml --out out -q"), code, fragments);
    EXPECT_FALSE(fs::exists(path("out"))) << "a bad suite leaves nothing";
  };
  broken("scenes =", "sceens =", 2, {"suite.toml:3:1", "'sceens'", "did you mean 'scenes'?"});
  broken("width =", "widht =", 2, {"suite.toml:6:1", "'widht'", "did you mean 'width'?"});
  broken("runs = 3", "runs = \"3\"", 2, {"suite.toml:11:8", "'runs'", "integer"});
  broken("runs = 3", "runs = 0", 2, {"suite.toml:11:8", "'runs'"});
  broken("width = 24", "width = 0", 2, {"suite.toml:6:9", "'width'"});
  broken("confidence_cap = 8.0", "confidence_cp = 8.0", 2,
         {"suite.toml:26:1", "'confidence_cp'", "'confidence_cap'"});
  broken("confidence_cap = 8.0", "confidence_cap = -8.0", 2,
         {"suite.toml:26:18", "'confidence_cap'"});
  broken("\"unbiased\"", "\"unbised\"", 2, {"suite.toml:25:8", "'unbised'", "'unbiased'"});
  broken("\"restir_gi\"", "\"restir_gy\"", 2, {"suite.toml:24:14", "'restir_gi'"});
  broken("[\"all\"]", "[\"al\"]", 2, {"suite.toml:13", "'al'", "'all'"});
  broken("name = \"gi\"", "name = \"path\"", 2, {"two methods", "'path'"});
  broken("name = \"gi\"", "name = \"path-\"", 2, {"suite.toml:23:8", "'path'", "'path-'"});
  broken("name = \"gi\"", "name = \"reference\"", 2, {"suite.toml:23:8", "'reference'"});
  broken("[\"cornell-box\"]", "[\"cornell-box\", \"cornell-box\"]", 2,
         {"suite.toml:3:10", "two scenes", "'cornell-box'"});
  broken("[\"all\"]", "[\"all\", \"all\"]", 2, {"suite.toml:13:14", "'all' twice"});
  broken("mode = \"unbiased\"", "cache = \"pixl\"", 2, {"suite.toml:25:9", "'pixl'", "'pixel'"});
  broken("runs = 3", "backend = \"cpuu\"", 2, {"suite.toml:11:11", "'cpuu'", "'cpu'"});
  broken("[reference]", "[reference", 2, {"suite.toml:15"});
  broken("ages = [1, 2]", "ages = [1, 50]", 2, {"suite.toml:12", "50"});
  broken("spp = 32", "spp = 1", 2, {"suite.toml:16", "'spp'"});
  expectError(run("run absent.toml"), 2, {"absent.toml"});
  expectError(run("run /dev/zero --out out"), 2, {"/dev/zero", "regular file"});
  write("large.toml", std::string((1 << 20) + 1, '#'));
  expectError(run("run large.toml --out out"), 2, {"large.toml", "1048576"});
  write("suite.toml", kSuite);
  expectError(run("run suite.toml --out out -q --set runz=2"), 2, {"--set runz", "'runs'"});
  expectError(run("run suite.toml --out out -q --set method.gy.mode=biased"), 2, {"'gy'", "'gi'"});
  expectError(run("run suite.toml --out out -q --methods gy"), 2, {"gy", "'gi'"});
  write("plain", "");
  expectError(run("run suite.toml --out plain/out -q"), 3, {"plain/out"});
}

// Time and frames of the warm-up count: the warm-up only determines the measured frame.
TEST_F(RunTest, AccumulationBeginsWithTheHistory) {
  const auto accumulated = [&](const std::string& settings) {
    fs::remove_all(path("out"));
    const ProgramResult result =
        run("run suite.toml --out out -q --set accumulate=true " + settings);
    EXPECT_EQ(result.code, 0) << result.err;
    std::vector<std::pair<uint32_t, double>> points;
    std::istringstream text(read("out/results.jsonl"));
    for (std::string line; std::getline(text, line);) {
      const auto json = nlohmann::json::parse(line);
      if (json.at("kind") != "accumulated") continue;
      points.emplace_back(json.at("frames_accumulated").get<uint32_t>(),
                          json.at("mse").get<double>());
    }
    return points;
  };
  const auto warm = accumulated("--set warmup_frames=3 --set frames=3");
  ASSERT_EQ(warm.size(), 24u) << "1, 2, 4 and 6 frames of two methods and three runs";
  EXPECT_EQ(warm[0].first, 1u);
  EXPECT_EQ(warm[3].first, 6u);
  EXPECT_EQ(warm, accumulated("--set warmup_frames=0 --set frames=6"));
}

// While a method averages its whole history, its last frame is the accumulated image.
TEST_F(RunTest, AccumulatedAveragesAreNotAveragedTwice) {
  write("suite.toml", std::string(kSuite) + "\ndenoiser = \"accumulate\"\naccumulate_cap = 3.0\n");
  ASSERT_EQ(
      run("run suite.toml --out out -q --set accumulate=true --set ages=[1,2,4,8] --methods gi "
          "--set warmup_frames=0 --set frames=16")
          .code,
      0);
  // Nine frames of the reservoirs, then four of the denoiser: the first twelve are one average.
  std::map<uint64_t, double> aged, accumulated;
  for (const auto& line : lines("out/results.jsonl")) {
    if (line.at("run") != 0 || line.at("method") != "gi") continue;
    if (line.at("kind") == "age") aged[line.at("age")] = line.at("mse");
    if (line.at("kind") == "accumulated")
      accumulated[line.at("frames_accumulated")] = line.at("mse");
  }
  const double last = accumulated.at(16);
  accumulated.erase(16);
  EXPECT_EQ(aged, accumulated);
  EXPECT_EQ(aged.size(), 4u);
  EXPECT_NE(last, aged.at(8));
}

}  // namespace

}  // namespace restlab::cli_test
