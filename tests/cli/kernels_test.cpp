// Kernels that are compiled for a scene, as a user sees them.
#include <sys/stat.h>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {
namespace {

class KernelsTest : public ProgramTest {
 protected:
  // Glass needs a kernel that is not built in.
  ProgramResult render(const std::string& options) const {
    return run("render glass --resolution 24x16 " + options);
  }
  Image image(const std::string& file) const { return readExr(path(file)).layers.at(""); }
};

TEST_F(KernelsTest, AreCompiledOnceAndRenderTheSameImage) {
  const ProgramResult first = render("--kernels exact -o first.exr");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.err.find("compiling 1 kernel for the features of the scene; kept in " +
                           path("cache/restlab/units").string()),
            std::string::npos)
      << first.err;
  EXPECT_NE(first.err.find("cpu: 1 kernel ready in"), std::string::npos) << first.err;
  const ProgramResult second = render("--kernels exact -o second.exr");
  EXPECT_EQ(second.err.find("compiling"), std::string::npos) << second.err;
  EXPECT_EQ(second.err.find("ready"), std::string::npos) << second.err;
  ASSERT_EQ(render("--kernels built-in -o built-in.exr").code, 0);
  EXPECT_EQ(image("first.exr").pixels, image("second.exr").pixels);
  EXPECT_EQ(image("first.exr").pixels, image("built-in.exr").pixels);
  const LayeredImage own = readExr(path("first.exr"));
  EXPECT_EQ(own.metadata.at("kernel"), "exact");
  EXPECT_NE(own.metadata.at("features_left_out").find("environment"), std::string::npos);
  EXPECT_EQ(readExr(path("built-in.exr")).metadata.at("features_left_out"), "none");
}

TEST_F(KernelsTest, WithoutACompilerBuiltInOnesRunAndOneLineSaysSo) {
  ASSERT_EQ(render("--kernels built-in -o right.exr").code, 0);
  const Variable exact("RESTLAB_KERNELS", "exact");
  {
    const Variable compiler("RESTLAB_CXX", "/nowhere/c++");
    const ProgramResult result = render("-o none.exr");
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.err.find("warning: kernels are not compiled for the scene (/nowhere/c++: "),
              std::string::npos)
        << result.err;
  }
  write("broken", "#!/bin/sh\necho 'x.cpp:1: error: no' >&2\nexit 1\n");
  chmod(path("broken").c_str(), 0700);
  const Variable compiler("RESTLAB_CXX", path("broken").c_str());
  const ProgramResult result = render("-o broken.exr");
  EXPECT_EQ(result.code, 0) << result.err;
  const std::string line = "warning: kernels are not compiled for the scene (" +
                           path("broken").string() + ": x.cpp:1: error: no)";
  const size_t at = result.err.find(line);
  EXPECT_NE(at, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("warning: ", at + 1), std::string::npos) << "said twice";
  EXPECT_EQ(image("none.exr").pixels, image("right.exr").pixels);
  EXPECT_EQ(image("broken.exr").pixels, image("right.exr").pixels);
}

TEST_F(KernelsTest, AnInterruptEndsTheCompiler) {
  write("slow", "#!/bin/sh\necho begun >&2; touch " + path("begun").string() + "\nsleep 60\n");
  chmod(path("slow").c_str(), 0700);
  const Variable compiler("RESTLAB_CXX", path("slow").c_str());
  const ProgramResult result = runUntil([&] { return std::filesystem::exists(path("begun")); },
                                        "render glass --resolution 24x16 -o x.exr --kernels exact");
  expectError(result, 130, {"interrupted"});
  EXPECT_FALSE(std::filesystem::exists(path("x.exr")));
}

TEST_F(KernelsTest, UnknownChoicesAreNamed) {
  expectError(render("--kernels exect -o x.exr"), 2, {"--kernels exect", "built-in", "'exact'"});
  const Variable wrong("RESTLAB_KERNELS", "fast");
  expectError(render("-o x.exr"), 2, {"RESTLAB_KERNELS fast", "general"});
}

// Info compiles nothing.
TEST_F(KernelsTest, InfoSaysWhatEachSceneLeavesOut) {
  const Variable exact("RESTLAB_KERNELS", "exact");
  const ProgramResult result = run("info glass");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out.find("left out  none"), std::string::npos) << result.out;
  EXPECT_EQ(result.err.find("compiling"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace restlab::cli_test
