// svgf, first pass: the mean over the frames that showed the surface, and moments of its luminance
// (Schied et al., "Spatiotemporal Variance-Guided Filtering", 2017, sections 4.1 and 4.2). Frames
// have equal weights until there are `cap` of them; then the mean is exponential.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/between.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/svgf/store.glsl"
#include "core/temporal_gradients/read.glsl"

// Similarity of a pixel of the last frame to this surface, 0 to 1.
RL_FN float svgfLikeness(RL_IN(Guide) here, RL_IN(FilterSurface) surface, RL_IN(vec4) there,
                         float dx, float dy) {
  if (here.isLight == 0u) return filterEdge(surface, there, dx, dy);
  if (!guideIsLight(there)) return 0.0f;
  if (here.disparity == 0.0f || there.w == 0.0f) return here.disparity == -there.w ? 1.0f : 0.0f;
  return filterFall((-there.w / here.disparity - 1.0f) / gParams.edges.plane);
}

RL_FN void svgfGather(RL_IN(Guide) here, RL_IN(FilterSurface) surface, RL_IN(vec2) film, float x,
                      float y, float weight, RL_INOUT(SvgfHistory) sum, RL_INOUT(float) weights,
                      RL_INOUT(float) nearest) {
  float share = weight;
  if (!(weight > 0.0f) || !(x >= 0.0f) || !(y >= 0.0f) || !(x < float(gFrame.width)) ||
      !(y < float(gFrame.height)))
    return;
  uint pixelIndex = uint(y) * gFrame.width + uint(x);
  vec4 there = guideSurface(gBuffers.guidePrevious, pixelIndex);
  weight *= svgfLikeness(here, surface, there, x + 0.5f - film.x, y + 0.5f - film.y);
  if (!(weight > 0.0f)) return;
  SvgfHistory h = svgfHistoryRead(gBuffers.historyBefore, pixelIndex);
  // Skip pixels that were never finite: having no history is not the same as a black one.
  if (!(h.frames > 0.0f)) return;
  sum.light += h.light * weight;
  sum.frames += h.frames * weight;
  sum.reflectance += h.reflectance * weight;
  sum.mean += h.mean * weight;
  sum.spread += h.spread * weight;
  sum.step += h.step * weight;
  weights += weight;
  // Take `last` from the nearest pixel alone: a mean of several would differ by their noise.
  if (share > nearest) {
    nearest = share;
    sum.last = h.last;
  }
}

// Returns the history of the surface that the pixel shows, read between the four pixels that saw
// it; zero frames if none did.
RL_FN SvgfHistory svgfReprojected(RL_IN(uvec2) pixel, RL_IN(Guide) here) {
  uint pixelIndex = pixelIndexOf(pixel);
  Motion motion = motionRead(gBuffers.motion, pixelIndex);
  Guide then = here;
  then.disparity = here.disparity + motion.disparity;
  SvgfHistory sum = svgfNoHistory();
  if (here.isLight == 0u && !(then.disparity > 0.0f)) return sum;
  vec2 film = vec2(float(pixel.x) + 0.5f + motion.film.x, float(pixel.y) + 0.5f + motion.film.y);
  float inView = betweenShareInView(film);
  if (!(inView > 0.0f)) return sum;
  float x = floor(film.x - 0.5f);
  float y = floor(film.y - 0.5f);
  float u = film.x - 0.5f - x;
  float v = film.y - 0.5f - y;
  FilterSurface surface = filterSurface(then, gParams.edges);
  float weights = 0.0f;
  float nearest = 0.0f;
  svgfGather(then, surface, film, x, y, (1.0f - u) * (1.0f - v), sum, weights, nearest);
  svgfGather(then, surface, film, x + 1.0f, y, u * (1.0f - v), sum, weights, nearest);
  svgfGather(then, surface, film, x, y + 1.0f, (1.0f - u) * v, sum, weights, nearest);
  svgfGather(then, surface, film, x + 1.0f, y + 1.0f, u * v, sum, weights, nearest);
  // Bilinear weights sum to nearly 0: reject the history.
  if (!(weights > 0.01f)) return svgfNoHistory();
  float scale = 1.0f / weights;
  sum.light *= scale;
  sum.frames *= scale * inView;
  sum.reflectance *= scale;
  sum.mean *= scale;
  sum.spread *= scale;
  sum.step *= scale;
  return sum;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  Filtered now = filterBegin(gBuffers.radiance.data[pixelIndex], guide);
  SvgfHistory h = svgfNoHistory();
  if (viewIsStill()) {
    h = svgfHistoryRead(gBuffers.historyBefore, pixelIndex);
    // Follow the guide, which is the mean over the view's film samples and changes with each frame.
    h.light *= h.reflectance / guide.reflectance;
    h.reflectance = guide.reflectance;
  } else if (!isFirstFrame()) {
    h = svgfReprojected(pixel, guide);
    h.frames = svgfInView(h.frames, pixelIndex);
  }
  h.frames *= changeHistoryKept(gBuffers.changes, gParams.changes, pixelIndex);
  if (!(h.frames > 0.0f)) RL_HEALTH(RL_HEALTH_NEW_HISTORY);
  if (now.reflectance > 0.0f) {
    float luminance = rlLuminance(now.light);
    float held = svgfEffectiveHistoryLength(pixelIndex, h.frames + 1.0f);
    float difference = luminance - h.last;
    float before = h.frames;
    h.frames = min(h.frames, gParams.cap + held - 1.0f) + 1.0f;
    float weight = 1.0f / max(h.frames - held + 1.0f, 1.0f);
    // Keep a ratio of means: radiance that averages film samples itself does not belong to this
    // frame's reflectance, and a mean of quotients would create energy at every edge of a texture.
    h.reflectance += (guide.reflectance - h.reflectance) * weight;
    h.light += (now.light - h.light) * (guide.reflectance / h.reflectance * weight);
    float momentWeight = 1.0f / h.frames;
    // Update the variance directly: a mean of squares minus the square of the mean loses all
    // digits.
    float deviation = luminance - h.mean;
    h.mean += deviation * momentWeight;
    h.spread = (1.0f - momentWeight) * (h.spread + deviation * deviation * momentWeight);
    if (before > 0.0f) h.step += (difference * difference - h.step) / max(h.frames - 1.0f, 1.0f);
    h.last = luminance;
  }
  svgfHistoryWrite(gBuffers.history, pixelIndex, h);
}
