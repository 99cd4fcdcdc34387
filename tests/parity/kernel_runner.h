// Runs one dialect kernel on both machines.
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

// A device with its memory and kernels, without files on disk by default.
struct TestDevice {
  std::shared_ptr<VulkanDevice> device;
  std::shared_ptr<VulkanMemory> memory;
  std::shared_ptr<VulkanKernels> kernels;
  StartupReport report;  // about the kernels that ran

  const std::string& name() const { return device->name(); }
};

TestDevice openDevice(const std::string& name = {}, const std::filesystem::path& cacheFolder = {});
// Opens every device that the program can use; empty if there is none.
std::vector<TestDevice> testDevices();
// Reason to skip a test without a device.
constexpr const char* kNoDevice =
    "no Vulkan device with buffer addresses and scalar layout: kernels ran as C++ only";

// Compiles a kernel with the brute-force traversal to SPIR-V. Throws std::runtime_error with the
// compiler's message.
std::vector<uint32_t> compileKernel(const std::string& header, const std::string& file);

// Runs a kernel, with the general mask, over frame.width x frame.height threads. `scene` is a
// device address (0: none), `buffers` the bytes of the kernel's Buffers struct with device
// addresses.
GlslCounters runOnDevice(TestDevice& device, const std::string& header, const std::string& file,
                         uint64_t scene, const rl::FrameData& frame,
                         const std::vector<uint64_t>& buffers, const void* params,
                         size_t paramBytes);

// Runs the C++ build of a kernel on the calling thread; `embreeScene` is for kernels that trace
// with Embree.
rl::CpuKernelCounters runOnHost(rl::CpuKernelEntry entry, const rl::SceneData& scene,
                                const rl::FrameData& frame, const void* buffers, const void* params,
                                void* embreeScene = nullptr);

// A frame for kernels that use no camera.
rl::FrameData plainFrame(uint32_t width, uint32_t height, uint32_t seed);

}  // namespace restlab::parity
