#include "core/backend/glsl_preamble.h"

#include <fmt/format.h>

namespace restlab {

namespace {

constexpr const char* kText = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
{extensions}#include "core/dialect/order.h"
#include "{header}"

layout(local_size_x = {tile}, local_size_y = {tile}) in;
layout(constant_id = 0) const uint kFeatures = RL_FEATURE_ALL;

// Each address leads to one struct: push constants hold 128 bytes on some devices.
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlSceneRef {{
  SceneData v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlFrameRef {{
  FrameData v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlBuffersRef {{
  RL_KERNEL_BUFFERS v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlParamsRef {{
  RL_KERNEL_PARAMS v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RlCountersRef {{
  uint raysPath;
  uint raysShadow;
  uint health[RL_HEALTH_COUNT];
}};
layout(push_constant, scalar) uniform RlPushConstants {{
  RlSceneRef scene;
  RlFrameRef frame;
  RlBuffersRef buffers;
  RlParamsRef params;
  RlCountersRef counters;
}} rlPush;

#define gScene rlPush.scene.v
#define gFrame rlPush.frame.v
#define gBuffers rlPush.buffers.v
#define gParams rlPush.params.v
#define RL_HAS(features) ((kFeatures & (features)) != 0u)
// Health is rare; rays are counted by each thread and added up once by each subgroup.
#define RL_HEALTH(kind) atomicAdd(rlPush.counters.health[kind], 1u)
uint rlRaysPath = 0u;
uint rlRaysShadow = 0u;
#define RL_COUNT_RAY(mode) if ((mode) == RL_RAY_SHADOW) ++rlRaysShadow; else ++rlRaysPath

#include "core/dialect/order.glsl"
#include "{trace}"
#include "{file}"

void main() {{
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x < gFrame.width && pixel.y < gFrame.height) kernelMain(pixel);
  uint raysPath = subgroupAdd(rlRaysPath);
  uint raysShadow = subgroupAdd(rlRaysShadow);
  if (subgroupElect()) {{
    if (raysPath != 0u) atomicAdd(rlPush.counters.raysPath, raysPath);
    if (raysShadow != 0u) atomicAdd(rlPush.counters.raysShadow, raysShadow);
  }}
}}
)";

}  // namespace

std::string glslKernelSource(const GlslKernel& kernel) {
  return fmt::format(kText, fmt::arg("header", kernel.header), fmt::arg("file", kernel.file),
                     fmt::arg("trace", kernel.traceFile), fmt::arg("tile", kGlslTile),
                     fmt::arg("extensions", kernel.extensions));
}

}  // namespace restlab
