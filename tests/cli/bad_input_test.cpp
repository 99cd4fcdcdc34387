// Bad inputs: one clear line, the right exit code, no image left behind.
#include <limits>

#include "core/base/memory.h"
#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

struct BadInput {
  const char* name;
  const char* arguments;
  int code;
  std::vector<std::string> fragments;
};

class BadInputTest : public ProgramTest, public ::testing::WithParamInterface<BadInput> {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string good = triangleGltf(corners);
    write("good.gltf", good);
    write("truncated.gltf", good.substr(0, good.size() / 2));
    write("empty.gltf", "");
    write("nan.gltf",
          triangleGltf({0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 1, 0}));
    write("short.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12));
    std::string required = good;
    required.insert(1,
                    "\"extensionsRequired\": [\"KHR_texture_basisu\"], "
                    "\"extensionsUsed\": [\"KHR_texture_basisu\"], ");
    write("required.gltf", required);
    write("text.exr", "this is no image");
    write("negative.exr", "");
    LayeredImage sky;
    sky.layers[""] = Image(4, 2, glm::vec3(1.0f));
    writeExr(path("sky.exr"), sky);
    writeExr(path("sky.EXR"), sky);
    std::string lying = read("sky.exr");
    const char window[] = "dataWindow\0box2i\0\x10\0\0";
    const size_t maxX = lying.find(std::string(window, sizeof window)) + sizeof window + 8;
    write("lying.exr", lying.replace(maxX, 8, std::string("\xff\x3f\0\0\xff\x3f\0\0", 8)));
    write("lying.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n....");
    std::filesystem::create_directory(path("sub"));
    LayeredImage negative;
    negative.layers[""] = Image(4, 2, glm::vec3(-1.0f));
    writeExr(path("negative.exr"), negative);
    write("file", "");
    std::string narrow = good;
    narrow.insert(narrow.find("\"yfov\""), "\"aspectRatio\": 1e-9, ");
    write("narrow.gltf", narrow);
    std::string wide = good;
    wide.insert(wide.find("\"yfov\""), "\"aspectRatio\": 1e9, ");
    write("wide.gltf", wide);
  }
};

TEST_P(BadInputTest, IsOneLineAndAnExitCode) {
  const BadInput& input = GetParam();
  expectError(run(input.arguments), input.code, input.fragments);
  EXPECT_FALSE(std::filesystem::exists(path("x.exr"))) << "an image that looks complete";
}

