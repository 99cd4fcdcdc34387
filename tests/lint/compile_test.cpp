// Compiles every dialect file by three compilers: g++ and clang++ as C++, glslang as GLSL.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/backend/glsl_compiler.h"
#include "core/backend/glsl_preamble.h"
#include "tests/lint/command.h"
#include "tests/lint/dialect_files.h"

namespace restlab::lint {
namespace {

std::string identifierOf(std::string path) {
  std::replace_if(
      path.begin(), path.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); },
      '_');
  return path;
}

std::filesystem::path writeUnit(const std::string& compiler, const std::string& name,
                                const std::string& suffix, const std::string& text) {
  const std::filesystem::path folder = RESTLAB_LINT_FOLDER;
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / (identifierOf(compiler + "_" + name) + suffix);
  std::ofstream(file) << text;
  return file;
}

// Compiles in the repository's root with relative includes: messages start with core/...
CommandResult compile(const std::string& compiler, const std::string& arguments) {
  return runCommand("cd '" RESTLAB_SOURCE_DIR "' && " + compiler +
                    " -std=c++20 -I. -I'" RESTLAB_GENERATED_DIR "' " RESTLAB_WARNINGS " " +
                    arguments);
}

// Compiles C++ text without producing code; messages name the dialect's files. `before`: a header
// included first, "" for none.
CommandResult checkCpp(const std::string& compiler, const std::string& name,
                       const std::string& text, const std::string& before = "") {
  const std::filesystem::path file = writeUnit(compiler, name, ".cpp", text);
  const std::string include = before.empty() ? "" : "-include '" + before + "' ";
  return compile(compiler, "-fsyntax-only " + include + "'" + file.string() + "'");
}

// Writes a header with the includes of all kernels, and precompiles it: reading these headers takes
// three quarters of a kernel's compile time.
std::string precompiledHeader(const std::string& compiler) {
  const std::string header = writeUnit(compiler, "kernels", ".h",
                                       "#include \"core/backend/embree.h\"\n"
                                       "#include \"core/backend/trace_callbacks.h\"\n"
                                       "#include \"core/backend/cpu_kernel.h\"\n"
                                       "#include \"core/dialect/order.h\"\n")
                                 .string();
  const CommandResult result =
      compile(compiler, "-x c++-header '" + header + "' -o '" + header + ".gch'");
  EXPECT_EQ(result.status, 0) << result.output;
  return header;
}

// Returns a #define of a file name.
std::string define(const char* word, const std::string& path) {
  return std::string("\n#define ") + word + " \"" + path + "\"";
}

// `trace`: file with traceRay(); "": the default of kernels.
std::string kernelUnit(const Kernel& kernel, const std::string& trace) {
  const std::string traceLine = trace.empty() ? "" : "#define RL_KERNEL_TRACE \"" + trace + "\"\n";
  return traceLine + "#define RL_KERNEL_NAME " + kernel.name +
         "\n#define RL_KERNEL_MASKS(M) M(least, 0u) M(most, 16383u)" +
         define("RL_KERNEL_HEADER", kernel.header) + define("RL_KERNEL_FILE", kernel.file) +
         "\n#include \"core/backend/cpu_kernel.inl\"\n";
}

const Kernel& kernelNamed(const std::string& name) {
  for (const Kernel& kernel : kernels()) {
    if (kernel.name == name) return kernel;
  }
  throw std::invalid_argument("no kernel is named " + name);
}

class Cpp : public testing::TestWithParam<std::string> {};
class CppHeaders : public Cpp {};

TEST_P(CppHeaders, EveryOneCompilesAlone) {
  // Include the header twice, to detect a missing or misspelt include guard.
  for (const std::string& header : dialectHeaders()) {
    const std::string include = "#include \"" + header + "\"\n";
    const CommandResult result = checkCpp(GetParam(), header, include + include);
    EXPECT_EQ(result.status, 0) << header << ":\n" << result.output;
  }
}

TEST_P(Cpp, EveryKernelCompiles) {
  const std::string before = precompiledHeader(GetParam());
  const auto check = [&](const Kernel& kernel, const std::string& trace) {
    const std::string name = kernel.name + "_" + trace;
    const CommandResult result = checkCpp(GetParam(), name, kernelUnit(kernel, trace), before);
    EXPECT_EQ(result.status, 0) << name << ":\n" << result.output;
  };
  for (const Kernel& kernel : kernels()) check(kernel, "");
  // Kernels that trace share the text of it.
  for (const std::string& trace : traceFiles()) check(kernelNamed("path"), trace);
}

