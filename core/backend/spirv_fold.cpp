#include "core/backend/spirv_fold.h"

#include <spirv-tools/optimizer.hpp>

#include "core/backend/glsl_compiler.h"

namespace restlab {

namespace {

constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpFunction = 54;
constexpr uint32_t kOpFunctionEnd = 56;
constexpr size_t kControlWord = 3;  // of OpFunction
constexpr uint32_t kInlineBits = 3;
constexpr uint32_t kDontInline = 2;

// Instructions of a function that is put where it is called. lavapipe takes as long with 8 to 24,
// and longer with 40.
constexpr size_t kSmall = 16;
// The second round finds functions that the first made small. A third changes nothing.
constexpr int kRounds = 2;

// Forbids to inline functions of more instructions, and takes all other marks away.
void markLarge(std::vector<uint32_t>& spirv, size_t mostInstructions) {
  size_t control = 0;
  size_t count = 0;
  for (size_t i = kHeaderWords; i < spirv.size();) {
    const uint32_t op = spirv[i] & 0xffffu;
    const size_t words = spirv[i] >> 16;
    if (words == 0 || i + words > spirv.size()) return;
    if (op == kOpFunction) {
      control = i + kControlWord;
      count = 0;
    } else if (op == kOpFunctionEnd) {
      const uint32_t mark = count > mostInstructions ? kDontInline : 0;
      spirv[control] = (spirv[control] & ~kInlineBits) | mark;
    } else {
      ++count;
    }
    i += words;
  }
}

}  // namespace

bool foldSpirv(std::vector<uint32_t>& spirv, std::string& reason) {
  std::vector<uint32_t> folded = spirv;
  for (int round = 0; round < kRounds; ++round) {
    markLarge(folded, kSmall);
    // Passes remember the functions of the last module: each round has its own.
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.SetMessageConsumer([&reason](spv_message_level_t level, const char*,
                                           const spv_position_t&, const char* message) {
      // It warns of each small function with several returns: it cannot inline those.
      if (level <= SPV_MSG_ERROR) reason = message;
    });
    optimizer.RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateSSARewritePass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    if (!optimizer.Run(folded.data(), folded.size(), &folded, options)) {
      if (reason.empty()) reason = "SPIRV-Tools gives no reason";
      return false;
    }
  }
  markLarge(folded, folded.size());
  spirv = decorateNoContraction(folded);
  return true;
}

}  // namespace restlab
