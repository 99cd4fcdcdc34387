// light_edges, a pass of new views: antialiasing of lamps, and of their images in mirrors. The
// sample defines sampleLightInView(pixel, film, rng) (core/path_sample/path_in_view.glsl).
//
// A pixel at a lamp's edge takes several samples at once, at the film samples that the next still
// frames would use. If the view then stays still, those frames find the same light once more: the
// initial pass gives their unresampled light the weight 0.
//
// A pixel near a lamp or a mirror takes one sample, and several where the last frame has seen light
// in view end. How many may depend on the last frame, because the samples do not: they are drawn
// anew in every frame, and the sample of the pixel's path, whose film sample follows from that of
// the last frame, is left out. In a still view such pixels keep the samples of paths.
#include "core/reuse/history_length.glsl"
#include "core/transport/light_edges.glsl"

// Returns whether lamps or their images end within a pixel of where the last frame showed a
// surface.
RL_FN bool lightInViewEnded(RL_IN(GBufferTexel) here) {
  vec2 film;
  if (isFirstFrame() || !filmPointPrevious(here, film)) return false;
  uint least = 255u;
  uint most = 0u;
  for (uint i = 0u; i < 9u; i = i + 1u) {
    uint x = uint(film.x) + i % 3u - 1u;
    uint y = uint(film.y) + i / 3u - 1u;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    uint word = RL_EARLIER_UVEC4(gBuffers.unresampledPrevious, y * gFrame.width + x).w;
    uint level = unresampledCountUnpack(word).level;
    least = min(least, level);
    most = max(most, level);
  }
  return most > least + RL_LEVELS_OF_AN_EDGE;
}

// Film sample i of a sequence that covers the pixel evenly from any start.
RL_FN uint filmAfter(RL_IN(uvec2) start, uint i) {
  uvec2 at = start + i * uvec2(RL_R2_STEP_X, RL_R2_STEP_Y);
  return (at.x >> 16u) | (at.y & 0xffff0000u);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  UnresampledCount count = unresampledCountUnpack(0u);
  uint samples = gParams.reuse.lightEdgeSamples;
  bool isSeen = samples != 0u && (gFrame.components & RL_COMPONENT_DIRECT) != 0u &&
                gFrame.pixelFilter == RL_FILTER_BOX;
  bool isEdge = isSeen && lightsEndHere(gBuffers.gbuffer, pixel);
  bool isNear = isSeen && !isEdge && lightsAreNear(gBuffers.gbuffer, pixel);
  if (isNear && !lightInViewEnded(gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex)))
    samples = 1u;
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
  if (isEdge || isNear) {
    Rng rng = rngInit(gFrame.seed ^ RL_LIGHT_IN_VIEW_SEED, pixelIndex, gFrame.frame);
    uvec2 start;
    start.x = rngBits(rng, RL_DIM_FILTER_X);
    start.y = rngBits(rng, RL_DIM_FILTER_Y);
    for (uint i = 0u; i < samples; i = i + 1u) {
      uint film = cameraFilmBitsOfFrame(pixel, gFrame.frame + i);
      if (isNear) film = filmAfter(start, i);
      light += sampleLightInView(
          pixel, film,
          rngInit(gFrame.seed ^ RL_LIGHT_IN_VIEW_SEED, pixelIndex, (gFrame.frame << 6u) + i + 1u));
    }
    light *= 1.0f / float(samples);
    count.taken = samples;
    count.frames = isNear ? 1u : 0u;
  }
  RL_WRITE_UVEC4(gBuffers.unresampled, pixelIndex, recordUvec4(light, unresampledCountPack(count)));
}