TEST_P(Cpp, ErrorsNameFileAndLine) {
  const Kernel broken{"broken", "tests/lint/data/broken.glsl", kernels().front().header};
  const CommandResult result = checkCpp(GetParam(), "broken", kernelUnit(broken, ""));
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.output.find("tests/lint/data/broken.glsl:3:"), std::string::npos)
      << result.output;
}

const char* compilerName(const testing::TestParamInfo<std::string>& test) {
  return test.param.find("clang") != std::string::npos ? "clang" : "gcc";
}
INSTANTIATE_TEST_SUITE_P(, Cpp, testing::Values(RESTLAB_GXX, RESTLAB_CLANGXX), compilerName);
// Every kernel compiles by day, so a missing include only shows where files are put in another
// order.
INSTANTIATE_TEST_SUITE_P(Nightly, CppHeaders, testing::Values(RESTLAB_CLANGXX), compilerName);

GlslResult compileKernel(const Kernel& kernel, const std::string& trace = traceFiles().front()) {
  const std::string text = glslKernelSource({kernel.header, kernel.file, trace, "", false});
  return compileGlsl(text, "kernel", readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR}));
}

TEST(Glsl, EveryKernelCompiles) {
  for (const Kernel& kernel : kernels()) {
    std::vector<std::string> traces = traceFiles();
    traces.emplace_back("tests/parity/brute_force.glsl");
    for (const std::string& trace : traces) {
      const GlslResult result = compileKernel(kernel, trace);
      EXPECT_FALSE(result.spirv.empty()) << kernel.name << ", " << trace << ":\n" << result.log;
      EXPECT_EQ(result.log.find("WARNING"), std::string::npos)
          << kernel.name << ", " << trace << ":\n"
          << result.log;
    }
  }
}

TEST(Glsl, EveryKernelCompilesWithTexels) {
  for (const Kernel& kernel : kernels()) {
    for (const GlslTrace& trace : {kGlslTraceBvh, kGlslTraceQuery}) {
      const std::string text =
          glslKernelSource({kernel.header, kernel.file, trace.file, trace.extensions, true});
      const GlslResult result =
          compileGlsl(text, "kernel", readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR}));
      EXPECT_FALSE(result.spirv.empty()) << kernel.name << ":\n" << result.log;
      EXPECT_EQ(result.log.find("WARNING"), std::string::npos) << kernel.name << ":\n"
                                                               << result.log;
    }
  }
}

TEST(Glsl, EveryKernelCompilesWithRayQueries) {
  for (const Kernel& kernel : kernels()) {
    const std::string text = glslKernelSource(
        {kernel.header, kernel.file, kGlslTraceQuery.file, kGlslTraceQuery.extensions, false});
    const GlslResult result =
        compileGlsl(text, "kernel", readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR}));
    EXPECT_FALSE(result.spirv.empty()) << kernel.name << ":\n" << result.log;
    EXPECT_EQ(result.log.find("WARNING"), std::string::npos) << kernel.name << ":\n" << result.log;
  }
}

TEST(Glsl, ErrorsNameFileAndLine) {
  const GlslResult result =
      compileKernel({"broken", "tests/lint/data/broken.glsl", kernels().front().header});
  EXPECT_TRUE(result.spirv.empty());
  EXPECT_NE(result.log.find("tests/lint/data/broken.glsl:3:"), std::string::npos) << result.log;
}

TEST(Glsl, EveryFileIsInAKernel) {
  // A .glsl that no kernel includes is never compiled.
  for (const std::string& file : allGlslFiles()) {
    const auto& known = dialectFiles();
    EXPECT_NE(std::find(known.begin(), known.end(), file), known.end())
        << file << " is in no kernel";
  }
}

TEST(Glsl, FloatArithmeticIsNeverContracted) {
  const GlslResult result = compileKernel(kernels().front());
  ASSERT_FALSE(result.spirv.empty()) << result.log;
  size_t operations = 0, decorations = 0;
  for (size_t i = 5; i < result.spirv.size(); i += result.spirv[i] >> 16) {
    const uint32_t op = result.spirv[i] & 0xffffu;
    operations += op == 129 || op == 131 || op == 133;  // OpFAdd, OpFSub, OpFMul
    decorations += op == 71 && result.spirv[i + 2] == 42;
  }
  EXPECT_GT(operations, 100u);
  EXPECT_GE(decorations, operations);
  EXPECT_EQ(decorateNoContraction(result.spirv), result.spirv)
      << "decorating twice must change nothing";
}

}  // namespace
}  // namespace restlab::lint
