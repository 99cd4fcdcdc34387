// The GLSL side of a kernel: the counterpart of core/backend/cpu_kernel.inl.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/backend/glsl_stage.h"
#include "core/dialect/features.h"
#include "core/dialect/types.h"

namespace restlab {

// A kernel as rl_add_kernel names it; paths are relative to the repository.
struct GlslKernel {
  std::string header;           // Buffers and Params, RL_KERNEL_BUFFERS and RL_KERNEL_PARAMS
  std::string file;             // defines kernelMain()
  std::string traceFile;        // defines traceRay()
  std::string extensions = {};  // "#extension" lines that the trace file needs
  bool readsTexels = false;     // reads by texels and uniform blocks instead of addresses
  rl::FeatureMask features = rl::RL_FEATURE_ALL;
  GlslStage stage = GlslStage::compute;
  bool hasLight = false;  // raster stages: corners have light
};

// Implementation of traceRay().
struct GlslTrace {
  const char* file;
  const char* extensions;
};
constexpr GlslTrace kGlslTraceBvh = {"core/geometry/trace_bvh.glsl", ""};
constexpr GlslTrace kGlslTraceQuery = {"core/backend/trace_query.glsl",
                                       "#extension GL_EXT_ray_query : require\n"};

// Threads of a workgroup in x and y: a tile of the image.
constexpr uint32_t kGlslTile = 8;

// Counters that a kernel adds to; zero them before a dispatch. Values wrap at 2^32. Threads that
// begin after the host has set `stop` do nothing.
struct GlslCounters {
  uint32_t stop = 0;
  uint32_t raysPath = 0;
  uint32_t raysShadow = 0;
  std::array<uint32_t, rl::RL_HEALTH_COUNT> health{};
};

// Bindings of set 0 of kernels that read by texels: the four structs as uniform blocks, the last
// two with dynamic offsets, then the scene in texels of four words and of one, and the buffers in
// texels of four.
enum GlslBinding : uint32_t {
  kGlslScene,
  kGlslFrame,
  kGlslBuffers,
  kGlslParams,
  kGlslSceneUvec4s,
  kGlslSceneWords,
  kGlslStateUvec4s,
  kGlslBindingCount
};
// Each struct is bound so many times (core/backend/glsl_preamble.cpp says why).
constexpr uint32_t kGlslCopies = 2;
constexpr uint32_t kGlslDynamicOffsets = 2 * kGlslCopies;

// The push constants: device addresses of SceneData, FrameData, the kernel's Buffers and Params
// structs, and GlslCounters.
struct GlslPushConstants {
  uint64_t scene = 0;
  uint64_t frame = 0;
  uint64_t buffers = 0;
  uint64_t params = 0;
  uint64_t counters = 0;
  // Base addresses of the scene's texels and of the buffers' texels, for kernels that read by
  // texels.
  uint64_t sceneBase = 0;
  uint64_t stateBase = 0;
  // Number of pixels, or of entries in rows, that the pass runs over.
  uint32_t width = 0, height = 0;
};

// The whole shader, with #include lines that the compiler's includer resolves against the
// repository. The feature mask is two constants: features, and kinds of closures.
std::string glslKernelSource(const GlslKernel& kernel);

}  // namespace restlab
