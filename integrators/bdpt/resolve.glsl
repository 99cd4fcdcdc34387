// Adds what light paths have left in a pixel to what its own path has found.
#include "integrators/bdpt/splat.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  uint first = pixelIndex * RL_BDPT_SPLAT_WORDS;
  uint count = gBuffers.splats.data[first + RL_BDPT_SPLAT_WORDS - 1u];
  if (count == 0u) return;
  if (count >= RL_BDPT_MOST_SPLATS) RL_HEALTH(RL_HEALTH_NONFINITE);
  uint exponent = bdptUnitExponent();
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  float unit = uintBitsToFloat(exponent << 23u);
  for (uint i = 0u; i < RL_BDPT_DIGITS; i = i + 1u) {
    uint at = first + i * 3u;
    float weight = uintBitsToFloat((127u + RL_BDPT_DIGIT_BITS * i - RL_BDPT_UNIT_BIT) << 23u);
    sum += vec3(float(gBuffers.splats.data[at]), float(gBuffers.splats.data[at + 1u]),
                float(gBuffers.splats.data[at + 2u])) *
           weight;
  }
  gBuffers.radiance.data[pixelIndex] += sum * unit;
}
