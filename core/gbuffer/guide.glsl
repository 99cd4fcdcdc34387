// guide: denoiser features at the film sample of this frame, where the frame's paths begin. One ray
// per pixel, or a rasterised hit. In a still view, guides are means over the view's film samples,
// as is the shaded radiance.
#include "core/transport/light_edges.glsl"
#include "core/gbuffer/first_hit.glsl"
#include "core/gbuffer/guide_data.glsl"

// Most frames in the mean: more would make no difference to a filter.
#define RL_GUIDE_FRAMES 255.0f

RL_FN float guideDisparity(RL_IN(Camera) camera, RL_IN(vec3) posW) {
  return rlSafeDivide(1.0f, dot(posW - camera.posW, camera.forwardW));
}

// Change of disparity per pixel of the film, on the plane through a point.
RL_FN vec2 guideSlope(RL_IN(vec3) posW, RL_IN(vec3) nGeoW, float disparity) {
  Camera camera = gFrame.camera;
  vec2 step = vec2(dot(nGeoW, camera.rightW) * 2.0f * camera.halfWidth / float(gFrame.width),
                   dot(nGeoW, camera.upW) * -2.0f * camera.halfHeight / float(gFrame.height));
  if (camera.kind == RL_CAMERA_ORTHOGRAPHIC) {
    return step * rlSafeDivide(disparity * disparity, dot(nGeoW, camera.forwardW));
  }
  return step * rlSafeDivide(1.0f, dot(nGeoW, posW - camera.posW));
}

// Radians between the directions from which both cameras see a point.
RL_FN float guideViewRotation(RL_IN(vec3) posW) {
  if (gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC)
    return distance(gFrame.camera.forwardW, gFrame.previousCamera.forwardW);
  vec3 now = posW - gFrame.camera.posW;
  vec3 before = posW - gFrame.previousCamera.posW;
  return length(now * rlSafeDivide(1.0f, length(now)) -
                before * rlSafeDivide(1.0f, length(before)));
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  uint film = cameraFilmBits(pixel);
  Ray ray = cameraFilmRay(gFrame.camera, pixel, film);
  Hit hit = traceNoHit();
  if ((gParams.flags & RL_GUIDE_RASTER) != 0u) {
    hit = firstHitRead(gBuffers.firstHits, pixelIndex);
  } else {
    traceRay(ray, RL_RAY_PATH, cameraAlphaKey(film), hit);
  }
  Guide g;
  g.nW = vec3(0.0f, 0.0f, 0.0f);
  g.disparity = 0.0f;
  g.slope = vec2(0.0f, 0.0f);
  g.reflectance = vec3(1.0f, 1.0f, 1.0f);
  g.isLight = 1u;
  Motion motion;
  motion.disparity = 0.0f;
  motion.turn = 0.0f;
  vec2 here = cameraFilmPoint(pixel, film);
  // The background is infinitely far: only the direction counts.
  vec3 posW = ray.dir + gFrame.previousCamera.posW;
  if (hit.instance != RL_INVALID) {
    Surface s = surfaceLoad(hit, ray.dir);
    posW = s.posW;
    g.nW = s.nShadeW;
    g.disparity = guideDisparity(gFrame.camera, posW);
    g.slope = guideSlope(posW, s.nGeoW, g.disparity);
    vec2 toCentre = vec2(float(pixel.x) + 0.5f - here.x, float(pixel.y) + 0.5f - here.y);
    g.disparity = max(g.disparity + dot(g.slope, toCentre), 0.0f);
    bool isSeen = !rlIsBlack(s.emission);
    if (!isSeen && !viewIsStill()) isSeen = lightsEndHere(gBuffers.gbuffer, pixel);
    g.isLight = isSeen ? 1u : 0u;
    vec3 reflectance = vec3(0.0f, 0.0f, 0.0f);
    if ((gParams.flags & RL_GUIDE_DIFFUSE) != 0u) reflectance += s.bsdf.diffuse;
    if (RL_HAS(RL_FEATURE_GLOSSY) && (gParams.flags & RL_GUIDE_SPECULAR) != 0u)
      reflectance += s.bsdf.f0;
    if (!isSeen && (gParams.flags & (RL_GUIDE_DIFFUSE | RL_GUIDE_SPECULAR)) != 0u)
      g.reflectance = clamp(reflectance, vec3(RL_GUIDE_FLOOR, RL_GUIDE_FLOOR, RL_GUIDE_FLOOR),
                            vec3(1.0f, 1.0f, 1.0f));
    motion.disparity =
        guideDisparity(gFrame.previousCamera, posW) - guideDisparity(gFrame.camera, posW);
    motion.turn = bsdfLobeRotation(s.bsdf, guideViewRotation(posW));
  }
  vec2 before;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  motion.film = resolution * 2.0f;
  if (cameraProject(gFrame.previousCamera, posW, resolution, before)) motion.film = before - here;
  // An orthographic camera sees one direction in every pixel.
  if (hit.instance == RL_INVALID && gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC)
    motion.film = vec2(0.0f, 0.0f);
  if (viewIsStill()) {
    Guide held = guideRead(gBuffers.guidePrevious, pixelIndex);
    float weight = 1.0f / (min(float(gFrame.stillFrames), RL_GUIDE_FRAMES) + 1.0f);
    g.isLight = max(g.isLight, held.isLight);
    vec3 n = held.nW * (1.0f - weight) + g.nW * weight;
    g.nW = n * rlSafeDivide(1.0f, length(n));
    g.disparity = held.disparity + (g.disparity - held.disparity) * weight;
    g.slope = held.slope + (g.slope - held.slope) * weight;
    g.reflectance = held.reflectance + (g.reflectance - held.reflectance) * weight;
    if (g.isLight != 0u) g.reflectance = vec3(1.0f, 1.0f, 1.0f);
  }
  guideWrite(gBuffers.guide, pixelIndex, g);
  motionWrite(gBuffers.motion, pixelIndex, motion);
}
