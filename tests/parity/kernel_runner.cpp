#include "tests/parity/kernel_runner.h"

#include <cstring>
#include <stdexcept>

#include "core/backend/glsl_compiler.h"
#include "core/dialect/features.h"

namespace restlab::parity {

std::vector<uint32_t> compileKernel(const std::string& header, const std::string& file) {
  const std::string text = glslKernelSource({header, file, "tests/parity/brute_force.glsl"});
  GlslResult result = compileGlsl(text, file, readBelow(RESTLAB_SOURCE_DIR));
  if (result.spirv.empty()) throw std::runtime_error(result.log);
  return result.spirv;
}

GlslCounters runOnDevice(VulkanDevice& device, const std::vector<uint32_t>& spirv, uint64_t scene,
                         const rl::FrameData& frame, const std::vector<uint64_t>& buffers,
                         const void* params, size_t paramBytes) {
  GpuBuffer& counters = device.allocate(sizeof(GlslCounters));
  GlslPushConstants push;
  push.scene = scene;
  push.frame = device.upload(&frame, sizeof frame).address;
  push.buffers = device.upload(buffers.data(), buffers.size() * sizeof(uint64_t)).address;
  push.params = device.upload(params, paramBytes).address;
  push.counters = counters.address;
  device.run(spirv, rl::RL_FEATURE_ALL, &push, sizeof push,
             (frame.width + kGlslTile - 1) / kGlslTile, (frame.height + kGlslTile - 1) / kGlslTile);
  GlslCounters result;
  std::memcpy(&result, counters.mapped, sizeof result);
  return result;
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
  frame.filmHold = 1;
  frame.rouletteStart = rl::RL_INVALID;
  return frame;
}

}  // namespace restlab::parity
