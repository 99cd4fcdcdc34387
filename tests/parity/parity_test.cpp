// Kernel files, built by the C++ compiler and run by a Vulkan device (lavapipe without a GPU), must
// decide alike and compute alike. Every suitable device of the machine is tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/backend/cpu_kernel.h"
#include "core/backend/vulkan_scene.h"
#include "core/dialect/features.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/scene.h"
#include "integrators/path/path.h"
#include "tests/parity/everything_scene.h"
#include "tests/parity/kernel_runner.h"
#undef RL_KERNEL_BUFFERS
#undef RL_KERNEL_PARAMS
#include "tests/parity/ris_kernel.h"

namespace rl {
extern const CpuKernelEntry kernel_parity_ris_general;
extern const CpuKernelEntry kernel_parity_path_general;
}  // namespace rl

namespace restlab::parity {
namespace {

constexpr double kMaxDifferentDecisions = 1e-5;  // fraction of threads
constexpr double kMaxRelativeDifference = 1e-4;
// 1 - Fresnel at grazing angles and the densities of sharp lobes amplify the last bit: this
// fraction of the threads may exceed kMaxRelativeDifference, none may exceed kMaxWorst.
constexpr double kMaxIllConditioned = 5e-5;
constexpr double kMaxWorst = 2e-3;

// Largest relative difference of components, against the larger magnitude of the whole vector.
double relativeDifference(const rl::vec3& a, const rl::vec3& b) {
  const rl::vec3 d = a - b;
  const double scale = std::sqrt(double(std::max(dot(a, a), dot(b, b))));
  const double difference = std::sqrt(double(dot(d, d)));
  return scale > 0.0 ? difference / scale : difference;
}

double relativeDifference(float a, float b) {
  return relativeDifference(rl::vec3(a, 0.0f, 0.0f), rl::vec3(b, 0.0f, 0.0f));
}

class Parity : public testing::Test {
 protected:
  void SetUp() override {
    devices_ = testDevices();
    if (devices_.empty()) GTEST_SKIP() << kNoDevice;
  }
  std::vector<TestDevice> devices_;
};

using ParityNightly = Parity;

// Compares both machines over one random surface per pixel.
void compareResampling(std::vector<TestDevice>& devices, const rl::FrameData& frame) {
  const size_t threads = size_t{frame.width} * frame.height;
  const rl::RisParams params{32};
  std::vector<rl::RisResult> host(threads);
  const rl::RisBuffers hostBuffers{{host.data()}};
  runOnHost(rl::kernel_parity_ris_general, rl::SceneData{}, frame, &hostBuffers, &params);
  for (TestDevice& device : devices) {
    SCOPED_TRACE(device.name());
    const GpuBuffer results =
        device.memory->allocate(threads * sizeof(rl::RisResult), MemoryKind::device);
    runOnDevice(device, "tests/parity/ris_kernel.h", "tests/parity/ris_kernel.glsl", 0, frame,
                {results.address}, &params, sizeof params);
    std::vector<rl::RisResult> gpu(threads);
    device.memory->read(results, gpu.data(), threads * sizeof(rl::RisResult));
    device.memory->free(results);
    size_t picked = 0, lobes = 0, values = 0, selected = 0, transmissive = 0;
    double worst = 0.0;
    for (size_t i = 0; i < threads; ++i) {
      selected += host[i].picked != rl::RL_INVALID;
      transmissive += host[i].picked != rl::RL_INVALID && i % 4 == 0;
      lobes += host[i].lobes != gpu[i].lobes;
      if (host[i].picked != gpu[i].picked) {
        ++picked;
        continue;
      }
      if (host[i].lobes != gpu[i].lobes) continue;
      const double difference = std::max({relativeDifference(host[i].W, gpu[i].W),
                                          relativeDifference(host[i].f, gpu[i].f),
                                          relativeDifference(host[i].wi, gpu[i].wi)});
      if (!(difference <= kMaxRelativeDifference)) ++values;
      worst = std::max(worst, difference);
    }
    std::printf(
        "  %s: %zu threads, %zu other selections, %zu other lobes, %zu differ by more than %.0e, "
        "worst %.2g\n",
        device.name().c_str(), threads, picked, lobes, values, kMaxRelativeDifference, worst);
    EXPECT_GT(selected, threads * 9 / 10) << "the kernel hardly selected anything";
    EXPECT_GT(transmissive, threads / 5);
    EXPECT_LT(double(picked), kMaxDifferentDecisions * double(threads));
    EXPECT_LT(double(lobes), kMaxDifferentDecisions * double(threads));
    EXPECT_LT(double(values), kMaxIllConditioned * double(threads));
    EXPECT_LT(worst, kMaxWorst);
  }
}

TEST_F(Parity, ResamplingOverRandomSurfaces) {
  compareResampling(devices_, plainFrame(512, 512, 7));
}

// At 2^20 threads a fraction of 1e-5 is ten threads.
TEST_F(ParityNightly, ResamplingOverRandomSurfaces) {
  compareResampling(devices_, plainFrame(1024, 1024, 8));
}

// Difference of two images with the same seed.
struct ImageDifference {
  size_t pixels = 0;  // number that differs by more than kMaxRelativeDifference
  double worst = 0.0;
};

ImageDifference compareImages(const rl::vec3* a, const rl::vec3* b, size_t pixels) {
  ImageDifference result;
  for (size_t i = 0; i < pixels; ++i) {
    const double difference = relativeDifference(a[i], b[i]);
    if (!(difference <= kMaxRelativeDifference)) ++result.pixels;
    result.worst = std::max(result.worst, difference);
  }
  return result;
}

// A scene whose path-traced frame is compared between the machines.
struct PathCase {
  const char* name;
  Scene (*make)();
  double maxDifferentShare;  // fraction of pixels beyond kMaxRelativeDifference
  double maxMeanDifference;  // relative, of the whole image
  uint32_t multiscatter;     // FrameData::multiscatter
  uint32_t lightTree;        // FrameData::lightTree
};

class PathParity : public Parity, public testing::WithParamInterface<PathCase> {};

rl::dvec3 meanOf(const rl::vec3* image, size_t pixels) {
  rl::dvec3 sum(0.0);
  for (size_t i = 0; i < pixels; ++i) sum += rl::dvec3(image[i]);
  return sum / double(pixels);
}

// Compares a whole path tracer, eight scattering events per path: the C++ build with the same
// brute-force traversal, the program's own kernel with Embree, and the device.
TEST_P(PathParity, SameSeedSameImage) {
  const PathCase& c = GetParam();
  const auto scene = CompiledScene::build(c.make());
  rl::FrameData frame = plainFrame(64, 64, 3);
  frame.camera = scene->camera(scene->source().cameras.front(), frame.width, frame.height);
  frame.previousCamera = frame.camera;
  frame.multiscatter = c.multiscatter;
  if (c.multiscatter != 0u) scene->bindGgxAlbedo();
  frame.lightTree = c.lightTree;
  if (c.lightTree != 0u) scene->bindLightTree();
  const size_t pixels = size_t{frame.width} * frame.height;
  const rl::PathKernelParams params{};
  std::vector<rl::vec3> host(pixels), embree(pixels);
  const rl::PathBuffers hostBuffers{{}, {host.data()}}, embreeBuffers{{}, {embree.data()}};
  runOnHost(rl::kernel_parity_path_general, scene->data(), frame, &hostBuffers, &params);
  runOnHost(rl::findCpuKernel("path", rl::RL_FEATURE_ALL)->entry, scene->data(), frame,
            &embreeBuffers, &params, scene->embreeScene());
  size_t lit = 0;
  for (const rl::vec3& p : host) lit += p.x > 0.0f;
  EXPECT_GT(lit, pixels * 3 / 4);
  const rl::dvec3 mean = meanOf(host.data(), pixels);

  const auto expectAlike = [&](const std::string& who, const rl::vec3* image) {
    const ImageDifference difference = compareImages(host.data(), image, pixels);
    const double meanDifference =
        relativeDifference(rl::vec3(mean), rl::vec3(meanOf(image, pixels)));
    std::printf("  %s: %zu of %zu pixels differ, worst %.2g, means by %.2g\n", who.c_str(),
                difference.pixels, pixels, difference.worst, meanDifference);
    EXPECT_LE(double(difference.pixels), c.maxDifferentShare * double(pixels)) << who;
    EXPECT_LE(meanDifference, c.maxMeanDifference) << who;
  };
  expectAlike("Embree", embree.data());
  for (TestDevice& device : devices_) {
    const GpuBuffer radiance =
        device.memory->allocate(pixels * sizeof(rl::vec3), MemoryKind::device);
    const std::shared_ptr<VulkanScene> uploaded =
        VulkanScene::of(device.memory, scene, SceneRays::bvh);
    const GlslCounters counters = runOnDevice(
        device, "integrators/path/path.h", "integrators/path/path.glsl", uploaded->address(), frame,
        {0, 0, 0, 0, radiance.address}, &params, sizeof params);
    std::vector<rl::vec3> gpu(pixels);
    device.memory->read(radiance, gpu.data(), pixels * sizeof(rl::vec3));
    device.memory->free(radiance);
    expectAlike(device.name(), gpu.data());
    EXPECT_EQ(counters.health[rl::RL_HEALTH_NONFINITE], 0u);
  }
}

const PathCase kPathCases[] = {
    {"EveryFeature", makeEverythingScene, 0.02, 1e-4, 0u, 0u},
    {"EveryFeatureMultiscatter", makeEverythingScene, 0.02, 1e-4, 1u, 0u},
    {"EveryFeatureHierarchyOfLamps", makeEverythingScene, 0.02, 1e-4, 0u, 1u},
};
INSTANTIATE_TEST_SUITE_P(, PathParity, testing::ValuesIn(kPathCases),
                         [](const auto& test) { return test.param.name; });

TEST(EverythingScene, NeedsEveryFeature) {
  // Options of the render, not needs of a scene: compensated multiple scattering, choice of lamps.
  // Closures and layers are under FeatureMaskParity, shapes a scene of their own.
  EXPECT_EQ(CompiledScene::build(makeEverythingScene())->features(),
            rl::RL_FEATURE_ALL &
                ~(rl::RL_FEATURE_CLOSURES | rl::RL_FEATURE_SHAPES | rl::RL_FEATURE_LAYERS |
                  rl::RL_FEATURE_MULTISCATTER | rl::RL_FEATURE_LIGHT_TREE));
}

}  // namespace
}  // namespace restlab::parity
