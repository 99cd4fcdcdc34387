#include "core/backend/glsl_preamble.h"

#include <fmt/format.h>

namespace restlab {

namespace {

constexpr const char* kText = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
{extensions}{defines}#include "core/dialect/order.h"
#include "{header}"

const uint kFeatures = {features}u;
const uint kKinds = {kinds}u;  // of closures: the low 16 bits; of shapes: the high ones

// Each address leads to one struct: push constants hold 128 bytes on some devices.
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlSceneRef {{
  SceneData v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlFrameRef {{
  FrameData v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer RlBuffersRef {{
  RL_KERNEL_BUFFERS v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RlParamsRef {{
  RL_KERNEL_PARAMS v;
}};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RlCountersRef {{
  uint stop;
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
  uint64_t sceneBase;  // address of the texels of the scene, and of the buffers
  uint64_t stateBase;
  uint width;
  uint height;
}} rlPush;

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer RlUvec4s {{ uvec4 data[]; }};
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer RlPairs {{ uint64_t data[]; }};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RlTriples {{ uvec3 data[]; }};
#define RL_UVEC4(ref, i) (RlUvec4s(uint64_t(ref)).data[i])

#ifdef RL_TEXELS
// Each struct is bound twice, and its index is always 0. lavapipe compiles a kernel anew for each
// dispatch if a condition depends on numbers of a uniform buffer alone; it cannot tell what stands
// behind an index that it does not know.
layout(set = 0, binding = 0, scalar) uniform RlScene {{ SceneData v; }} rlScene[{copies}];
layout(set = 0, binding = 1, scalar) uniform RlFrame {{ FrameData v; }} rlFrame[{copies}];
layout(set = 0, binding = 2, scalar) uniform RlBuffers {{ RL_KERNEL_BUFFERS v; }} rlBuffers[{copies}];
layout(set = 0, binding = 3, scalar) uniform RlParams {{ RL_KERNEL_PARAMS v; }} rlParams[{copies}];
layout(set = 0, binding = 4) uniform usamplerBuffer rlSceneUvec4s;
layout(set = 0, binding = 5) uniform usamplerBuffer rlSceneWords;
layout(set = 0, binding = 6) uniform usamplerBuffer rlStateUvec4s;
#define gScene rlScene[gl_WorkGroupID.z].v
#define gFrame rlFrame[gl_WorkGroupID.z].v
#define gBuffers rlBuffers[gl_WorkGroupID.z].v
#define gParams rlParams[gl_WorkGroupID.z].v
int rlSceneUvec4At(uint64_t ref, uint i) {{ return int(uint((ref - rlPush.sceneBase) >> 4) + i); }}
int rlSceneWordAt(uint64_t ref, uint i) {{ return int(uint((ref - rlPush.sceneBase) >> 2) + i); }}
int rlStateUvec4At(uint64_t ref, uint i) {{ return int(uint((ref - rlPush.stateBase) >> 4) + i); }}
uint rlSceneUint(uint64_t ref, uint i) {{ return texelFetch(rlSceneWords, rlSceneWordAt(ref, i)).x; }}
uvec2 rlSceneUvec2(uint64_t ref, uint i) {{
  int at = rlSceneWordAt(ref, i * 2u);
  return uvec2(texelFetch(rlSceneWords, at).x, texelFetch(rlSceneWords, at + 1).x);
}}
uvec3 rlSceneUvec3(uint64_t ref, uint i) {{
  int at = rlSceneWordAt(ref, i * 3u);
  return uvec3(texelFetch(rlSceneWords, at).x, texelFetch(rlSceneWords, at + 1).x,
               texelFetch(rlSceneWords, at + 2).x);
}}
void rlWriteUvec4(uint64_t ref, uint i, uvec4 value) {{
  RlPairs pairs = RlPairs(ref);
  pairs.data[2u * i] = packUint2x32(uvec2(value.x, value.y));
  pairs.data[2u * i + 1u] = packUint2x32(uvec2(value.z, value.w));
}}
#define RL_WRITE_UVEC4(ref, i, value) rlWriteUvec4(uint64_t(ref), i, value)
#define RL_SCENE_UVEC4(ref, i) texelFetch(rlSceneUvec4s, rlSceneUvec4At(uint64_t(ref), i))
#define RL_EARLIER_UVEC4(ref, i) texelFetch(rlStateUvec4s, rlStateUvec4At(uint64_t(ref), i))
#define RL_SCENE_UINT(ref, i) rlSceneUint(uint64_t(ref), i)
#define RL_SCENE_FLOAT(ref, i) uintBitsToFloat(rlSceneUint(uint64_t(ref), i))
#define RL_SCENE_VEC2(ref, i) uintBitsToFloat(rlSceneUvec2(uint64_t(ref), i))
#define RL_SCENE_VEC3(ref, i) uintBitsToFloat(rlSceneUvec3(uint64_t(ref), i))
#define RL_SCENE_UVEC3(ref, i) rlSceneUvec3(uint64_t(ref), i)
#define RL_LESSER(a, b) ((a) < (b) ? (a) : (b))
#define RL_GREATER(a, b) ((a) > (b) ? (a) : (b))
#else
#define gScene rlPush.scene.v
#define gFrame rlPush.frame.v
#define gBuffers rlPush.buffers.v
#define gParams rlPush.params.v
#define RL_WRITE_UVEC4(ref, i, value) RlUvec4s(uint64_t(ref)).data[i] = (value)
// All four at once: lavapipe (Mesa 22.3) reads a lone component that is not the first from a wrong
// place in some kernels.
uvec4 rlReadUvec4(uint64_t ref, uint i) {{ return RL_UVEC4(ref, i); }}
#define RL_SCENE_UVEC4(ref, i) rlReadUvec4(uint64_t(ref), i)
#define RL_EARLIER_UVEC4(ref, i) rlReadUvec4(uint64_t(ref), i)
#define RL_SCENE_UINT(ref, i) ((ref).data[i])
#define RL_SCENE_FLOAT(ref, i) ((ref).data[i])
#define RL_SCENE_VEC2(ref, i) ((ref).data[i])
#define RL_SCENE_VEC3(ref, i) ((ref).data[i])
#define RL_SCENE_UVEC3(ref, i) (RlTriples(uint64_t(ref)).data[i])
#define RL_LESSER(a, b) min(a, b)
#define RL_GREATER(a, b) max(a, b)
#endif
#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HAS_CLOSURES ((kKinds & 0xffffu) != 0u)
#define RL_HAS_CLOSURE(kind) ((kKinds & (1u << (kind))) != 0u)
#define RL_HAS_SHAPES ((kKinds & 0xffff0000u) != 0u)
#define RL_HAS_SHAPE(kind) ((kKinds & (0x10000u << (kind))) != 0u)
// Health is rare; rays are counted by each thread and added up at its end.
#define RL_HEALTH(kind) atomicAdd(rlPush.counters.health[kind], 1u)
uint rlRaysPath = 0u;
uint rlRaysShadow = 0u;
#define RL_COUNT_RAY(mode) if ((mode) == RL_RAY_SHADOW) ++rlRaysShadow; else ++rlRaysPath

#include "core/dialect/order.glsl"
#include "{trace}"
#include "{file}"
)";

// Rays are added up once by each subgroup.
constexpr const char* kCompute = R"(
layout(local_size_x = {tile}, local_size_y = {tile}) in;
void main() {{
  uvec2 pixel = gl_GlobalInvocationID.xy;
  bool isInside = pixel.x < rlPush.width && pixel.y < rlPush.height;
  if (isInside && rlPush.counters.stop == 0u) kernelMain(pixel);
  // lavapipe ends loops after 65535 turns of all loops of a kernel together, and says nothing. From
  // then on each loop turns once: this one tells. Its count of turns is one that no compiler knows.
  uint turns = 0u;
  while (turns < 1u + min(rlPush.width, 1u)) ++turns;
  if (isInside && turns < 2u) RL_HEALTH(RL_HEALTH_LOOPS_CUT);
  uint raysPath = subgroupAdd(rlRaysPath);
  uint raysShadow = subgroupAdd(rlRaysShadow);
  if (subgroupElect()) {{
    if (raysPath != 0u) atomicAdd(rlPush.counters.raysPath, raysPath);
    if (raysShadow != 0u) atomicAdd(rlPush.counters.raysShadow, raysShadow);
  }}
}}
)";

// Loops that lavapipe has ended, as in kCompute.
constexpr const char* kCutLoops = R"(
void rlTellCutLoops() {{
  uint turns = 0u;
  while (turns < 1u + min(rlPush.width, 1u)) ++turns;
  if (turns < 2u) RL_HEALTH(RL_HEALTH_LOOPS_CUT);
}}
)";

// The vertex stage: no corner is shared, so that each has the weights of its triangle.
constexpr const char* kVertex = R"(
layout(location = 0) flat out uvec2 rlTriangle;
layout(location = 1) out vec2 rlBary;
#ifdef RL_RASTER_LIGHT
layout(location = 2) out vec3 rlDiffuse;
layout(location = 3) out vec3 rlHighlight;
#endif
void main() {{
  gl_Position = vec4(0.0f);
  if (rlPush.counters.stop != 0u) return;
  uint part = uint(gl_VertexIndex) / 3u;
  RasterCorner corner = rasterCorner(uint(gl_InstanceIndex), part, uint(gl_VertexIndex) % 3u);
  gl_Position = corner.clip;
  rlTriangle = uvec2(uint(gl_InstanceIndex), corner.primitive);
  rlBary = corner.bary;
#ifdef RL_RASTER_LIGHT
  rlDiffuse = corner.diffuse;
  rlHighlight = corner.highlight;
#endif
  if (rlRaysPath != 0u) atomicAdd(rlPush.counters.raysPath, rlRaysPath);
  if (rlRaysShadow != 0u) atomicAdd(rlPush.counters.raysShadow, rlRaysShadow);
  rlTellCutLoops();
}}
)";

constexpr const char* kFragment = R"(
layout(location = 0) flat in uvec2 rlTriangle;
layout(location = 1) in vec2 rlBary;
layout(location = 0) out uvec4 rlHitOut;
#ifdef RL_RASTER_LIGHT
layout(location = 2) in vec3 rlDiffuse;
layout(location = 3) in vec3 rlHighlight;
layout(location = 1) out vec4 rlDiffuseOut;
layout(location = 2) out vec4 rlHighlightOut;
#endif
void main() {{
  Hit hit = traceNoHit();
  hit.instance = rlTriangle.x;
  hit.primitive = rlTriangle.y;
  hit.bary = rlBary;
  float depth = gl_FragCoord.z;
  if (rlPush.counters.stop != 0u) discard;
  if (!rasterFragment(uvec2(gl_FragCoord.xy), hit, depth)) discard;
#ifdef RL_RASTER_DEPTH
  gl_FragDepth = depth;
#endif
  rlHitOut = uvec4(hit.instance, hit.primitive, floatBitsToUint(hit.bary.x),
                   floatBitsToUint(hit.bary.y));
#ifdef RL_RASTER_LIGHT
  rlDiffuseOut = vec4(rlDiffuse, 0.0f);
  rlHighlightOut = vec4(rlHighlight, 0.0f);
#endif
  rlTellCutLoops();
}}
)";

std::string mainOf(GlslStage stage) {
  if (stage == GlslStage::compute) return kCompute;
  return std::string(kCutLoops) + (stage == GlslStage::vertex ? kVertex : kFragment);
}

}  // namespace

std::string glslKernelSource(const GlslKernel& kernel) {
  const uint32_t features = static_cast<uint32_t>(kernel.features);
  const uint32_t kinds = static_cast<uint32_t>(kernel.features >> rl::RL_FEATURE_CLOSURE_SHIFT);
  std::string extensions = kernel.extensions, defines;
  if (kernel.stage == GlslStage::compute)
    extensions =
        "#extension GL_KHR_shader_subgroup_basic : require\n"
        "#extension GL_KHR_shader_subgroup_arithmetic : require\n" +
        extensions;
  if (kernel.readsTexels) defines += "#define RL_TEXELS\n";
  if (kernel.hasLight) defines += "#define RL_RASTER_LIGHT\n";
  // A stage that sets the depth is tested after it ran.
  if ((kernel.features & rl::RL_FEATURE_SHAPES) != 0) defines += "#define RL_RASTER_DEPTH\n";
  return fmt::format(fmt::runtime(std::string(kText) + mainOf(kernel.stage)),
                     fmt::arg("header", kernel.header), fmt::arg("file", kernel.file),
                     fmt::arg("trace", kernel.traceFile), fmt::arg("tile", kGlslTile),
                     fmt::arg("copies", kGlslCopies), fmt::arg("extensions", extensions),
                     fmt::arg("defines", defines), fmt::arg("features", features),
                     fmt::arg("kinds", kinds));
}

}  // namespace restlab
