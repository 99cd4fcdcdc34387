#include "core/backend/vulkan_kernels.h"

#include <fmt/format.h>
#include <glslang/build_info.h>
#include <spirv-tools/libspirv.h>

#include <chrono>
#include <cstring>

#include "core/backend/dialect_sources.h"
#include "core/backend/spirv_fold.h"
#include "core/backend/vulkan_error.h"
#include "core/base/error.h"

namespace restlab {

namespace {

// First error in glslang's log, without its prefix.
std::string firstError(const std::string& log) {
  const std::string mark = "ERROR: ";
  const size_t begin = log.find(mark);
  if (begin == std::string::npos) return log.substr(0, log.find('\n'));
  const size_t end = log.find('\n', begin);
  return log.substr(begin + mark.size(), end - begin - mark.size());
}

double msSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

std::string driverCacheNameOf(const VkPhysicalDeviceProperties& properties) {
  std::string name = "pipelines-";
  for (const uint8_t byte : properties.pipelineCacheUUID) name += fmt::format("{:02x}", byte);
  return fmt::format("{}-{:x}-{:x}-{:x}.bin", name, properties.vendorID, properties.deviceID,
                     properties.driverVersion);
}

constexpr size_t kPrimerBytes = 1024;

VkDescriptorType typeOf(uint32_t binding) {
  if (binding == kGlslScene || binding == kGlslFrame) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  if (binding == kGlslBuffers || binding == kGlslParams)
    return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
  return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

uint32_t copiesOf(uint32_t binding) { return binding < kGlslSceneUvec4s ? kGlslCopies : 1; }

// Cache key of a shader: hash of the versions of glslang and SPIRV-Tools, of the shader's text and
// of all files it may include.
std::string expandedKey(const std::string& text, const SourceReader& read) {
  std::string all =
      fmt::format("glslang {}.{}.{} {} ", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR,
                  GLSLANG_VERSION_PATCH, spvSoftwareVersionDetailsString());
  std::vector<std::string> open = {text};
  std::map<std::string, bool> seen;
  while (!open.empty()) {
    const std::string part = std::move(open.back());
    open.pop_back();
    all += part;
    for (const std::string& path : includedPaths(part)) {
      if (seen[path]) continue;
      seen[path] = true;
      if (std::optional<std::string> source = read(path)) open.push_back(path + "\n" + *source);
    }
  }
  return contentKey(all);
}

}  // namespace

VulkanKernels::VulkanKernels(std::shared_ptr<VulkanMemory> memory,
                             std::shared_ptr<VulkanDevice> device,
                             std::filesystem::path cacheFolder)
    : device_(std::move(device)),
      memory_(std::move(memory)),
      cache_(std::move(cacheFolder), [this](const std::string& line) { notices_.push_back(line); }),
      driverCacheName_(driverCacheNameOf(device_->properties())) {
  std::array<VkDescriptorSetLayoutBinding, kGlslBindingCount> bindings{};
  for (uint32_t i = 0; i < kGlslBindingCount; ++i)
    bindings[i] = {i, typeOf(i), copiesOf(i), VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo setLayout{};
  setLayout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  setLayout.bindingCount = kGlslBindingCount;
  setLayout.pBindings = bindings.data();
  device_->check(vkCreateDescriptorSetLayout(device_->handle(), &setLayout, nullptr, &setLayout_),
                 "vkCreateDescriptorSetLayout");
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(GlslPushConstants)};
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &setLayout_;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  device_->check(vkCreatePipelineLayout(device_->handle(), &layout, nullptr, &layout_),
                 "vkCreatePipelineLayout");
  const std::optional<std::vector<uint8_t>> stored = cache_.read(driverCacheName_);
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  if (stored) {
    info.initialDataSize = stored->size();
    info.pInitialData = stored->data();
  }
  device_->check(vkCreatePipelineCache(device_->handle(), &info, nullptr, &driverCache_),
                 "vkCreatePipelineCache");
  primer_ = memory_->allocate(kPrimerBytes, MemoryKind::device);
  memory_->clear(primer_);
  primerBound_ = bind({primer_, primer_, primer_, primer_, primer_, primer_});
}

VulkanKernels::~VulkanKernels() {
  for (const auto& entry : pipelines_) vkDestroyPipeline(device_->handle(), entry.second, nullptr);
  if (driverCache_ != VK_NULL_HANDLE)
    vkDestroyPipelineCache(device_->handle(), driverCache_, nullptr);
  release(primerBound_);
  if (layout_ != VK_NULL_HANDLE) vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
  if (setLayout_ != VK_NULL_HANDLE)
    vkDestroyDescriptorSetLayout(device_->handle(), setLayout_, nullptr);
  memory_->free(primer_);
}

std::vector<uint32_t> VulkanKernels::spirvOf(const GlslKernel& kernel, const std::string& name,
                                             const SourceReader& read, bool& fromDisk) {
  const std::string text = glslKernelSource(kernel);
  const std::string file = expandedKey(text, read) + ".spv";
  if (const auto stored = cache_.read(file); stored && stored->size() % 4 == 0) {
    std::vector<uint32_t> spirv(stored->size() / 4);
    std::memcpy(spirv.data(), stored->data(), stored->size());
    fromDisk = true;
    return spirv;
  }
  fromDisk = false;
  GlslResult result = compileGlsl(text, kernel.file, read, kernel.stage);
  if (result.spirv.empty()) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("kernel {} does not compile: {}", name, firstError(result.log)));
  }
  std::string reason;
  if (!foldSpirv(result.spirv, reason))
    notices_.push_back(fmt::format("kernel {} takes longer to compile: {}", name, reason));
  cache_.write(file, result.spirv.data(), result.spirv.size() * 4);
  return result.spirv;
}