const BadInput kBadInputs[] = {
    {"UnknownOption", "render good.gltf -o x.exr --sed 3", 2, {"'--sed'", "'--seed'"}},
    {"UnknownShortOption", "render good.gltf -o x.exr -z 3", 2, {"'-z'"}},
    {"NoScene", "render -o x.exr", 2, {"scene"}},
    {"NoOutput", "render good.gltf", 2, {"--output"}},
    {"TwoScenes", "render good.gltf good.gltf -o x.exr", 2, {"good.gltf"}},
    {"ZeroResolution", "render good.gltf -o x.exr --resolution 0x0", 2, {"0x0", "WxH"}},
    {"ZeroHeight", "render good.gltf -o x.exr --resolution 8x0", 2, {"8x0"}},
    {"ZeroWidthOption", "render good.gltf -o x.exr --width 0", 2, {"--width"}},
    {"HugeResolution", "render good.gltf -o x.exr --resolution 99999x8", 2, {"99999x8"}},
    {"NegativeResolution", "render good.gltf -o x.exr --resolution -8x8", 2, {"-8x8"}},
    {"NoResolution", "render good.gltf -o x.exr --resolution 8by8", 2, {"8by8"}},
    {"ResolutionTwice", "render good.gltf -o x.exr --resolution 8x8 --width 8", 2, {"exclude"}},
    {"ZeroSpp", "render good.gltf -o x.exr --spp 0", 2, {"--spp"}},
    {"NegativeSpp", "render good.gltf -o x.exr --spp -4", 2, {"--spp"}},
    {"WordSpp",
     "render good.gltf -o x.exr --spp many",
     2,
     {"--spp", "'many' is no whole number from 1"}},
    {"HalfASpp", "render good.gltf -o x.exr --spp 1.5", 2, {"--spp", "'1.5' is no whole number"}},
    {"SppWithoutItsNumber", "render good.gltf -o x.exr --spp", 2, {"--spp needs a value"}},
    {"AnotherUnit",
     "reference good.gltf -o x.exr --time-limit 5deg",
     2,
     {"--time-limit", "'5deg' is no number of seconds"}},
    {"SetOfAPartOfAName",
     "render good.gltf -o x.exr --integrator restir_gi --set cap=20",
     2,
     {"has no parameter 'cap'", "confidence_cap"}},
    {"PictureAsOutput", "render good.gltf -o x.png", 2, {"must be named *.exr", "--png=FILE"}},
    {"SuiteThatIsAScene", "run door-ajar", 2, {"is a scene", "restlab render door-ajar"}},
    {"SuiteThatIsAFileOfAScene", "run good.gltf", 2, {"is a scene", "restlab render good.gltf"}},
    {"ListOfNothing", "list", 2, {"list: say what: integrators, caches"}},
    {"ZeroFrames", "render good.gltf -o x.exr --frames 0", 2, {"--frames"}},
    {"FramesAndSpp", "render good.gltf -o x.exr --frames 2 --spp 2", 2, {"--spp", "--frames"}},
    {"NegativeSeed", "render good.gltf -o x.exr --seed -1", 2, {"seed"}},
    {"NegativeBounces", "render good.gltf -o x.exr --max-bounces -1", 2, {"--max-bounces"}},
    {"NegativeThreads", "render good.gltf -o x.exr -t -1", 2, {"--threads"}},
    {"UnknownIntegrator",
     "render good.gltf -o x.exr --integrator resir_gi",
     2,
     {"'resir_gi'", "'restir_gi'"}},
    {"UnknownMode",
     "render good.gltf -o x.exr --integrator restir_gi --mode bised",
     2,
     {"bised", "'biased'"}},
    {"ModePathLacks", "render good.gltf -o x.exr --mode biased", 2, {"biased", "path"}},
    {"CacheWithoutUse", "render good.gltf -o x.exr --cache pixel", 2, {"cache pixel", "path"}},
    {"UnknownDenoiser", "render good.gltf -o x.exr --denoiser acumulate", 2, {"'accumulate'"}},
    {"DenoiserParameterOfNobody",
     "render good.gltf -o x.exr --set accumulate_cap=3.0",
     2,
     {"accumulate_cap"}},
    {"DenoiserParameterOutOfRange",
     "render good.gltf -o x.exr --denoiser accumulate --set accumulate_cap=-3.0",
     2,
     {"accumulate_cap", "0"}},
    {"UnknownCache",
     "render good.gltf -o x.exr --integrator restir_gi --cache pixl",
     2,
     {"'pixl'", "'pixel'"}},
    {"UnknownBackend", "render good.gltf -o x.exr --backend cpuu", 2, {"cpuu", "'cpu'"}},
    {"DeviceOfTheCpu", "render good.gltf -o x.exr --device x", 2, {"--device x", "vulkan"}},
    {"ValidateOnTheCpu", "render good.gltf -o x.exr --validate", 2, {"--validate", "vulkan"}},
    {"UnknownRayTracing",
     "render good.gltf -o x.exr --ray-tracing foo",
     2,
     {"--ray-tracing foo", "embree, bvh, query"}},
    {"RayTracingOfAnotherBackend",
     "render good.gltf -o x.exr --ray-tracing query",
     2,
     {"--ray-tracing query", "embree and bvh"}},
    {"ReferenceOnUnknownBackend",
     "reference good.gltf -o x.exr --spp 4 --backend vulkn",
     2,
     {"vulkn", "'vulkan'"}},
    {"UnknownComponent",
     "render good.gltf -o x.exr --component indirct",
     2,
     {"'indirct'", "'indirect'"}},
    {"UnknownFilter", "render good.gltf -o x.exr --filter bx", 2, {"'bx'", "'box'"}},
    {"UnknownAov", "render good.gltf -o x.exr --aov albedo,norma", 2, {"norma", "'normalW'"}},
    {"LayerOfAnotherCache",
     "render good.gltf -o x.exr --integrator restir_gi --aov entry",
     2,
     {"--aov entry", "known: radiance",
      "object, emission, motion, ambient, confidence, age, rejected_shifts, partner, kind, "
      "shift_outcome)"}},
    {"UnknownLayer",
     "render good.gltf -o x.exr --integrator restir_gi --cache voxel --aov entry_confidense",
     2,
     {"entry_confidense", "'entry_confidence'"}},
    {"EmptyAov", "render good.gltf -o x.exr --aov albedo,,normalW", 2, {"--aov"}},
    {"UnknownCamera", "render good.gltf -o x.exr --camera main", 2, {"'main'"}},
    {"CameraIndex", "render good.gltf -o x.exr --camera 5", 2, {"camera", "5"}},
    {"UnknownParameter",
     "render good.gltf -o x.exr --integrator restir_gi --set confidence_cp=3",
     2,
     {"'confidence_cp'", "'confidence_cap'"}},
    {"ParameterType",
     "render good.gltf -o x.exr --integrator restir_gi --set temporal=3",
     2,
     {"temporal", "true or false"}},
    {"ParameterRange",
     "render good.gltf -o x.exr --integrator restir_gi --set confidence_cap=-1",
     2,
     {"confidence_cap", "-1"}},
    {"ParameterForm", "render good.gltf -o x.exr --set confidence_cap", 2, {"KEY=VALUE"}},
    {"MissingScene", "render absent.gltf -o x.exr", 3, {"absent.gltf"}},
    {"UnknownScene", "render cornel-box -o x.exr", 3, {"'cornel-box'", "'cornell-box'"}},
    {"DirectoryScene", "render . -o x.exr", 3, {"."}},
    {"TruncatedScene", "render truncated.gltf -o x.exr", 3, {"truncated.gltf"}},
    {"EmptyScene", "render empty.gltf -o x.exr", 3, {"empty.gltf"}},
    {"TruncatedBinary", "render short.glb -o x.exr", 3, {"short.glb"}},
    {"NanVertex", "render nan.gltf -o x.exr", 3, {"nan.gltf", "vert"}},
    {"RequiredExtension", "render required.gltf -o x.exr", 3, {"KHR_texture_basisu"}},
    {"MissingEnvironment", "render good.gltf -o x.exr --environment absent.hdr", 3, {"absent.hdr"}},
    {"BrokenEnvironment", "render good.gltf -o x.exr --environment text.exr", 3, {"text.exr"}},
    {"NegativeEnvironment",
     "render good.gltf -o x.exr --environment negative.exr",
     3,
     {"negative.exr"}},
    {"LyingEnvironment",
     "render good.gltf -o x.exr --environment lying.hdr",
     3,
     {"lying.hdr", "16384x16384 pixels in ", "at least"}},
    {"LyingExrEnvironment",
     "info good.gltf --environment lying.exr",
     3,
     {"lying.exr", "the file ends too early"}},
    {"LyingImage", "compare --ref sky.exr lying.exr", 3, {"lying.exr", "the file ends too early"}},
    {"LyingReference",
     "compare --ref lying.exr sky.exr",
     3,
     {"lying.exr", "the file ends too early"}},
    {"LyingMask",
     "compare --ref sky.exr sky.exr --mask lying.exr",
     3,
     {"lying.exr", "the file ends too early"}},
    {"RotationOfNothing",
     "render good.gltf -o x.exr --environment-rotation 90",
     2,
     {"environment"}},
    {"OutputFolderMissing", "render good.gltf -o absent/x.exr", 3, {"absent"}},
    {"OutputIsFolder", "render good.gltf -o .", 3, {"."}},
    {"OutputIsNoExr", "render good.gltf -o x.png", 2, {"x.png", ".exr"}},
    {"OutputIsNoExrBeside", "render good.gltf -o x.png --png", 2, {"x.png", ".exr"}},
    {"PreviewIsNoPng", "render good.gltf -o x.exr --png=x.exr", 2, {"x.exr", ".png"}},
    {"OutputIsScene", "render good.gltf -o good.gltf", 2, {"good.gltf", ".exr"}},
    {"OutputIsEnvironment",
     "render good.gltf -o ./sub/../sky.exr --environment sky.exr",
     2,
     {"sky.exr", "environment"}},
    {"ReferenceIsNoExr", "reference good.gltf -o x.png --spp 2", 2, {"x.png", ".exr"}},
    {"ReferenceIsEnvironment",
     "reference good.gltf -o sky.EXR --environment sky.EXR --spp 2",
     2,
     {"sky.EXR", "environment"}},
    {"LayersTooLarge",
     "render good.gltf -o x.exr --resolution 16384x16384 --aov albedo,depth,normalW",
     2,
     {"16384x16384", "4 layers", "8192x8192"}},
    {"ReferenceTooLarge",
     "reference good.gltf -o x.exr --spp 2 --resolution 16384x8192",
     2,
     {"16384x8192", "4 layers", "11585x5792"}},
    {"NarrowCamera", "render narrow.gltf -o x.exr", 3, {"narrow", "camera", "aspect ratio 1e-09"}},
    {"WideCamera", "render wide.gltf -o x.exr", 3, {"wide", "camera", "aspect ratio 1e+09"}},
    {"OutputUnderFile", "render good.gltf -o file/x.exr", 3, {"file"}},
    {"ReferenceWithoutTarget", "reference good.gltf -o x.exr", 2, {"--spp", "--time-limit"}},
    {"ReferenceOfOneSample", "reference good.gltf -o x.exr --spp 1", 2, {"--spp"}},
    {"ReferenceByRestir",
     "reference good.gltf -o x.exr --spp 2 --integrator restir_gi",
     2,
     {"restir_gi", "path"}},
    {"ReferenceNegativeTarget",
     "reference good.gltf -o x.exr --target-relmse -1",
     2,
     {"--target-relmse"}},
    {"RotationNan",
     "render good.gltf -o x.exr --environment-rotation nan",
     2,
     {"--environment-rotation", "nan"}},
    {"ScaleNan",
     "render good.gltf -o x.exr --environment-scale nan",
     2,
     {"--environment-scale", "nan"}},
    {"ScaleInfinite",
     "render good.gltf -o x.exr --environment-scale inf",
     2,
     {"--environment-scale", "inf"}},
    {"TargetNan", "reference good.gltf -o x.exr --target-relmse nan", 2, {"--target-relmse"}},
    {"TimeLimitNan", "reference good.gltf -o x.exr --time-limit nan", 2, {"--time-limit"}},
    {"TimeLimitWord",
     "reference good.gltf -o x.exr --time-limit 5min",
     2,
     {"--time-limit", "5min"}},
    {"SecondsNan", "bench good.gltf --seconds nan", 2, {"--seconds"}},
    {"InfoMissing", "info absent.gltf", 3, {"absent.gltf"}},
    {"BenchMissing", "bench absent.gltf", 3, {"absent.gltf"}},
};

