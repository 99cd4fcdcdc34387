// Every bad input of the contract: one clear line, the exit code, no image left behind.
#include <limits>

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
                    "\"extensionsRequired\": [\"EXT_meshopt_compression\"], "
                    "\"extensionsUsed\": [\"EXT_meshopt_compression\"], ");
    write("required.gltf", required);
    write("text.exr", "this is no image");
    write("negative.exr", "");
    LayeredImage negative;
    negative.layers[""] = Image(4, 2, glm::vec3(-1.0f));
    writeExr(path("negative.exr"), negative);
    write("file", "");
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
    {"WordSpp", "render good.gltf -o x.exr --spp many", 2, {"--spp"}},
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
    {"UnknownCache", "render good.gltf -o x.exr --cache pixl", 2, {"'pixl'", "'pixel'"}},
    {"UnknownBackend", "render good.gltf -o x.exr --backend cpuu", 2, {"cpuu", "'cpu'"}},
    {"UnknownComponent",
     "render good.gltf -o x.exr --component indirct",
     2,
     {"'indirct'", "'indirect'"}},
    {"UnknownFilter", "render good.gltf -o x.exr --filter bx", 2, {"'bx'", "'box'"}},
    {"UnknownAov", "render good.gltf -o x.exr --aov albedo,norma", 2, {"norma", "'normalW'"}},
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
    {"RequiredExtension", "render required.gltf -o x.exr", 3, {"EXT_meshopt_compression"}},
    {"MissingEnvironment", "render good.gltf -o x.exr --environment absent.hdr", 3, {"absent.hdr"}},
    {"BrokenEnvironment", "render good.gltf -o x.exr --environment text.exr", 3, {"text.exr"}},
    {"NegativeEnvironment",
     "render good.gltf -o x.exr --environment negative.exr",
     3,
     {"negative.exr"}},
    {"RotationOfNothing",
     "render good.gltf -o x.exr --environment-rotation 90",
     2,
     {"environment"}},
    {"OutputFolderMissing", "render good.gltf -o absent/x.exr", 3, {"absent"}},
    {"OutputIsFolder", "render good.gltf -o .", 3, {"."}},
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

using OutputTest = ProgramTest;

TEST_F(OutputTest, IsCheckedBeforeRendering) {
  // A billion samples would take hours: the answer comes at once.
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

TEST_F(OutputTest, FailureLeavesTheOldFile) {
  write("keep.exr", "precious");
  expectError(run("render absent.gltf -o keep.exr"), 3, {"absent.gltf"});
  EXPECT_EQ(read("keep.exr"), "precious") << "a failed render must not touch the old file";
}

}  // namespace

}  // namespace restlab::cli_test
