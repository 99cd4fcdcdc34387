// Kernels as pipelines of a device: compiled once per feature mask, kept in memory and on disk.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/backend/backend.h"
#include "core/backend/glsl_compiler.h"
#include "core/backend/glsl_preamble.h"
#include "core/backend/kernel_cache.h"
#include "core/backend/vulkan_memory.h"

namespace restlab {

class VulkanKernels {
 public:
  // `cacheFolder`: where compiled kernels are kept on disk; empty: nowhere.
  VulkanKernels(std::shared_ptr<VulkanMemory> memory, std::shared_ptr<VulkanDevice> device,
                std::filesystem::path cacheFolder);
  ~VulkanKernels();
  VulkanKernels(const VulkanKernels&) = delete;
  VulkanKernels& operator=(const VulkanKernels&) = delete;

  // Returns the pipeline of a kernel; compiles it if it is not known yet, and records that in
  // `report`. `read` gives the dialect's files. Throws Error (deviceUnavailable) with file and line
  // if the kernel does not compile.
  VkPipeline pipeline(const GlslKernel& kernel, const std::string& name, rl::FeatureMask mask,
                      const SourceReader& read, StartupReport& report);
  VkPipelineLayout layout() const { return layout_; }
  // The shader of a kernel, with the features it names; the caller destroys it. Throws as
  // pipeline() does. Records how long it took.
  VkShaderModule module(const GlslKernel& kernel, const std::string& name, const SourceReader& read,
                        KernelReport& report);

  // Bindings of kernels that read by texels (GlslBinding). Buffers and parameters are bound for the
  // first pass; those of other passes lie at dynamic offsets. Freed by release().
  struct Bound {
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::array<VkBufferView, 3> views{};
  };
  struct BoundRanges {
    GpuBuffer scene, frame, buffers, params;  // structs; the last two of one pass
    GpuBuffer sceneTexels, stateTexels;
  };
  Bound bind(const BoundRanges& ranges);
  void release(Bound& bound);

 private:
  std::vector<uint32_t> spirvOf(const GlslKernel& kernel, const std::string& name,
                                const SourceReader& read, bool& fromDisk);
  void fill(Bound& bound, const BoundRanges& ranges);
  void prime(VkPipeline pipeline);
  void saveDriverCache();

  std::shared_ptr<VulkanDevice> device_;
  std::shared_ptr<VulkanMemory> memory_;
  std::vector<std::string> notices_;
  KernelCache cache_;
  std::string driverCacheName_;
  VkPipelineCache driverCache_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  Bound primerBound_;
  GpuBuffer primer_;  // zeros: a frame without pixels, and counters
  std::map<std::pair<std::string, rl::FeatureMask>, VkPipeline> pipelines_;  // by files and mask
};

}  // namespace restlab