std::string nameOf(const ::testing::TestParamInfo<BadInput>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(All, BadInputTest, ::testing::ValuesIn(kBadInputs), nameOf);

using OptionsTest = ProgramTest;

TEST_F(OptionsTest, NumbersAreReadAsPeopleWriteThem) {
  const ProgramResult result = run(
      "reference cornell-box -o r.exr --resolution 8x8 --spp 1e1 --time-limit 5m --checkpoint 1h");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(readExr(path("r.exr")).metadata.at("spp"), "10");
  expectError(run("render cornell-box -o x.exr --resolution 8x8 --environment-rotation 361deg"), 2,
              {"'361deg' is no number of degrees from -360 to 360"});
}

TEST_F(OptionsTest, AnEmptyArgumentIsNone) {
  expectError(run({"run", "x.toml", "--out", ""}), 2, {"run: an argument is empty"});
}

using OutputTest = ProgramTest;

TEST_F(OutputTest, IsCheckedBeforeRendering) {
  // A billion samples would take hours: the error must come before rendering.
  expectError(run("render cornell-box -o absent/x.exr --spp 1000000000"), 3, {"absent"});
  expectError(run("reference cornell-box -o absent/x.exr --time-limit 100000"), 3, {"absent"});
}

TEST_F(OutputTest, ZeroAreaLightIsWarnedOf) {
  write("flat.gltf", triangleGltf({0, 0, 0, 1, 0, 0, 1, 0, 0}));
  const ProgramResult result = run("render flat.gltf -o x.exr --resolution 8x8");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("warning: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("area"), std::string::npos) << result.err;
}

TEST_F(OutputTest, WarningsNameTheSceneOnceAndFitWhatWasGiven) {
  write("dark.gltf", triangleGltf({0, 0, 0, 1, 0, 0, 1, 0, 0}));
  LayeredImage black;
  black.layers[""] = Image(4, 2);
  writeExr(path("black.exr"), black);
  const std::string none = run("render dark.gltf -o x.exr --resolution 8x8").err;
  EXPECT_NE(none.find("no light"), std::string::npos) << none;
  EXPECT_NE(none.find("--environment FILE"), std::string::npos) << none;
  EXPECT_EQ(none.find("dark: dark"), std::string::npos) << none;
  const std::string given =
      run("render dark.gltf -o x.exr --resolution 8x8 --environment black.exr").err;
  EXPECT_NE(given.find("environment is black"), std::string::npos) << given;
  EXPECT_NE(given.find("no light"), std::string::npos) << given;
  EXPECT_EQ(given.find("--environment FILE"), std::string::npos) << given;
}

TEST_F(OutputTest, FullDiskIsSaid) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const char* words : {"list scenes", "list integrators --json", "info cornell-box", "--help",
                            "bench quad-light --width 8 --frames 1 --seconds 0.01"}) {
    const ProgramResult result = runInto("/dev/full", words);
    EXPECT_EQ(result.code, 3) << words;
    ASSERT_EQ(result.errors().size(), 1u) << result.err;
    EXPECT_NE(result.errors()[0].find("stdout: cannot be written"), std::string::npos)
        << result.err;
  }
}

