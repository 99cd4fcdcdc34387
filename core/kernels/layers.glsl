// layers: guides from layers that came with an image.
#include "core/kernels/guide_data.glsl"

// 0 of the background, which has no depth, an infinite one, or no normal.
RL_FN float layersDisparity(uint slot) {
  float depth = gBuffers.depth.data[slot].x;
  vec3 nW = gBuffers.normalW.data[slot];
  if (dot(nW, nW) == 0.0f) return 0.0f;
  // What is no number stays none: machines differ in the maximum of it.
  return depth < 0.0f ? 0.0f : rlSafeDivide(1.0f, depth);
}

// Pixels on each side that a slope is told by: a layer may be of any point within a pixel.
#define RL_LAYERS_REACH 3u

// The disparity so many pixels to a side, where all between have the same normal; 0 elsewhere.
RL_FN float layersAlong(uvec2 pixel, ivec2 side, RL_IN(vec3) nW, RL_OUT(float) apart) {
  float disparity = 0.0f;
  apart = 0.0f;
  for (uint i = 1u; i <= RL_LAYERS_REACH; i = i + 1u) {
    ivec2 at = ivec2(int(pixel.x), int(pixel.y)) + side * int(i);
    if (at.x < 0 || at.y < 0 || at.x >= int(gFrame.width) || at.y >= int(gFrame.height)) break;
    uint slot = uint(at.y) * gFrame.width + uint(at.x);
    float there = layersDisparity(slot);
    if (!(there > 0.0f) || !(dot(nW, gBuffers.normalW.data[slot]) > 0.95f)) break;
    disparity = there;
    apart = float(i);
  }
  return disparity;
}

// Change of the disparity from one pixel to the next, towards the side that differs less: the other
// one may lie beyond an edge.
RL_FN float layersSlope(uvec2 pixel, ivec2 side, RL_IN(vec3) nW, float here) {
  float apartBefore;
  float apartAfter;
  float before = layersAlong(pixel, -side, nW, apartBefore);
  float after = layersAlong(pixel, side, nW, apartAfter);
  float backward = rlSafeDivide(here - before, apartBefore);
  float forward = rlSafeDivide(after - here, apartAfter);
  if (apartBefore > 0.0f && apartAfter > 0.0f) {
    return abs(backward) < abs(forward) ? backward : forward;
  }
  return apartBefore > 0.0f ? backward : forward;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Guide g;
  g.nW = gBuffers.normalW.data[slot];
  g.disparity = layersDisparity(slot);
  g.isLight = g.disparity > 0.0f && !(gBuffers.depth.data[slot].y > 0.0f) ? 0u : 1u;
  if (!rlIsFinite3(g.nW) || !rlIsFinite(g.disparity)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    g.nW = vec3(0.0f, 0.0f, 0.0f);
    g.disparity = 0.0f;
    g.isLight = 1u;
  }
  g.slope.x = layersSlope(pixel, ivec2(1, 0), g.nW, g.disparity);
  g.slope.y = layersSlope(pixel, ivec2(0, 1), g.nW, g.disparity);
  g.reflectance = vec3(1.0f, 1.0f, 1.0f);
  vec3 albedo = gBuffers.albedo.data[slot];
  if (g.isLight == 0u && gParams.demodulates != 0u && rlIsFinite3(albedo)) {
    g.reflectance =
        clamp(albedo, vec3(RL_GUIDE_FLOOR, RL_GUIDE_FLOOR, RL_GUIDE_FLOOR), vec3(1.0f, 1.0f, 1.0f));
  }
  guideWrite(gBuffers.guide, slot, g);
  vec3 motion = gBuffers.motion.data[slot];
  Motion m;
  m.film = vec2(motion.x, motion.y);
  m.disparity = motion.z > 0.0f ? 1.0f / motion.z - g.disparity : 0.0f;
  m.turn = 0.0f;
  motionWrite(gBuffers.motions, slot, m);
}
