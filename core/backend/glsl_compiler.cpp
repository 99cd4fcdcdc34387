#include "core/backend/glsl_compiler.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <set>

namespace restlab {

namespace {

// Names included files in messages by their path.
class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(const SourceReader& read) : read_(read) {}

  IncludeResult* includeLocal(const char* header, const char*, size_t) override {
    std::optional<std::string> found = read_(header);
    if (!found) return nullptr;  // glslang reports the line of the #include
    // releaseInclude() deletes both.
    auto* text = new std::string(std::move(*found));
    return new IncludeResult(header, text->data(), text->size(), text);
  }
  IncludeResult* includeSystem(const char*, const char*, size_t) override { return nullptr; }
  void releaseInclude(IncludeResult* result) override {
    if (!result) return;
    delete static_cast<std::string*>(result->userData);
    delete result;
  }

 private:
  const SourceReader& read_;
};

// glslang keeps process-wide tables between these two calls.
struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpDecorate = 71;
constexpr uint32_t kDecorationNoContraction = 42;

// Core instructions that NoContraction is about: OpFNegate and OpFAdd .. OpFMod, the products of
// vectors and matrices, OpDot.
bool isFloatArithmetic(uint32_t op) {
  switch (op) {
    case 127:  // OpFNegate
    case 129:  // OpFAdd
    case 131:  // OpFSub
    case 133:  // OpFMul
    case 136:  // OpFDiv
    case 140:  // OpFRem
    case 141:  // OpFMod
    case 142:  // OpVectorTimesScalar
    case 143:  // OpMatrixTimesScalar
    case 144:  // OpVectorTimesMatrix
    case 145:  // OpMatrixTimesVector
    case 146:  // OpMatrixTimesMatrix
    case 147:  // OpOuterProduct
    case 148:  // OpDot
      return true;
    default:
      return false;
  }
}

// OpDecorate .. OpGroupMemberDecorate, and their string and id forms: the annotations of a module.
bool isAnnotation(uint32_t op) {
  return (op >= 71 && op <= 75) || op == 332 || op == 5632 || op == 5633;
}

// Debug instructions and others that precede the annotations.
bool isBeforeAnnotations(uint32_t op) {
  return (op >= 3 && op <= 8) || op == 10 || op == 11 || (op >= 14 && op <= 17) || op == 330 ||
         op == 331;
}

EShLanguage languageOf(GlslStage stage) {
  if (stage == GlslStage::vertex) return EShLangVertex;
  return stage == GlslStage::fragment ? EShLangFragment : EShLangCompute;
}

}  // namespace

SourceReader readBelow(const std::vector<std::filesystem::path>& roots) {
  return [roots](const std::string& path) -> std::optional<std::string> {
    for (const std::filesystem::path& root : roots) {
      std::ifstream stream(root / path, std::ios::binary);
      if (!stream) continue;
      return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    return std::nullopt;
  };
}

std::vector<uint32_t> decorateNoContraction(const std::vector<uint32_t>& spirv) {
  std::set<uint32_t> decorated;
  std::vector<uint32_t> additions;
  size_t insertAt = kHeaderWords;
  for (size_t i = kHeaderWords; i < spirv.size();) {
    const uint32_t op = spirv[i] & 0xffffu;
    const size_t words = spirv[i] >> 16;
    if (words == 0 || i + words > spirv.size())
      return spirv;  // not a module; the driver will report it
    if (isBeforeAnnotations(op) || isAnnotation(op)) insertAt = i + words;
    if (op == kOpDecorate && words >= 3 && spirv[i + 2] == kDecorationNoContraction) {
      decorated.insert(spirv[i + 1]);
    }
    if (isFloatArithmetic(op) && !decorated.count(spirv[i + 2])) {
      additions.insert(additions.end(),
                       {(3u << 16) | kOpDecorate, spirv[i + 2], kDecorationNoContraction});
    }
    i += words;
  }
  std::vector<uint32_t> result(spirv.begin(), spirv.begin() + std::ptrdiff_t(insertAt));
  result.insert(result.end(), additions.begin(), additions.end());
  result.insert(result.end(), spirv.begin() + std::ptrdiff_t(insertAt), spirv.end());
  return result;
}

GlslResult compileGlsl(const std::string& text, const std::string& name, const SourceReader& read,
                       GlslStage stage) {
  static const Process process;
  const EShLanguage language = languageOf(stage);
  glslang::TShader shader(language);
  const char* strings[] = {text.c_str()};
  const int lengths[] = {static_cast<int>(text.size())};
  const char* names[] = {name.c_str()};
  shader.setStringsWithLengthsAndNames(strings, lengths, names, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  Includer includer(read);
  GlslResult result;
  bool ok = shader.parse(GetDefaultResources(), 460, ENoProfile, false, false, messages, includer);
  result.log = shader.getInfoLog();
  if (!ok) return result;
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) {
    result.log += program.getInfoLog();
    return result;
  }
  glslang::SpvOptions options;
  options.validate = false;
  options.disableOptimizer = true;
  glslang::GlslangToSpv(*program.getIntermediate(language), result.spirv, &options);
  result.spirv = decorateNoContraction(result.spirv);
  return result;
}

}  // namespace restlab
