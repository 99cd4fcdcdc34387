// Raster passes on Vulkan: graphics pipelines, the images that they draw into, and their commands.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/backend/backend.h"
#include "core/backend/glsl_preamble.h"
#include "core/backend/vulkan_kernels.h"
#include "core/backend/vulkan_memory.h"

namespace restlab {

class VulkanRaster {
 public:
  VulkanRaster(std::shared_ptr<VulkanDevice> device, std::shared_ptr<VulkanKernels> kernels)
      : device_(std::move(device)), kernels_(std::move(kernels)) {}
  ~VulkanRaster();
  VulkanRaster(const VulkanRaster&) = delete;
  VulkanRaster& operator=(const VulkanRaster&) = delete;

  // Stages that write what the host or later passes read.
  static constexpr VkPipelineStageFlags kWritingStages = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                                         VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                                         VK_PIPELINE_STAGE_TRANSFER_BIT;

  // Buffers that a pass draws into: its first slots (core/raster/raster.h). None: it is no raster
  // pass.
  static std::vector<BufferId> targetsOf(const PassRun& pass);
  static uint32_t divisionsOf(const PassRun& pass);  // RasterParams::divisions; else 0
  // Returns the pipeline of a raster pass; compiles it if it is not known yet. Both stages read by
  // address: texels are bound to compute pipelines alone. Throws Error (deviceUnavailable) if the
  // device draws no triangles, or a stage does not compile.
  VkPipeline pipeline(const PassRun& pass, const GlslTrace& trace, StartupReport& report);
  // Records the pass, after all commands before it. push: its size is that of the film.
  void record(VkCommandBuffer commands, VkPipeline pipeline, const std::vector<GpuBuffer>& targets,
              const CompiledScene& scene, uint32_t divisions, const GlslPushConstants& push);

 private:
  // Images that pipelines of one number of targets draw into.
  struct Film {
    VkRenderPass pass = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    std::vector<VkImage> images;  // targets, then depth
    std::vector<VkDeviceMemory> memory;
    std::vector<VkImageView> views;
  };
  void open();
  VkRenderPass passOf(size_t targets);
  const Film& filmOf(const glm::uvec2& size, size_t targets);
  void addImage(Film& film, const glm::uvec2& size, VkFormat format, VkImageUsageFlags usage,
                VkImageAspectFlags aspect);
  VkShaderModule moduleOf(const KernelUse& use, const GlslTrace& trace, GlslStage stage,
                          bool hasLight, KernelReport& report);
  VkPipeline make(VkShaderModule vertices, VkShaderModule fragments, size_t targets);

  std::shared_ptr<VulkanDevice> device_;
  std::shared_ptr<VulkanKernels> kernels_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::map<size_t, VkRenderPass> passes_;                         // by targets
  std::map<std::tuple<uint32_t, uint32_t, size_t>, Film> films_;  // by size and targets
  // By stages, masks of both, file of the rays, and number of targets.
  std::map<std::tuple<std::string, rl::FeatureMask, rl::FeatureMask, std::string, size_t>,
           VkPipeline>
      pipelines_;
};

}  // namespace restlab
