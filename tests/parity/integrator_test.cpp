// Every registered integrator, every mode, over several frames of one history: the session on the
// CPU backend against the same passes as compute shaders.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/integrator.h"
#include "core/scene/compiled_scene.h"
#include "core/session.h"
#include "tests/parity/everything_scene.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/scene_upload.h"
#include "tests_kernel_list.h"

namespace restlab::parity {
namespace {

constexpr uint32_t kFrames = 4;

struct KernelFiles {
  std::string name, file, header;
};

std::vector<uint32_t> compileByName(const std::string& kernel) {
  static const std::vector<KernelFiles> list = {RESTLAB_KERNEL_LIST};
  for (const KernelFiles& k : list) {
    if (k.name == kernel) return compileKernel(k.header, k.file);
  }
  throw std::runtime_error("no kernel '" + kernel + "'");
}

// What Session does on the CPU, on a device.
class DeviceSession {
 public:
  DeviceSession(VulkanDevice& device, const CompiledScene& scene, const SessionConfig& config)
      : device_(device), info_(findIntegrator(config.integrator)) {
    const ParameterMap parameters = resolveParameters(info_, config.parameters);
    params_ = info_.packParameters(config.mode, parameters);
    for (const PassInfo& pass : info_.passes) shaders_.push_back(compileByName(pass.kernel));
    pixels_ = size_t{config.width} * config.height;
    for (const BufferInfo& b : info_.buffers) {
      buffers_.push_back(&device.allocate(pixels_ * bytesPerPixelOf(b, parameters)));
    }
    scene_ = uploadScene(device, scene.data());
    frame_ = plainFrame(config.width, config.height, config.seed);
    frame_.camera = scene.camera(scene.source().cameras.front(), config.width, config.height);
    frame_.previousCamera = frame_.camera;
    frame_.maxBounces = config.maxBounces;
    const auto hold = parameters.find("film_hold");
    if (hold != parameters.end())
      frame_.filmHold = static_cast<uint32_t>(std::get<int64_t>(hold->second));
  }

  // Valid until the next frame.
  const rl::vec3* frame() {
    std::vector<uint64_t> addresses;
    addresses.reserve(buffers_.size());
    for (const GpuBuffer* b : buffers_) addresses.push_back(b->address);
    for (const std::vector<uint32_t>& shader : shaders_) {
      runOnDevice(device_, shader, scene_, frame_, addresses, params_.data(), params_.size());
    }
    const auto* radiance = static_cast<const rl::vec3*>(buffers_[0]->mapped);
    for (size_t i = 0; i < buffers_.size(); ++i) {
      const int other = info_.buffers[i].swapWith;
      if (other > static_cast<int>(i)) std::swap(buffers_[i], buffers_[static_cast<size_t>(other)]);
    }
    ++frame_.frame;
    return radiance;
  }

 private:
  VulkanDevice& device_;
  const IntegratorInfo& info_;
  std::vector<std::byte> params_;
  std::vector<std::vector<uint32_t>> shaders_;
  std::vector<GpuBuffer*> buffers_;
  rl::FrameData frame_{};
  uint64_t scene_ = 0;
  size_t pixels_ = 0;
};

// Share of the pixels that differ by more than 1e-3 of their own size.
double differentShare(const std::vector<glm::vec3>& a, const rl::vec3* b) {
  size_t different = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double scale = std::max(length(a[i]), length(b[i]));
    if (!(length(a[i] - b[i]) <= 1e-3 * scale)) ++different;
  }
  return double(different) / double(a.size());
}

TEST(Integrators, SameHistoryOnBothMachines) {
  const auto devices = VulkanDevice::all();
  if (devices.empty()) {
    GTEST_SKIP()
        << "no Vulkan device with buffer addresses and scalar layout: kernels ran as C++ only";
  }
  const auto scene = CompiledScene::build(makeEverythingScene());
  for (const auto& device : devices) {
    for (const IntegratorInfo* info : integratorRegistry()) {
      for (const ModeInfo& mode : info->modes) {
        SCOPED_TRACE(device->name() + ", " + info->name + " " + mode.name);
        SessionConfig config;
        config.integrator = info->name;
        config.mode = mode.name;
        config.width = 64;
        config.height = 48;
        config.specialise = false;
        Session host(scene, config);
        DeviceSession gpu(*device, *scene, config);
        for (uint32_t f = 0; f < kFrames; ++f) {
          host.frame();
          size_t lit = 0;
          for (const glm::vec3& p : host.radiance().pixels) lit += p.x > 0.0f;
          EXPECT_GT(lit, host.radiance().pixels.size() / 2);
          const double share = differentShare(host.radiance().pixels, gpu.frame());
          std::printf("  %s %s frame %u: %.2f %% of the pixels differ\n", info->name.c_str(),
                      mode.name.c_str(), f, 100.0 * share);
          // Reuse spreads a path that took another turn to its neighbours and to the next frames.
          EXPECT_LT(share, 0.01 * (f + 1)) << "frame " << f;
        }
      }
    }
  }
}

}  // namespace
}  // namespace restlab::parity
