#include "core/backend/vulkan_kernels.h"

#include <fmt/format.h>
#include <glslang/build_info.h>

#include <chrono>
#include <cstring>

#include "core/backend/vulkan_error.h"
#include "core/error.h"

namespace restlab {

namespace {

// The first error of glslang's words, without its prefix.
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

// Everything that the shader is made of: its own text and that of all it may include.
std::string expandedKey(const std::string& text, const SourceReader& read) {
  std::string all = fmt::format("glslang {}.{}.{} ", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR,
                                GLSLANG_VERSION_PATCH);
  std::vector<std::string> open = {text};
  std::map<std::string, bool> seen;
  while (!open.empty()) {
    const std::string part = std::move(open.back());
    open.pop_back();
    all += part;
    for (size_t at = part.find("#include \""); at != std::string::npos;
         at = part.find("#include \"", at + 1)) {
      const size_t begin = at + 10, end = part.find('"', begin);
      if (end == std::string::npos) break;
      const std::string path = part.substr(begin, end - begin);
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
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(GlslPushConstants)};
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
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
  primer_ = memory_->allocate(sizeof(rl::FrameData) + sizeof(GlslCounters), MemoryKind::device);
  memory_->clear(primer_);
}

VulkanKernels::~VulkanKernels() {
  for (const auto& entry : pipelines_) vkDestroyPipeline(device_->handle(), entry.second, nullptr);
  if (driverCache_ != VK_NULL_HANDLE)
    vkDestroyPipelineCache(device_->handle(), driverCache_, nullptr);
  if (layout_ != VK_NULL_HANDLE) vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
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
  GlslResult result = compileGlsl(text, kernel.file, read);
  if (result.spirv.empty()) {
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("kernel {} does not compile: {}", name, firstError(result.log)));
  }
  cache_.write(file, result.spirv.data(), result.spirv.size() * 4);
  return result.spirv;
}

VkPipeline VulkanKernels::pipeline(const GlslKernel& kernel, const std::string& name, uint32_t mask,
                                   const SourceReader& read, StartupReport& report) {
  VkPipeline& known = pipelines_[{kernel.file + " " + kernel.traceFile, mask}];
  if (known != VK_NULL_HANDLE) return known;
  const auto start = std::chrono::steady_clock::now();
  KernelReport done;
  done.kernel = name;
  done.mask = mask;
  const std::vector<uint32_t> spirv = spirvOf(kernel, name, read, done.fromDisk);
  done.glslMs = msSince(start);
  const auto driverStart = std::chrono::steady_clock::now();
  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = spirv.size() * sizeof(uint32_t);
  moduleInfo.pCode = spirv.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  device_->check(vkCreateShaderModule(device_->handle(), &moduleInfo, nullptr, &shader),
                 "vkCreateShaderModule");
  const VkSpecializationMapEntry entry{0, 0, sizeof mask};
  const VkSpecializationInfo specialization{1, &entry, sizeof mask, &mask};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags = VK_PIPELINE_CREATE_DISPATCH_BASE_BIT;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
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
  report.timeMs += done.glslMs + done.driverMs;
  report.kernels.push_back(done);
  report.notices.insert(report.notices.end(), notices_.begin(), notices_.end());
  notices_.clear();
  return known;
}

// A first dispatch over no pixels: some drivers generate code only then, and that belongs to
// start-up, not into a frame.
void VulkanKernels::prime(VkPipeline pipeline) {
  GlslPushConstants push;
  push.frame = primer_.address;
  push.counters = primer_.address + sizeof(rl::FrameData);
  device_->runNow(
      [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
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