TEST_F(OutputTest, WhatDoesNotFitIntoMemoryIsRefused) {
  const auto available = availableMemory();
  if (!available) GTEST_SKIP() << "this system does not say how much memory there is";
  // Needs 127 GiB, most of it reservoirs.
  if (*available > uint64_t(96) << 30) GTEST_SKIP() << "there may be enough memory here";
  expectError(run("render cornell-box -o x.exr --integrator restir_gi --resolution 16384x16384"), 4,
              {"restir_gi", "16384x16384", "MiB", "available", "smaller resolution"});
  EXPECT_FALSE(std::filesystem::exists(path("x.exr")));
}

TEST_F(OutputTest, AvailableMemoryIsTheLeastOfMachineAndControlGroup) {
  const std::filesystem::path root = path("root");
  EXPECT_FALSE(availableMemory(root).has_value()) << "no answer is no limit";
  write("root/proc/meminfo", "MemTotal:  4096 kB\nMemFree:  10 kB\nMemAvailable:  2048 kB\n");
  EXPECT_EQ(availableMemory(root), 2048u * 1024u);
  write("root/sys/fs/cgroup/memory.max", "max\n");
  write("root/sys/fs/cgroup/memory.current", "900000\n");
  EXPECT_EQ(availableMemory(root), 2048u * 1024u);
  write("root/sys/fs/cgroup/memory.max", "1000000\n");
  EXPECT_EQ(availableMemory(root), 100000u);
  // Cached files count as available memory.
  write("root/sys/fs/cgroup/memory.stat", "anon 5\ninactive_file 300000\nactive_file 100000\n");
  EXPECT_EQ(availableMemory(root), 500000u);
  write("root/sys/fs/cgroup/memory.current", "2000000\n");
  EXPECT_EQ(availableMemory(root), 0u);
}

TEST_F(OutputTest, FailureLeavesTheOldFile) {
  write("keep.exr", "precious");
  expectError(run("render absent.gltf -o keep.exr"), 3, {"absent.gltf"});
  EXPECT_EQ(read("keep.exr"), "precious") << "a failed render must not touch the old file";
}

}  // namespace

}  // namespace restlab::cli_test
