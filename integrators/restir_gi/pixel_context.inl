// Members of a kernel context that is made for one pixel, as core/backend/cpu_kernel.inl has them.
static constexpr uint kFeatures = FEATURES;

const SceneData& gScene;
const FrameData& gFrame;
CpuKernelCounters& gCounters;
RTCScene embreeScene;
const RestirGiBuffers& gBuffers;
const RestirGiParams& gParams;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"

// What a slot has after the frame, its suffix too.
PathReservoir reservoirOf(uint slot) {
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  giReadNow(slot, r);
  return r;
}