VkShaderModule VulkanKernels::module(const GlslKernel& kernel, const std::string& name,
                                     const SourceReader& read, KernelReport& report) {
  const auto start = std::chrono::steady_clock::now();
  report.kernel = name;
  report.mask = kernel.features;
  const std::vector<uint32_t> spirv = spirvOf(kernel, name, read, report.fromDisk);
  report.compileMs = msSince(start);
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = spirv.size() * sizeof(uint32_t);
  info.pCode = spirv.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  device_->check(vkCreateShaderModule(device_->handle(), &info, nullptr, &shader),
                 "vkCreateShaderModule");
  return shader;
}

VkPipeline VulkanKernels::pipeline(const GlslKernel& kernel, const std::string& name,
                                   rl::FeatureMask mask, const SourceReader& read,
                                   StartupReport& report) {
  const char* reads = kernel.readsTexels ? " texels" : "";
  VkPipeline& known =
      pipelines_[{kernel.header + " " + kernel.file + " " + kernel.traceFile + reads, mask}];
  if (known != VK_NULL_HANDLE) return known;
  KernelReport done;
  GlslKernel ofMask = kernel;
  ofMask.features = mask;
  VkShaderModule shader = module(ofMask, name, read, done);
  const auto driverStart = std::chrono::steady_clock::now();
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags = VK_PIPELINE_CREATE_DISPATCH_BASE_BIT;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader;
  info.stage.pName = "main";
  info.layout = layout_;
  const VkResult result =
      vkCreateComputePipelines(device_->handle(), driverCache_, 1, &info, nullptr, &known);
  vkDestroyShaderModule(device_->handle(), shader, nullptr);
  if (result != VK_SUCCESS) {
    known = VK_NULL_HANDLE;
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("{}: its driver does not compile kernel {} ({}) ({})", device_->name(),
                            name, kernel.file, vulkanResultName(result)));
  }
  prime(known);
  done.driverMs = msSince(driverStart);
  saveDriverCache();
  report.timeMs += done.compileMs + done.driverMs;
  report.kernels.push_back(done);
  report.notices.insert(report.notices.end(), notices_.begin(), notices_.end());
  notices_.clear();
  return known;
}

