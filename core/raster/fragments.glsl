// raster_fragments: the fragment stage of every raster pass; on the CPU a kernel over those
// fragments whose surface has a say: shapes, and what may be transparent.
#include "core/raster/raster.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint at = (pixel.y * RL_ENTRY_ROW + pixel.x) * RL_FRAGMENT_UVEC4S;
  uvec4 q0 = RL_UVEC4(gBuffers.raster.fragments, at);
  uvec4 q1 = RL_UVEC4(gBuffers.raster.fragments, at + 1u);
  Hit hit = traceNoHit();
  hit.instance = q0.x;
  hit.primitive = q0.y;
  hit.bary = vec2(uintBitsToFloat(q0.z), uintBitsToFloat(q0.w));
  float depth = uintBitsToFloat(q1.y);
  uvec2 of = uvec2(q1.x % gFrame.width, q1.x / gFrame.width);
  bool isKept = rasterFragment(of, hit, depth);
  RL_WRITE_UVEC4(
      gBuffers.raster.fragments, at,
      uvec4(hit.instance, hit.primitive, floatBitsToUint(hit.bary.x), floatBitsToUint(hit.bary.y)));
  RL_WRITE_UVEC4(gBuffers.raster.fragments, at + 1u,
                 uvec4(q1.x, floatBitsToUint(depth), isKept ? 1u : 0u, 0u));
}
