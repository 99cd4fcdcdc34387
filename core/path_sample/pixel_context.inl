// Members of a kernel context that is made for one pixel, as in core/backend/cpu_kernel.inl.
static constexpr FeatureMask kFeatures = RL_FEATURE_ALL;

const SceneData& gScene;
const FrameData& gFrame;
CpuKernelCounters& gCounters;
RTCScene embreeScene;
const ReuseBuffers& gBuffers;
const PathReuseParams& gParams;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"
