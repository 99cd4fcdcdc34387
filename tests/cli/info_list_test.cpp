// restlab info, list, bench and the top of the command line.
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

using InfoTest = ProgramTest;

TEST_F(InfoTest, InfoShowsOneCamera) {
  const auto all = nlohmann::json::parse(run("info quad-light --json").out).at("cameras");
  ASSERT_GT(all.size(), 1u);
  const auto one = nlohmann::json::parse(run("info quad-light --camera low --json").out);
  ASSERT_EQ(one.at("cameras").size(), 1u);
  EXPECT_EQ(one.at("cameras")[0].at("name"), "low");
  EXPECT_EQ(one.at("cameras")[0].at("index"), 1);
  expectError(run("info quad-light --camera nowhere"), 2, {"nowhere"});
}

TEST_F(InfoTest, SceneInNumbers) {
  const ProgramResult result = run("info cornell-box --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["scene"], "cornell-box");
  EXPECT_EQ(json["emissive_triangles"], 2);
  EXPECT_GT(json["triangles"].get<int>(), 30);
  EXPECT_EQ(json["cameras"].size(), 1u);
  EXPECT_TRUE(json["environment"].is_null());
  EXPECT_EQ(json["features_needed"], "area_lights");
  ASSERT_EQ(json["objects"].size(), json["instances"].get<size_t>());
  EXPECT_NE(json["objects"].dump().find("\"Light\""), std::string::npos) << json["objects"];
  // A triangle takes at least three indices and positions, both here and in Embree.
  EXPECT_GT(json["bytes"].get<int>(), json["triangles"].get<int>() * 48);
  EXPECT_GT(json["embree_bytes"].get<int>(), json["triangles"].get<int>() * 48);
  ASSERT_GE(json["integrators"].size(), 2u);
  for (const auto& integrator : json["integrators"]) {
    size_t sum = 0;
    for (const auto& [name, bytes] : integrator["buffers"].items()) sum += bytes.get<size_t>();
    // Each buffer is rounded up, and so is their sum.
    const size_t whole = integrator["bytes_per_pixel"].get<size_t>();
    EXPECT_LE(whole, sum) << integrator["name"];
    EXPECT_GE(whole + integrator["buffers"].size(), sum) << integrator["name"];
    const std::string leftOut = integrator["features_left_out"];
    EXPECT_NE(leftOut.find("environment"), std::string::npos) << leftOut;
    EXPECT_EQ(leftOut.find("area_lights"), std::string::npos) << leftOut;
  }
  const ProgramResult text = run("info cornell-box");
  ASSERT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("2 emissive"), std::string::npos) << text.out;
}

TEST_F(InfoTest, GraphShowsPassesAndBuffers) {
  const ProgramResult result =
      run("graph restir_gi --cache voxel --scene quad-light --json -o frame.svg");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  size_t sum = 0;
  std::set<std::string> buffers;
  for (const auto& buffer : json.at("buffers")) {
    sum += buffer.at("bytes_per_pixel").get<size_t>();
    buffers.insert(buffer.at("name").get<std::string>());
  }
  EXPECT_GE(sum, json.at("bytes_per_pixel").get<size_t>());
  std::map<std::string, nlohmann::json> passes;
  for (const auto& pass : json.at("passes")) {
    passes[pass.at("name").get<std::string>()] = pass;
    for (const char* key : {"reads", "writes"})
      for (const auto& name : pass.at(key)) EXPECT_TRUE(buffers.contains(name)) << name;
  }
  EXPECT_FALSE(passes.at("temporal").at("in_still_view"));
  EXPECT_TRUE(passes.at("initial").at("in_still_view"));
  EXPECT_GT(passes.at("temporal").at("rays_per_pixel_moving"), 0.0);
  EXPECT_EQ(passes.at("temporal").at("rays_per_pixel_still"), 0.0);
  EXPECT_NE(read("frame.svg").find("reservoir_history"), std::string::npos);
  const ProgramResult text = run("graph path --scene quad-light");
  EXPECT_NE(text.out.find("12 bytes per pixel in all"), std::string::npos) << text.out;
  expectError(run("graph restir"), 2, {"restir"});
  expectError(run("graph path -o frame.png"), 2, {"frame.png", ".svg"});
  expectError(run("graph path --scene absent.gltf"), 3, {"absent.gltf"});
}

