#include "tests/parity/kernel_runner.h"

#include <stdlib.h>

#include <stdexcept>

#include "core/backend/glsl_compiler.h"
#include "core/dialect/features.h"

namespace restlab::parity {

namespace {

// Sessions of the tests neither read nor write the user's own cache.
const int kCacheIsSet = setenv("XDG_CACHE_HOME", RESTLAB_PARITY_CACHE, 1);

GlslKernel bruteForceKernel(const std::string& header, const std::string& file) {
  return {header, file, "tests/parity/brute_force.glsl", "", false};
}

void dispatch(TestDevice& device, VkPipeline pipeline, const GlslPushConstants& push,
              const rl::FrameData& frame) {
  device.device->runNow(
      [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdPushConstants(commands, device.kernels->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           sizeof push, &push);
        vkCmdDispatch(commands, (frame.width + kGlslTile - 1) / kGlslTile,
                      (frame.height + kGlslTile - 1) / kGlslTile, 1);
      },
      "a kernel under test");
}

}  // namespace

TestDevice openDevice(const std::string& name, const std::filesystem::path& cacheFolder) {
  TestDevice result;
  VulkanOptions options;
  options.device = name;
  result.device = VulkanDevice::open(options);
  result.memory = std::make_shared<VulkanMemory>(result.device);
  result.kernels = std::make_shared<VulkanKernels>(result.memory, result.device, cacheFolder);
  return result;
}

std::vector<TestDevice> testDevices() {
  std::vector<TestDevice> devices;
  for (const VulkanDeviceInfo& info : vulkanDeviceInfos()) {
    if (info.whyNot.empty()) devices.push_back(openDevice(info.name));
  }
  return devices;
}

std::vector<uint32_t> compileKernel(const std::string& header, const std::string& file) {
  const std::string text = glslKernelSource(bruteForceKernel(header, file));
  GlslResult result =
      compileGlsl(text, file, readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR}));
  if (result.spirv.empty()) throw std::runtime_error(result.log);
  return result.spirv;
}

GlslCounters runOnDevice(TestDevice& device, const std::string& header, const std::string& file,
                         uint64_t scene, const rl::FrameData& frame,
                         const std::vector<uint64_t>& buffers, const void* params,
                         size_t paramBytes) {
  VulkanMemory& memory = *device.memory;
  VkPipeline pipeline = device.kernels->pipeline(
      bruteForceKernel(header, file), file,
      rl::RL_FEATURE_ALL & ~(rl::RL_FEATURE_CLOSURES | rl::RL_FEATURE_SHAPES),
      readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR}), device.report);
  std::vector<GpuBuffer> inputs;
  const auto upload = [&](const void* data, size_t bytes) {
    inputs.push_back(memory.allocate(bytes, MemoryKind::device));
    memory.write(inputs.back(), data, bytes);
    return inputs.back().address;
  };
  GlslCounters counters;
  GlslPushConstants push;
  push.scene = scene;
  push.frame = upload(&frame, sizeof frame);
  push.buffers = upload(buffers.data(), buffers.size() * sizeof(uint64_t));
  push.params = upload(params, paramBytes);
  push.counters = upload(&counters, sizeof counters);
  push.width = frame.width;
  push.height = frame.height;
  dispatch(device, pipeline, push, frame);
  memory.read(inputs.back(), &counters, sizeof counters);
  for (const GpuBuffer& buffer : inputs) memory.free(buffer);
  return counters;
}

rl::CpuKernelCounters runOnHost(rl::CpuKernelEntry entry, const rl::SceneData& scene,
                                const rl::FrameData& frame, const void* buffers, const void* params,
                                void* embreeScene) {
  rl::CpuKernelArgs args;
  args.embreeScene = embreeScene;
  args.scene = &scene;
  args.frame = &frame;
  args.buffers = buffers;
  args.params = params;
  rl::CpuKernelCounters counters;
  entry(args, {0, 0, frame.width, frame.height}, counters);
  return counters;
}

rl::FrameData plainFrame(uint32_t width, uint32_t height, uint32_t seed) {
  rl::FrameData frame{};
  frame.width = width;
  frame.height = height;
  frame.seed = seed;
  frame.maxBounces = 8;
  frame.components = rl::RL_COMPONENT_ALL;
  frame.rouletteStart = rl::RL_INVALID;
  return frame;
}

}  // namespace restlab::parity

#if defined(__SANITIZE_ADDRESS__)
// The software driver (Mesa 22.3) leaks 128 bytes when unloaded, without a stack frame that names
// it; every other test program checks for own leaks.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
#endif
