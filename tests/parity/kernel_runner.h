// One dialect kernel on both machines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"
#include "core/backend/glsl_preamble.h"
#include "core/dialect/types.h"
#include "tests/parity/vulkan_device.h"

namespace restlab::parity {

// SPIR-V of a kernel on the brute-force traversal. Throws std::runtime_error with the compiler's
// words.
std::vector<uint32_t> compileKernel(const std::string& header, const std::string& file);

// Runs it over frame.width x frame.height threads. `scene` is a device address (0: none), `buffers`
// the bytes of the kernel's Buffers struct with device addresses.
GlslCounters runOnDevice(VulkanDevice& device, const std::vector<uint32_t>& spirv, uint64_t scene,
                         const rl::FrameData& frame, const std::vector<uint64_t>& buffers,
                         const void* params, size_t paramBytes);

// The C++ build of the same kernel, on the calling thread; `embreeScene` for kernels that trace
// with it.
rl::CpuKernelCounters runOnHost(rl::CpuKernelEntry entry, const rl::SceneData& scene,
                                const rl::FrameData& frame, const void* buffers, const void* params,
                                void* embreeScene = nullptr);

// A frame for kernels that look at no camera.
rl::FrameData plainFrame(uint32_t width, uint32_t height, uint32_t seed);

}  // namespace restlab::parity
