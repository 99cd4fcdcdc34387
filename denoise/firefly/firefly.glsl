// firefly: clamps each pixel to its brightest neighbour, times a factor. The energy that the clamp
// takes away is lost. Lights and pixels beside them are left alone.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  vec3 radiance = gBuffers.radiance.data[pixelIndex];
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  Filtered here = filterBegin(radiance, guide);
  float greatest = 0.0f;
  uint neighbours = 0u;
  uint side = 2u * gParams.radius + 1u;
  for (uint i = 0u; i < side * side; i = i + 1u) {
    // Left of column 0 and above row 0 the index wraps to a large number: outside, too.
    uint x = pixel.x + i % side - gParams.radius;
    uint y = pixel.y + i / side - gParams.radius;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    uint other = y * gFrame.width + x;
    if (other == pixelIndex) continue;
    Guide there = guideRead(gBuffers.guide, other);
    float luminance = rlLuminance(gBuffers.radiance.data[other] / there.reflectance);
    if (!rlIsFinite(luminance)) continue;
    greatest = max(greatest, luminance);
    neighbours = neighbours + 1u;
  }
  vec3 shown = !(here.reflectance > 0.0f) ? vec3(0.0f, 0.0f, 0.0f) : radiance;
  float luminance = rlLuminance(here.light);
  float most = greatest * gParams.factor;
  if (guide.isLight == 0u && neighbours > 0u && luminance > most) {
    RL_HEALTH(RL_HEALTH_FIREFLIES);
    shown *= most / luminance;
  }
  gBuffers.shown.data[pixelIndex] = shown;
}
