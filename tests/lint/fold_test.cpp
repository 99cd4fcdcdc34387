// Shaders without dead code: what is gone, what stays, and that they are valid.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <string>
#include <vector>

#include "core/backend/glsl_compiler.h"
#include "core/backend/glsl_preamble.h"
#include "core/backend/spirv_fold.h"
#include "tests/lint/dialect_files.h"

namespace restlab::lint {
namespace {

constexpr uint32_t kOpName = 5;
constexpr uint32_t kOpFunction = 54;

std::vector<uint32_t> shaderOf(rl::FeatureMask features) {
  for (const Kernel& kernel : kernels()) {
    if (kernel.name != "path") continue;
    GlslKernel glsl{kernel.header, kernel.file, kGlslTraceBvh.file, "", true};
    glsl.features = features;
    return compileGlsl(glslKernelSource(glsl), "kernel",
                       readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR}))
        .spirv;
  }
  return {};
}

// Names of the functions of a module, without their parameters.
std::set<std::string> functionsOf(const std::vector<uint32_t>& spirv) {
  std::set<uint32_t> functions;
  for (size_t i = 5; i < spirv.size(); i += spirv[i] >> 16)
    if ((spirv[i] & 0xffffu) == kOpFunction) functions.insert(spirv[i + 2]);
  std::set<std::string> names;
  for (size_t i = 5; i < spirv.size(); i += spirv[i] >> 16) {
    if ((spirv[i] & 0xffffu) != kOpName || !functions.count(spirv[i + 1])) continue;
    const std::string name = reinterpret_cast<const char*>(&spirv[i + 2]);
    names.insert(name.substr(0, name.find('(')));
  }
  return names;
}

std::vector<uint32_t> folded(std::vector<uint32_t> spirv) {
  std::string reason;
  EXPECT_TRUE(foldSpirv(spirv, reason)) << reason;
  return spirv;
}

TEST(Fold, LeavesOutWhatAMaskDoesNotNeed) {
  const rl::FeatureMask glossy = rl::RL_FEATURE_AREA_LIGHTS | rl::RL_FEATURE_GLOSSY;
  const auto without = functionsOf(folded(shaderOf(glossy)));
  const auto with =
      functionsOf(folded(shaderOf(glossy | rl::RL_FEATURE_LAYERS | rl::RL_FEATURE_LIGHT_TREE |
                                  rl::RL_FEATURE_CLOSURE_MIXTURE)));
  // Each is reached only by a condition that callers ask a function for.
  for (const char* name : {"thinFilmReflectance", "sheenEval", "clearcoatEval", "lightTreeDraw",
                           "mixtureMaterial", "facetsD"}) {
    EXPECT_FALSE(without.count(name)) << name;
    EXPECT_TRUE(with.count(name)) << name;
  }
  EXPECT_TRUE(without.count("kernelMain"));
}

TEST(Fold, ModulesAreValidAndNeverContracted) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
  std::string message;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* text) { message = text; });
  const std::vector<uint32_t> spirv = folded(shaderOf(rl::RL_FEATURE_ALL));
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  EXPECT_TRUE(tools.Validate(spirv.data(), spirv.size(), options)) << message;
  EXPECT_EQ(decorateNoContraction(spirv), spirv);
  for (size_t i = 5; i < spirv.size(); i += spirv[i] >> 16)
    EXPECT_FALSE((spirv[i] & 0xffffu) == kOpFunction && (spirv[i + 3] & 3u) != 0) << "a mark";
}

TEST(Fold, SaysWhyAModuleStaysAsItIs) {
  std::vector<uint32_t> spirv = shaderOf(rl::RL_FEATURE_AREA_LIGHTS);
  ASSERT_GT(spirv.size(), 100u);
  spirv.resize(100);
  spirv[80] = 0xffffffffu;
  const std::vector<uint32_t> before = spirv;
  std::string reason;
  EXPECT_FALSE(foldSpirv(spirv, reason));
  EXPECT_FALSE(reason.empty());
  EXPECT_EQ(spirv, before);
}

}  // namespace
}  // namespace restlab::lint
