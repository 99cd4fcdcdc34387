// One dialect kernel on both machines.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"
#include "core/backend/glsl_preamble.h"
#include "core/backend/vulkan_kernels.h"
#include "core/backend/vulkan_memory.h"
#include "core/dialect/types.h"

namespace restlab::parity {

// A device with its memory and kernels; nothing of them is kept on disk.
struct TestDevice {
  std::shared_ptr<VulkanDevice> device;
  std::shared_ptr<VulkanMemory> memory;
  std::shared_ptr<VulkanKernels> kernels;
  StartupReport report;  // of what ran

  const std::string& name() const { return device->name(); }
};

TestDevice openDevice(const std::string& name = {}, const std::filesystem::path& cacheFolder = {});
// Every device that the program can use; empty where there is none.
std::vector<TestDevice> testDevices();
// Why a test is skipped where that is empty.
constexpr const char* kNoDevice =
    "no Vulkan device with buffer addresses and scalar layout: kernels ran as C++ only";

// SPIR-V of a kernel on the brute-force traversal. Throws std::runtime_error with the compiler's
// words.
std::vector<uint32_t> compileKernel(const std::string& header, const std::string& file);

// Runs it, with the general mask, over frame.width x frame.height threads. `scene` is a device
// address (0: none), `buffers` the bytes of the kernel's Buffers struct with device addresses.
GlslCounters runOnDevice(TestDevice& device, const std::string& header, const std::string& file,
                         uint64_t scene, const rl::FrameData& frame,
                         const std::vector<uint64_t>& buffers, const void* params,
                         size_t paramBytes);

// The C++ build of the same kernel, on the calling thread; `embreeScene` for kernels that trace
// with it.
rl::CpuKernelCounters runOnHost(rl::CpuKernelEntry entry, const rl::SceneData& scene,
                                const rl::FrameData& frame, const void* buffers, const void* params,
                                void* embreeScene = nullptr);

// A frame for kernels that look at no camera.
rl::FrameData plainFrame(uint32_t width, uint32_t height, uint32_t seed);

}  // namespace restlab::parity
