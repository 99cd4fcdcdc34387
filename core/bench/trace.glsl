// trace: traces rays only. One tile of 8 x 8 pixels traces 64 consecutive rays.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint tile = (pixel.y / 8u) * (gFrame.width / 8u) + pixel.x / 8u;
  uint index = tile * 64u + (pixel.y % 8u) * 8u + pixel.x % 8u;
  if (index >= gParams.count) return;
  Hit hit = traceNoHit();
  uvec4 q0 = RL_EARLIER_UVEC4(gBuffers.queries, 3u * index);
  uvec4 q1 = RL_EARLIER_UVEC4(gBuffers.queries, 3u * index + 1u);
  uvec4 q2 = RL_EARLIER_UVEC4(gBuffers.queries, 3u * index + 2u);
  Ray ray;
  ray.origin = recordVec3(q0);
  ray.tMin = uintBitsToFloat(q0.w);
  ray.dir = recordVec3(q1);
  ray.tMax = uintBitsToFloat(q1.w);
  TraceResult result;
  result.transmittance = traceRay(ray, q2.x, q2.y, hit);
  result.hit = hit;
  gBuffers.results.data[index] = result;
}
