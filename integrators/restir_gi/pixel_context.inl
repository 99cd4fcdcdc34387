// Members of a kernel context that is made for one pixel, as in core/backend/cpu_kernel.inl.
static constexpr uint kFeatures = FEATURES;

const SceneData& gScene;
const FrameData& gFrame;
CpuKernelCounters& gCounters;
RTCScene embreeScene;
const ReuseBuffers& gBuffers;
const RestirGiParams& gParams;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"

// Returns the reservoir of a pixel as the spatial pass found it, with its suffix.
PathReservoir reservoirOf(uint pixelIndex) {
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  reservoirReadNow(pixelIndex, r);
  return r;
}
