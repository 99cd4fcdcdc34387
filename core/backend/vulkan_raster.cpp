#include "core/backend/vulkan_raster.h"

#include <fmt/format.h>

#include <chrono>
#include <cstring>

#include "core/backend/dialect_sources.h"
#include "core/base/error.h"
#include "core/raster/raster_triangles.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

namespace {

constexpr VkFormat kHitFormat = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kLightFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkFormat formatOf(size_t target) { return target == 0 ? kHitFormat : kLightFormat; }

double msSinceStart(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

VulkanRaster::~VulkanRaster() {
  const VkDevice device = device_->handle();
  for (const auto& entry : pipelines_) vkDestroyPipeline(device, entry.second, nullptr);
  for (const auto& entry : films_) {
    const Film& film = entry.second;
    vkDestroyFramebuffer(device, film.framebuffer, nullptr);
    for (VkImageView view : film.views) vkDestroyImageView(device, view, nullptr);
    for (VkImage image : film.images) vkDestroyImage(device, image, nullptr);
    for (VkDeviceMemory memory : film.memory) vkFreeMemory(device, memory, nullptr);
  }
  for (const auto& entry : passes_) vkDestroyRenderPass(device, entry.second, nullptr);
  if (layout_ != VK_NULL_HANDLE) vkDestroyPipelineLayout(device, layout_, nullptr);
}

void VulkanRaster::open() {
  if (layout_ != VK_NULL_HANDLE) return;
  const std::string& why = device_->info().whyNoRaster;
  if (!why.empty()) {
    throw Error(
        ExitCode::deviceUnavailable,
        fmt::format("first_hit = raster: {}: {}; rays would be right", device_->name(), why));
  }
  const VkPushConstantRange range{kStages, 0, sizeof(GlslPushConstants)};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  device_->check(vkCreatePipelineLayout(device_->handle(), &info, nullptr, &layout_),
                 "vkCreatePipelineLayout");
}

VkRenderPass VulkanRaster::passOf(size_t targets) {
  VkRenderPass& known = passes_[targets];
  if (known != VK_NULL_HANDLE) return known;
  std::vector<VkAttachmentDescription> attachments(targets + 1);
  std::vector<VkAttachmentReference> colors;
  for (size_t i = 0; i <= targets; ++i) {
    const bool isDepth = i == targets;
    attachments[i].format = isDepth ? kDepthFormat : formatOf(i);
    attachments[i].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[i].storeOp =
        isDepth ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
    attachments[i].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[i].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[i].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachments[i].finalLayout = isDepth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                         : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    if (!isDepth)
      colors.push_back({static_cast<uint32_t>(i), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
  }
  const VkAttachmentReference depth{static_cast<uint32_t>(targets),
                                    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = static_cast<uint32_t>(colors.size());
  subpass.pColorAttachments = colors.data();
  subpass.pDepthStencilAttachment = &depth;
  // The images are those of the frame before; its copies come first.
  const VkPipelineStageFlags drawing = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                       VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                       VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  const VkAccessFlags written =
      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  std::array<VkSubpassDependency, 2> dependencies{};
  dependencies[0].srcSubpass = VK_SUBPASS_EXTERNAL;
  dependencies[0].srcStageMask = drawing | VK_PIPELINE_STAGE_TRANSFER_BIT;
  dependencies[0].srcAccessMask = written | VK_ACCESS_TRANSFER_READ_BIT;
  dependencies[0].dstStageMask = drawing;
  dependencies[0].dstAccessMask = written | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
  dependencies[1].dstSubpass = VK_SUBPASS_EXTERNAL;
  dependencies[1].srcStageMask = drawing;
  dependencies[1].srcAccessMask = written;
  dependencies[1].dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
  dependencies[1].dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = static_cast<uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = dependencies.size();
  info.pDependencies = dependencies.data();
  device_->check(vkCreateRenderPass(device_->handle(), &info, nullptr, &known),
                 "vkCreateRenderPass");
  return known;
}

void VulkanRaster::addImage(Film& film, const glm::uvec2& size, VkFormat format,
                            VkImageUsageFlags usage, VkImageAspectFlags aspect) {
  const VkDevice device = device_->handle();
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {size.x, size.y, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  device_->check(vkCreateImage(device, &info, nullptr, &film.images.emplace_back()),
                 "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, film.images.back(), &needs);
  VkMemoryAllocateInfo memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  memory.allocationSize = needs.size;
  memory.memoryTypeIndex =
      device_->memoryTypeOf(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, needs.memoryTypeBits);
  if (memory.memoryTypeIndex == rl::RL_INVALID)
    device_->check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "images of a raster pass");
  device_->check(vkAllocateMemory(device, &memory, nullptr, &film.memory.emplace_back()),
                 "images of a raster pass");
  device_->check(vkBindImageMemory(device, film.images.back(), film.memory.back(), 0),
                 "vkBindImageMemory");
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = film.images.back();
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  device_->check(vkCreateImageView(device, &view, nullptr, &film.views.emplace_back()),
                 "vkCreateImageView");
}

const VulkanRaster::Film& VulkanRaster::filmOf(const glm::uvec2& size, size_t targets) {
  const auto [at, isNew] = films_.try_emplace({size.x, size.y, targets});
  Film& film = at->second;
  if (!isNew) return film;
  for (size_t i = 0; i < targets; ++i)
    addImage(film, size, formatOf(i),
             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
             VK_IMAGE_ASPECT_COLOR_BIT);
  addImage(film, size, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
           VK_IMAGE_ASPECT_DEPTH_BIT);
  film.pass = passOf(targets);
  VkFramebufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = film.pass;
  info.attachmentCount = static_cast<uint32_t>(film.views.size());
  info.pAttachments = film.views.data();
  info.width = size.x;
  info.height = size.y;
  info.layers = 1;
  device_->check(vkCreateFramebuffer(device_->handle(), &info, nullptr, &film.framebuffer),
                 "vkCreateFramebuffer");
  return film;
}

VkShaderModule VulkanRaster::moduleOf(const KernelUse& use, const GlslTrace& trace, GlslStage stage,
                                      bool hasLight, KernelReport& report) {
  const DialectKernel& files = dialectKernel(use.kernel);
  const GlslKernel kernel = {files.header, files.file, trace.file, trace.extensions,
                             false,        use.mask,   stage,      hasLight};
  return kernels_->module(kernel, use.kernel, dialectSource, report);
}

std::vector<BufferId> VulkanRaster::targetsOf(const PassRun& pass) {
  if (!pass.isRaster()) return {};
  const bool hasLight = pass.buffers[1] != kNoBuffer;
  return {pass.buffers.begin(), pass.buffers.begin() + (hasLight ? 3 : 1)};
}

uint32_t VulkanRaster::divisionsOf(const PassRun& pass) {
  if (!pass.isRaster()) return 0;
  rl::RasterParams params;
  std::memcpy(&params, pass.params.data(), sizeof params);
  return params.divisions;
}

VkPipeline VulkanRaster::pipeline(const PassRun& pass, const GlslTrace& trace,
                                  StartupReport& report) {
  open();
  const size_t targets = targetsOf(pass).size();
  VkPipeline& known = pipelines_[{pass.vertices.kernel + " " + pass.kernel, pass.vertices.mask,
                                  pass.mask, trace.file, targets}];
  if (known != VK_NULL_HANDLE) return known;
  KernelReport ofVertices, ofFragments;
  const VkShaderModule vertices =
      moduleOf(pass.vertices, trace, GlslStage::vertex, targets > 1, ofVertices);
  const VkShaderModule fragments =
      moduleOf({pass.kernel, pass.mask}, trace, GlslStage::fragment, targets > 1, ofFragments);
  const auto start = std::chrono::steady_clock::now();
  const VkPipeline made = make(vertices, fragments, targets);
  ofFragments.driverMs = msSinceStart(start);
  vkDestroyShaderModule(device_->handle(), vertices, nullptr);
  vkDestroyShaderModule(device_->handle(), fragments, nullptr);
  if (made == VK_NULL_HANDLE) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("{}: its driver does not compile the raster pass of {} and {}",
                            device_->name(), pass.vertices.kernel, pass.kernel));
  }
  known = made;
  for (const KernelReport& one : {ofVertices, ofFragments}) {
    report.timeMs += one.compileMs + one.driverMs;
    report.kernels.push_back(one);
  }
  return known;
}

VkPipeline VulkanRaster::make(VkShaderModule vertices, VkShaderModule fragments, size_t targets) {
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (size_t i = 0; i < 2; ++i) {
    stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[i].module = i == 0 ? vertices : fragments;
    stages[i].pName = "main";
  }
  VkPipelineVertexInputStateCreateInfo input{};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{};
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = VK_CULL_MODE_NONE;  // rays meet both sides
  raster.lineWidth = 1.0f;
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{};
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER;
  std::vector<VkPipelineColorBlendAttachmentState> blends(targets);
  for (VkPipelineColorBlendAttachmentState& blend : blends)
    blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  VkPipelineColorBlendStateCreateInfo blending{};
  blending.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blending.attachmentCount = static_cast<uint32_t>(targets);
  blending.pAttachments = blends.data();
  const std::array<VkDynamicState, 2> dynamics = {VK_DYNAMIC_STATE_VIEWPORT,
                                                  VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = dynamics.size();
  dynamic.pDynamicStates = dynamics.data();
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.stageCount = stages.size();
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blending;
  info.pDynamicState = &dynamic;
  info.layout = layout_;
  info.renderPass = passOf(targets);
  VkPipeline made = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateGraphicsPipelines(device_->handle(), VK_NULL_HANDLE, 1, &info, nullptr, &made);
  return result == VK_SUCCESS ? made : VK_NULL_HANDLE;
}

void VulkanRaster::record(VkCommandBuffer commands, VkPipeline pipeline,
                          const std::vector<GpuBuffer>& targets, const CompiledScene& scene,
                          uint32_t divisions, const GlslPushConstants& push) {
  const VkRect2D area = {{0, 0}, {push.width, push.height}};
  const Film& film = filmOf({push.width, push.height}, targets.size());
  VkMemoryBarrier before{};
  before.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  before.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  before.dstAccessMask =
      VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  vkCmdPipelineBarrier(commands,
                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                           VK_PIPELINE_STAGE_TRANSFER_BIT,
                       0, 1, &before, 0, nullptr, 0, nullptr);
  std::vector<VkClearValue> clears(targets.size() + 1);
  clears[0].color.uint32[0] = clears[0].color.uint32[1] = rl::RL_INVALID;
  VkRenderPassBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  begin.renderPass = film.pass;
  begin.framebuffer = film.framebuffer;
  begin.renderArea = area;
  begin.clearValueCount = static_cast<uint32_t>(clears.size());
  begin.pClearValues = clears.data();
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  const VkViewport viewport{0.0f, 0.0f, float(push.width), float(push.height), 0.0f, 1.0f};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
  vkCmdPushConstants(commands, layout_, kStages, 0, sizeof push, &push);
  const BvhInput input = scene.bvhInput();
  for (uint32_t i = 0; i < input.instances.size(); ++i) {
    const uint32_t count =
        rasterTriangles(input.geometries[input.instances[i].geometry], divisions);
    if (count != 0) vkCmdDraw(commands, 3 * count, 1, 0, i);
  }
  vkCmdEndRenderPass(commands);
  for (size_t i = 0; i < targets.size(); ++i) {
    VkBufferImageCopy region{};
    region.bufferOffset = targets[i].offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {push.width, push.height, 1};
    vkCmdCopyImageToBuffer(commands, film.images[i], VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           targets[i].buffer, 1, &region);
  }
}

}  // namespace restlab
