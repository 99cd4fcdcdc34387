// Backends from the command line: options, absent devices, start-up, and suites with several
// backends in one table.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSuite = R"(name = "small"
scenes = ["cornell-box"]

[settings]
width = 32
height = 24
max_bounces = 3
warmup_frames = 5
frames = 2
runs = 2
backend = ["cpu", "vulkan"]

[reference]
spp = 16

[[method]]
name = "path"
integrator = "path"

[[method]]
name = "gi"
integrator = "restir_gi"
)";

class BackendTest : public ProgramTest {
  // The software driver (Mesa 22.3) leaks 128 bytes, with no frame that names it: in a build with
  // leak checks every program would end with an error. Other tests check for our own leaks.
  const Variable leaks_{"ASAN_OPTIONS", "detect_leaks=0:verify_asan_link_order=0"};

 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSuite);
  }
  nlohmann::json backend(const std::string& name) const {
    for (const auto& entry : nlohmann::json::parse(run("list backends --json").out)) {
      if (entry["name"] == name) return entry;
    }
    ADD_FAILURE() << "no backend " << name;
    return {};
  }
  std::vector<nlohmann::json> results(const std::string& folder) const {
    std::vector<nlohmann::json> all;
    std::istringstream text(read(folder + "/results.jsonl"));
    for (std::string line; std::getline(text, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  LayeredImage onlyReference(const std::string& folder) const {
    for (const auto& entry : fs::directory_iterator(path(folder + "/references")))
      return readExr(entry.path());
    ADD_FAILURE() << "no reference in " << folder;
    return {};
  }
};

// BackendTest that needs a device, and skips without one.
class VulkanTest : public BackendTest {
 protected:
  void SetUp() override {
    BackendTest::SetUp();
    const nlohmann::json vulkan = backend("vulkan");
    if (!vulkan["available"].get<bool>())
      GTEST_SKIP() << "SKIPPED: " << vulkan["why_not"].get<std::string>();
  }
};

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

double number(const std::map<std::string, std::string>& row, const std::string& column) {
  return std::stod(row.at(column));
}

TEST_F(BackendTest, NoVulkanDeviceIsOneLineThatNamesThePackage) {
  const Variable icd("VK_ICD_FILENAMES", "/nonexistent.json");
  const Variable driver("VK_DRIVER_FILES", "/nonexistent.json");
  expectError(run("render cornell-box -q -o x.exr --backend vulkan"), 4,
              {"no Vulkan device", "mesa-vulkan-drivers"});
  EXPECT_FALSE(fs::exists(path("x.exr")));
  expectError(run("reference cornell-box -q -o x.exr --spp 4 --backend vulkan"), 4,
              {"no Vulkan device", "mesa-vulkan-drivers"});
  expectError(run("run suite.toml -q --out out"), 4,
              {"suite.toml:11:11", "no Vulkan device", "mesa-vulkan-drivers"});
  expectError(run("run suite.toml -q --out out --set backend=cpu --set reference.backend=vulkan"),
              4, {"--set reference.backend", "no Vulkan device"});
  EXPECT_FALSE(fs::exists(path("out"))) << "a suite that cannot run leaves nothing";
  EXPECT_EQ(run("run suite.toml -q --out out --set backend=cpu").code, 0);
  const nlohmann::json vulkan = backend("vulkan");
  EXPECT_FALSE(vulkan["available"].get<bool>());
  EXPECT_TRUE(vulkan["devices"].empty());
  EXPECT_NE(run("list backends").out.find("mesa-vulkan-drivers"), std::string::npos);
}

TEST_F(BackendTest, RayTracingOfTheCpuIsChosenAndRecorded) {
  for (const char* way : {"embree", "bvh"}) {
    ASSERT_EQ(
        run(std::string("render cornell-box -o x.exr --resolution 32x24 --ray-tracing ") + way)
            .code,
        0);
    EXPECT_EQ(readExr(path("x.exr")).metadata.at("ray_tracing"), way);
  }
  const ProgramResult result =
      run("run suite.toml --out out --set backend=cpu --set ray_tracing=bvh");
  ASSERT_EQ(result.code, 0) << result.err;
  for (const auto& line : results("out")) {
    EXPECT_EQ(line["ray_tracing"], "bvh");
    EXPECT_EQ(line["startup_ms"], 0.0) << "these kernels were compiled with the program";
    EXPECT_NE(line["device"].get<std::string>().find("Embree"), std::string::npos);
  }
  EXPECT_EQ(result.err.find("ready in"), std::string::npos) << result.err;
  EXPECT_EQ(result.out.find("time / "), std::string::npos) << "there is one backend only";
  EXPECT_NE(read("out/table.md").find("rays by bvh"), std::string::npos);
  EXPECT_EQ(parseCsv(read("out/summary.csv"))[0].at("method"), "path") << "no @cpu where all are";
}

TEST_F(BackendTest, BadChoicesInASuiteNameThePlace) {
  const auto broken = [&](const std::string& set, const std::vector<std::string>& fragments) {
    expectError(run("run suite.toml -q --out out --set " + set), 2, fragments);
    EXPECT_FALSE(fs::exists(path("out")));
  };
  broken("backend=[\"cpu\",\"vulkn\"]", {"--set backend", "'vulkn'", "'vulkan'"});
  broken("backend=[\"cpu\",\"cpu\"]", {"--set backend", "'cpu' twice"});
  broken("backend=[]", {"--set backend", "empty"});
  broken("method.gi.backend=cpuu", {"--set method.gi.backend", "'cpuu'", "'cpu'"});
  broken("reference.backend=cpuu", {"--set reference.backend", "'cpuu'", "'cpu'"});
  broken("ray_tracing=foo", {"--set ray_tracing", "'foo'", "'embree'", "'bvh'", "'query'"});
  broken("backend=cpu --set device=x", {"--set device", "'x'", "vulkan"});
  broken("backend=cpu --set validate=true", {"--set validate", "vulkan"});
  broken("backend=cpu --set ray_tracing=query", {"--set ray_tracing", "'query'", "vulkan"});
  std::string text = kSuite;
  text.insert(text.find("\n[reference]"), "device = \"x\"\n");
  text.replace(text.find("[\"cpu\", \"vulkan\"]"), 17, "\"cpu\"");
  write("suite.toml", text);
  expectError(run("run suite.toml -q --out out"), 2, {"suite.toml:12:10", "'x'"});
}

TEST_F(VulkanTest, ListShowsEveryDevice) {
  const nlohmann::json devices = backend("vulkan")["devices"];
  ASSERT_GE(devices.size(), 1u);
  EXPECT_TRUE(backend("cpu")["devices"].empty());
  const std::string text = run("list backends").out;
  for (const auto& device : devices)
    EXPECT_NE(text.find("    " + device.get<std::string>() + "\n"), std::string::npos) << text;
}

TEST_F(VulkanTest, UnknownDeviceNamesThoseThereAre) {
  std::string name = backend("vulkan")["devices"][0];
  name.erase(name.find(" ("));
  expectError(run("render cornell-box -q -o x.exr --backend vulkan --device nosuch"), 4,
              {"--device", "'nosuch'", name});
  expectError(run("run suite.toml -q --out out --set device=nosuch"), 4,
              {"--set device", "'nosuch'", name});
  EXPECT_EQ(run({"render", "cornell-box", "-o", "x.exr", "--resolution", "8x8", "--backend",
                 "vulkan", "--device", name.substr(1)})
                .code,
            0)
      << "a part of the name is enough";
}

TEST_F(VulkanTest, RayQueriesOfADeviceWithoutThemAreOneLine) {
  const std::string device = backend("vulkan")["devices"][0];
  const std::string render = "render cornell-box -q -o x.exr --resolution 8x8 --backend vulkan";
  if (device.find(", query") != std::string::npos) {
    ASSERT_EQ(run(render).code, 0);
    // A software device traces faster with the project's own hierarchy.
    const bool isSoftware = device.find("(cpu;") != std::string::npos;
    EXPECT_EQ(readExr(path("x.exr")).metadata.at("ray_tracing"), isSoftware ? "bvh" : "query");
    GTEST_SKIP() << "SKIPPED: " << device;
  }
  expectError(run(render + " --ray-tracing query"), 4,
              {"--ray-tracing query", "has no ray queries", "--ray-tracing bvh works"});
  EXPECT_FALSE(fs::exists(path("x.exr")));
  ASSERT_EQ(run(render).code, 0);
  EXPECT_EQ(readExr(path("x.exr")).metadata.at("ray_tracing"), "bvh");
}

TEST_F(VulkanTest, ValidationIsAskedForByTheOption) {
  const Variable always("RESTLAB_VALIDATE", "0");
  const Variable layers("VK_LAYER_PATH", "/nonexistent");
  const std::string render = "render cornell-box -q -o x.exr --resolution 8x8 --backend vulkan";
  EXPECT_EQ(run(render).code, 0);
  expectError(run(render + " --validate"), 4, {"validation", "vulkan-validationlayers"});
  expectError(run("run suite.toml -q --out out --set validate=true"), 4,
              {"vulkan-validationlayers"});
}

TEST_F(VulkanTest, RenderSaysWhatStartUpDid) {
  const std::string render = "render cornell-box -o x.exr --resolution 32x24 --backend vulkan";
  const ProgramResult first = run(render);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(count(first.err, "vulkan: 1 kernel ready in "), 1u) << first.err;
  EXPECT_EQ(first.err.find("from the cache"), std::string::npos) << first.err;
  EXPECT_EQ(first.err.find("driver"), std::string::npos) << "details are for -v: " << first.err;
  const std::map<std::string, std::string> metadata = readExr(path("x.exr")).metadata;
  EXPECT_EQ(metadata.at("backend"), "vulkan");
  EXPECT_NE(metadata.at("ray_tracing"), "embree");
  EXPECT_NE(first.err.find(" on " + metadata.at("device")), std::string::npos) << first.err;

  const ProgramResult second = run(render + " -v --aov depth");
  EXPECT_NE(second.err.find("(1 from the cache) on "), std::string::npos) << second.err;
  EXPECT_EQ(count(second.err, "kernel path ("), 1u) << second.err;
  EXPECT_EQ(count(second.err, "kernel aov ("), 1u) << second.err;
  EXPECT_EQ(count(second.err, " ms, driver "), 2u) << second.err;

  size_t damaged = 0;
  for (const auto& entry : fs::directory_iterator(path("cache/restlab/kernels"))) {
    if (entry.path().extension() != ".spv") continue;
    write(entry.path().string(), "no kernel");
    ++damaged;
  }
  ASSERT_GE(damaged, 2u);
  const ProgramResult third = run(render + " -q");
  EXPECT_EQ(third.code, 0);
  EXPECT_EQ(count(third.err, "warning: "), 1u) << third.err;
}

TEST_F(VulkanTest, ReferencesOfTheVerbRunOnTheBackend) {
  ASSERT_EQ(run("reference cornell-box -o r.exr --resolution 32x24 --spp 4 --backend vulkan").code,
            0);
  EXPECT_EQ(readExr(path("r.exr")).metadata.at("backend"), "vulkan");
}

TEST_F(VulkanTest, SeveralBackendsShareATable) {
  const ProgramResult result = run("run suite.toml --out out");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(count(result.err, " ready in "), 1u) << "once, not for every session: " << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 4u);
  const std::vector<std::string> names = {"path @cpu", "path @vulkan", "gi @cpu", "gi @vulkan"};
  for (size_t i = 0; i < 4; ++i) {
    const auto &row = rows[i], &path = rows[i % 2], &onCpu = rows[i - i % 2];
    SCOPED_TRACE(names[i]);
    EXPECT_EQ(row.at("method"), names[i]);
    EXPECT_EQ(row.at("backend"), i % 2 == 0 ? "cpu" : "vulkan");
    EXPECT_NEAR(number(row, "mse_ratio"), number(path, "mse") / number(row, "mse"),
                1e-6 * number(row, "mse_ratio"));
    if (i < 2) {
      EXPECT_EQ(number(row, "time_ratio"), 1.0) << "each backend has its baseline";
    }
    EXPECT_NEAR(number(row, "mse"), number(onCpu, "mse"), 0.1 * number(onCpu, "mse"))
        << "the same samples on every backend, but for rounding";
    const double against = number(row, "time_ratio_to_first_backend");
    EXPECT_EQ(std::isnan(against), i % 2 == 0);
    if (i % 2 == 1) {
      EXPECT_GT(against, 0.0);
    }
  }
  for (const std::string& name : names) {
    EXPECT_NE(result.out.find("| " + name + " |"), std::string::npos) << result.out;
  }
  EXPECT_NE(result.out.find("| time / cpu |"), std::string::npos) << result.out;

  std::map<std::string, std::string> devices;
  for (const auto& line : results("out")) {
    const bool vulkan = line["backend"] == "vulkan";
    EXPECT_EQ(line["method"].get<std::string>().find("@vulkan") != std::string::npos, vulkan);
    EXPECT_EQ(line["startup_ms"].get<double>() > 0.0, vulkan) << line.dump();
    EXPECT_EQ(line["ray_tracing"] == "embree", !vulkan);
    devices[line["backend"]] = line["device"];
  }
  ASSERT_EQ(devices.size(), 2u);
  EXPECT_NE(devices["cpu"], devices["vulkan"]);
  const auto record = nlohmann::json::parse(read("out/run.json"));
  ASSERT_EQ(record["devices"].size(), 2u);
  for (const auto& use : record["devices"]) EXPECT_EQ(use["device"], devices[use["backend"]]);
  for (const auto& [backend, device] : devices) {
    EXPECT_NE(read("out/table.md").find(backend + ": " + device), std::string::npos);
    const auto metadata =
        readExr(path("out/images/cornell-box-all-gi-" + backend + ".exr")).metadata;
    EXPECT_EQ(metadata.at("backend"), backend);
    EXPECT_EQ(metadata.at("device"), device);
  }
  EXPECT_EQ(onlyReference("out").metadata.at("backend"), "cpu");

  // `render` submits several frames at once to a device; `run` one by one. Both give the same
  // image.
  ASSERT_EQ(run("render cornell-box -o again.exr --resolution 32x24 --max-bounces 3 --frames 6 "
                "--integrator restir_gi --backend vulkan")
                .code,
            0);
  EXPECT_EQ(readExr(path("out/images/cornell-box-all-gi-vulkan.exr")).layers.at("").pixels,
            readExr(path("again.exr")).layers.at("").pixels);

  // A name that several backends share selects the methods of all of them.
  ASSERT_EQ(run("run suite.toml --out few --set runs=2 --methods path").code, 0);
  EXPECT_EQ(parseCsv(read("few/summary.csv")).size(), 2u);
  ASSERT_EQ(run({"run", "suite.toml", "--out", "one", "--methods", "path @vulkan"}).code, 0);
  EXPECT_EQ(parseCsv(read("one/summary.csv")).size(), 1u);
}

TEST_F(VulkanTest, ALostDeviceIsOneLineAndFinishedRunsStay) {
  const Variable library("LD_PRELOAD", RESTLAB_LOST_DEVICE);
  const Variable counts("RESTLAB_TEST_SUBMISSION_COUNT", path("count").c_str());
  const std::string suite = "run suite.toml -q --out out --set backend=vulkan --set runs=3";
  const std::string render = "render cornell-box -q --resolution 8x8 --backend vulkan --spp 4 ";
  ASSERT_EQ(run(render + "-o there.exr").code, 0);
  ASSERT_GT(std::stol(read("count")), 1) << "the library is not asked";
  const std::vector<std::string> lost = {"the device was lost", "--backend cpu"};
  {
    const Variable limit("RESTLAB_TEST_SUBMISSIONS", "2");
    expectError(run(render + "-o lost.exr"), 4, lost);
    EXPECT_FALSE(fs::exists(path("lost.exr")));
    expectError(run(suite), 4, lost);
    EXPECT_FALSE(fs::exists(path("out/summary.csv"))) << "no run was finished";
  }
  // Lose the device by finished runs, not by submissions, whose number depends on the time of
  // frames.
  const Variable finished("RESTLAB_TEST_RESULTS", path("out/results.jsonl").c_str());
  const ProgramResult result = run(suite);
  EXPECT_EQ(result.code, 4) << result.err;
  ASSERT_EQ(result.errors().size(), 1u) << result.err;
  EXPECT_NE(result.errors()[0].find(lost[0]), std::string::npos) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& row : rows) {
    EXPECT_GE(std::stol(row.at("runs")), 1);
    EXPECT_LT(std::stol(row.at("runs")), 3);
  }
  EXPECT_NE(read("out/table.md").find("Not finished"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(read("out/run.json"))["status"].get<std::string>().find("failed"),
            0u);
}

TEST_F(VulkanTest, ReferencesAreContinuedOnTheirBackendOnly) {
  const std::string scene = " cornell-box --resolution 32x24 --max-bounces 3";
  ASSERT_EQ(run("reference -o r.exr --spp 6" + scene).code, 0);
  const ProgramResult other = run("reference -o r.exr --spp 4 --backend vulkan" + scene);
  EXPECT_NE(other.err.find("r.exr: is of backend cpu, not vulkan; rendered anew"),
            std::string::npos)
      << other.err;
  const ProgramResult more = run("reference -o r.exr --spp 9 --backend vulkan" + scene);
  EXPECT_NE(more.err.find("continues after the 4 spp"), std::string::npos) << more.err;
  ASSERT_EQ(run("reference -o whole.exr --spp 9 --backend vulkan --anew" + scene).code, 0);
  const LayeredImage extended = readExr(path("r.exr")), whole = readExr(path("whole.exr"));
  for (const auto& [name, layer] : whole.layers)
    EXPECT_EQ(layer.pixels, extended.layers.at(name).pixels) << name;
  EXPECT_EQ(extended.metadata.at("device"), whole.metadata.at("device"));
}

TEST_F(VulkanTest, AMethodsOwnBackendWins) {
  write("suite.toml", std::string(kSuite) + "[[method]]\nname = \"own\"\nbackend = \"vulkan\"\n");
  const ProgramResult result =
      run("run suite.toml --out out --set backend=cpu --set ray_tracing=embree --methods path,own "
          "--set reference.backend=vulkan");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("method"), "path @cpu");
  EXPECT_EQ(rows[0].at("ray_tracing"), "embree");
  EXPECT_EQ(rows[1].at("method"), "own @vulkan");
  EXPECT_NE(rows[1].at("ray_tracing"), "embree") << "the setting is for those that have it";
  EXPECT_EQ(number(rows[1], "time_ratio"), 1.0) << "the only path of its backend";
  EXPECT_EQ(onlyReference("out").metadata.at("backend"), "vulkan");
}

}  // namespace

}  // namespace restlab::cli_test
