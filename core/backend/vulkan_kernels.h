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
  // `read` gives the dialect's files, `kernels` what there is.
  VulkanKernels(std::shared_ptr<VulkanMemory> memory, std::shared_ptr<VulkanDevice> device,
                std::filesystem::path cacheFolder);
  ~VulkanKernels();
  VulkanKernels(const VulkanKernels&) = delete;
  VulkanKernels& operator=(const VulkanKernels&) = delete;

  // The pipeline of a kernel, compiled where it is not known yet, which `report` then says. Throws
  // Error (badUsage) for an unknown kernel, (deviceUnavailable) with file and line where it does
  // not compile.
  VkPipeline pipeline(const GlslKernel& kernel, const std::string& name, uint32_t mask,
                      const SourceReader& read, StartupReport& report);
  VkPipelineLayout layout() const { return layout_; }

  // The bindings of kernels that read by texels (GlslBinding), whose buffers and parameters are
  // given for the first pass: those of others lie at dynamic offsets from them. Ends by release().
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
  GpuBuffer primer_;  // zeros: a frame of no pixels, counters
  std::map<std::pair<std::string, uint32_t>, VkPipeline> pipelines_;  // by what it is and its mask
};

}  // namespace restlab