VulkanKernels::Bound VulkanKernels::bind(const BoundRanges& ranges) {
  Bound bound;
  try {
    fill(bound, ranges);
  } catch (...) {
    release(bound);
    throw;
  }
  return bound;
}

void VulkanKernels::fill(Bound& bound, const BoundRanges& ranges) {
  const VkDevice device = device_->handle();
  const std::array<VkDescriptorPoolSize, 3> sizes = {
      {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2 * kGlslCopies},
       {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 2 * kGlslCopies},
       {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 3}}};
  VkDescriptorPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 1;
  pool.poolSizeCount = sizes.size();
  pool.pPoolSizes = sizes.data();
  device_->check(vkCreateDescriptorPool(device, &pool, nullptr, &bound.pool),
                 "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocation.descriptorPool = bound.pool;
  allocation.descriptorSetCount = 1;
  allocation.pSetLayouts = &setLayout_;
  device_->check(vkAllocateDescriptorSets(device, &allocation, &bound.set),
                 "vkAllocateDescriptorSets");
  const auto addView = [&](size_t i, const GpuBuffer& texels, VkFormat format) {
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = texels.buffer;
    info.format = format;
    info.offset = texels.offset;
    info.range = texels.bytes;
    device_->check(vkCreateBufferView(device, &info, nullptr, &bound.views[i]),
                   "vkCreateBufferView");
  };
  addView(0, ranges.sceneTexels, VK_FORMAT_R32G32B32A32_UINT);
  addView(1, ranges.sceneTexels, VK_FORMAT_R32_UINT);
  addView(2, ranges.stateTexels, VK_FORMAT_R32G32B32A32_UINT);
  const std::array<const GpuBuffer*, 4> structs = {&ranges.scene, &ranges.frame, &ranges.buffers,
                                                   &ranges.params};
  std::array<std::array<VkDescriptorBufferInfo, kGlslCopies>, 4> infos{};
  std::array<VkWriteDescriptorSet, kGlslBindingCount> writes{};
  for (uint32_t i = 0; i < kGlslBindingCount; ++i) {
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = bound.set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = copiesOf(i);
    writes[i].descriptorType = typeOf(i);
    if (i < kGlslSceneUvec4s) {
      infos[i].fill({structs[i]->buffer, structs[i]->offset, structs[i]->bytes});
      writes[i].pBufferInfo = infos[i].data();
    } else {
      writes[i].pTexelBufferView = &bound.views[i - kGlslSceneUvec4s];
    }
  }
  vkUpdateDescriptorSets(device, writes.size(), writes.data(), 0, nullptr);
}

void VulkanKernels::release(Bound& bound) {
  for (VkBufferView view : bound.views) vkDestroyBufferView(device_->handle(), view, nullptr);
  if (bound.pool != VK_NULL_HANDLE) vkDestroyDescriptorPool(device_->handle(), bound.pool, nullptr);
  bound = Bound();
}

// Dispatches a kernel over no pixels: some drivers generate code only at the first dispatch, which
// belongs to start-up, not into a frame.
void VulkanKernels::prime(VkPipeline pipeline) {
  GlslPushConstants push;
  push.frame = primer_.address;
  push.counters = primer_.address + sizeof(rl::FrameData);
  const std::array<uint32_t, kGlslDynamicOffsets> offsets{};
  device_->runNow(
      [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                &primerBound_.set, offsets.size(), offsets.data());
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
        vkCmdDispatch(commands, 1, 1, 1);
      },
      "the first run of a kernel");
}

void VulkanKernels::saveDriverCache() {
  size_t bytes = 0;
  if (vkGetPipelineCacheData(device_->handle(), driverCache_, &bytes, nullptr) != VK_SUCCESS)
    return;
  std::vector<uint8_t> data(bytes);
  if (vkGetPipelineCacheData(device_->handle(), driverCache_, &bytes, data.data()) != VK_SUCCESS)
    return;
  cache_.write(driverCacheName_, data.data(), bytes);
}

}  // namespace restlab