// Camera directions are unit vectors under any node. Under a shearing node, up is perpendicular to
// the view, as for rays.
TEST_F(InfoTest, CamerasUnderScaledNodesHaveUnitDirections) {
  write("scene.gltf", triangleGltf({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const std::string plain = read("scene.gltf");
  const std::string node = R"("translation": [0.3, 0.3, 2])";
  const auto camera = [&](const std::string& transform) {
    std::string text = plain;
    text.replace(text.find(node), node.size(), transform);
    write("scene.gltf", text);
    const ProgramResult result = run("info scene.gltf --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out)["cameras"].at(0);
  };
  const auto expect = [](const nlohmann::json& found, const char* key, std::array<double, 3> v) {
    const auto at = found[key].get<std::array<double, 3>>();
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(at[i], v[i], 1e-12) << key << " " << found;
  };
  const auto scaled = camera(node + R"(, "rotation": [0.5, 0.5, 0.5, 0.5], "scale": [2, 3, 0.5])");
  expect(scaled, "position_m", {0.3, 0.3, 2.0});
  expect(scaled, "forward", {-1.0, 0.0, 0.0});
  expect(scaled, "up", {0.0, 0.0, 1.0});
  const auto sheared = camera(R"("matrix": [2, 0, 0, 0, 1, 3, 0, 0, 0, 4, 3, 0, 0.3, 0.3, 2, 1])");
  expect(sheared, "forward", {0.0, -0.8, -0.6});
  expect(sheared, "up", {0.0, 0.6, -0.8});
}

TEST_F(InfoTest, LightlessSceneIsWarnedOf) {
  write("dark.gltf", triangleGltf({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  std::string text = read("dark.gltf");
  text.replace(text.find("[1, 1, 1]"), 9, "[0, 0, 0]");
  write("dark.gltf", text);
  const ProgramResult result = run("info dark.gltf");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("warning: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("no light"), std::string::npos) << result.err;
}

TEST_F(InfoTest, ListAllIsTheReferenceOfTheDocuments) {
  std::ifstream in(RESTLAB_SOURCE_DIR "/docs/reference.md");
  const std::string page((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_TRUE(run("list all").out == page) << "./lab list all > docs/reference.md writes it again";
  const auto all = nlohmann::json::parse(run("list all --json").out);
  EXPECT_EQ(all.at("caches"), nlohmann::json::parse(run("list caches --json").out));
}

TEST_F(InfoTest, ListsNameWhatTheirVerbsTake) {
  const auto list = [&](const std::string& what) {
    const ProgramResult result = run("list " + what + " --json");
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(run("list " + what).out, "");
    return nlohmann::json::parse(result.out);
  };
  const auto integrators = list("integrators");
  ASSERT_GE(integrators.size(), 2u);
  for (const auto& integrator : integrators) {
    for (const auto& mode : integrator["modes"]) {
      EXPECT_NE(mode["why"], "") << integrator["name"];
      const std::string bias = mode["bias"];
      EXPECT_TRUE(bias == "unbiased" || bias == "consistent" || bias == "biased") << bias;
      // Every listed method renders.
      EXPECT_EQ(
          run("render cornell-box -q -o x.exr --resolution 8x8 --integrator " +
              integrator["name"].get<std::string>() + " --mode " + mode["name"].get<std::string>())
              .code,
          0);
    }
    for (const auto& parameter : integrator["parameters"]) {
      EXPECT_NE(parameter["help"], "") << parameter["name"];
      EXPECT_NE(parameter["source"], "") << parameter["name"];
    }
  }
  const auto caches = list("caches");
  EXPECT_EQ(caches[0]["name"], "pixel");
  EXPECT_TRUE(caches[0]["layers"].empty());
  EXPECT_EQ(caches[1]["layers"][0]["name"], "entry");
  EXPECT_NE(run("list caches").out.find("layer probes in places: "), std::string::npos);
  EXPECT_NE(run("list integrators").out.find("layer confidence in samples: "), std::string::npos);
  const auto backends = list("backends");
  EXPECT_EQ(backends[0]["name"], "cpu");
  const std::string embree = "Embree " + std::to_string(RESTLAB_EMBREE_MAJOR) + ".";
  EXPECT_NE(backends[0]["summary"].get<std::string>().find(embree), std::string::npos);
  const auto denoisers = list("denoisers");
  EXPECT_EQ(denoisers[0]["name"], "none");
  EXPECT_EQ(denoisers[1]["name"], "accumulate");
  EXPECT_EQ(denoisers[1]["bias_still"], "unbiased");
  EXPECT_EQ(denoisers[1]["parameters"][0]["default"], 20.0);
  bool mse = false;
  for (const auto& metric : list("metrics")) mse = mse || metric["name"] == "mse";
  EXPECT_TRUE(mse);
  for (const auto& scene : list("scenes")) {
    if (scene["kind"] != "built-in") continue;
    EXPECT_EQ(run("info -q " + scene["name"].get<std::string>()).code, 0) << scene["name"];
  }
}

TEST_F(InfoTest, BenchTracesTransparentMeshes) {
  write("thin.gltf", triangleGltf({-1, -1, 0, 2, -1, 0, 0, 2, 0},
                                  R"(, "alphaMode": "BLEND",
                        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]})"));
  const ProgramResult result =
      run("bench thin.gltf --resolution 16x16 --frames 2 --seconds 0.02 --reference-spp 8 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_GT(json["embree_rays_per_second"]["incoherent"].get<double>(), 0.0);
  EXPECT_GT(json["embree_rays_per_second"]["shadow"].get<double>(), 0.0);
}

TEST_F(InfoTest, BenchMeasuresEveryMethod) {
  const ProgramResult result = run(
      "bench cornell-box --resolution 32x32 --frames 2 --seconds 0.02 --reference-spp 8 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  for (const char* kind : {"primary", "shadow", "incoherent"}) {
    EXPECT_GT(json["embree_rays_per_second"][kind].get<double>(), 0.0) << kind;
  }
  EXPECT_GE(json["frames"].size(), 3u) << "path and both modes of restir_gi";
  for (const auto& frame : json["frames"]) {
    EXPECT_GT(frame["rays_per_second"].get<double>(), 0.0);
    EXPECT_GE(frame["bytes_per_pixel"].get<int>(), 12);
  }
  size_t denoised = 0;
  for (const auto& frame : json["frames"]) {
    if (!frame.contains("denoising")) continue;
    ++denoised;
    const std::string name = frame["denoiser"];
    const auto& denoising = frame["denoising"];
    double passesMs = 0.0;
    for (const auto& pass : frame["passes"]) {
      if (pass["name"] != "path") passesMs += pass["time_ms_median"].get<double>();
    }
    EXPECT_GT(denoising["time_ms"].get<double>(), 0.0) << name;
    EXPECT_NEAR(denoising["time_ms"].get<double>() + denoising["guides_ms"].get<double>(), passesMs,
                1e-9)
        << name;
    EXPECT_GT(denoising["buffers_once_ms"].get<double>(), 0.0) << name;
  }
  EXPECT_GE(denoised, 6u) << "accumulate, firefly, atrous, svgf, asvgf, svgf_restir";
  EXPECT_GT(json["path_error"]["mse_times_cpu_seconds"].get<double>(), 0.0);
  EXPECT_LT(json["path_error"]["pixels_without_lights"].get<int>(), 32 * 32);
}

TEST_F(InfoTest, HelpAndVersion) {
  const ProgramResult help = run("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* verb : {"run", "render", "reference", "compare", "info", "list", "bench"}) {
    EXPECT_NE(help.out.find(verb), std::string::npos) << verb;
    const ProgramResult own = run(std::string(verb) + " --help");
    EXPECT_EQ(own.code, 0);
    EXPECT_NE(own.out.find("Exit codes"), std::string::npos) << verb;
  }
  EXPECT_EQ(run("--version").code, 0);
  const ProgramResult nothing = run("");
  EXPECT_EQ(nothing.code, 2);
  EXPECT_EQ(nothing.out, "");
  expectError(run("rendr cornell-box"), 2, {"'rendr'", "'render'"});
  expectError(run("list integratrs"), 2, {"integratrs", "'integrators'"});
  expectError(run("list"), 2, {"say what"});
}

// The launcher rejects unknown verbs before it builds the program.
TEST_F(InfoTest, TheLauncherKnowsTheVerbs) {
  const auto verbsAfter = [](const std::string& text, const std::string& begin,
                             const std::regex& one) {
    std::set<std::string> verbs;
    const size_t at = text.find(begin);
    if (at == std::string::npos) return verbs;
    const std::string rest = text.substr(at + begin.size());
    for (std::sregex_iterator it(rest.begin(), rest.end(), one), end; it != end; ++it)
      verbs.insert((*it)[1]);
    return verbs;
  };
  std::ifstream file(std::filesystem::path(RESTLAB_SOURCE_DIR) / "lab");
  std::string launcher((std::istreambuf_iterator<char>(file)), {});
  launcher.erase(launcher.find("\nusage()"));
  std::set<std::string> known = verbsAfter(launcher, "program_verbs='", std::regex("([a-z]+)[ ']"));
  known.insert("run");
  EXPECT_EQ(known, verbsAfter(run("--help").out, "Subcommands:", std::regex("\n  ([a-z]+) ")));
}

}  // namespace

}  // namespace restlab::cli_test
