// GLSL to SPIR-V at run time, through glslang.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/backend/glsl_stage.h"

namespace restlab {

struct GlslResult {
  std::vector<uint32_t> spirv;  // empty when it did not compile
  std::string log;  // glslang's messages, "ERROR: file:line: ..." with the included file's name
};

// Reads the file of #include "path"; nullopt if there is none.
using SourceReader = std::function<std::optional<std::string>(const std::string& path)>;
SourceReader readBelow(const std::vector<std::filesystem::path>& roots);

// Compiles a shader for Vulkan 1.2; `name` stands for the text itself in messages. Every
// float operation is decorated NoContraction: fused multiplications and additions would lead to
// other decisions than on the CPU.
GlslResult compileGlsl(const std::string& text, const std::string& name, const SourceReader& read,
                       GlslStage stage = GlslStage::compute);

// Adds NoContraction to the float arithmetic of a module that lacks it.
std::vector<uint32_t> decorateNoContraction(const std::vector<uint32_t>& spirv);

}  // namespace restlab
