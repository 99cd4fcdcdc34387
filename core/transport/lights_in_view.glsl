// Light that the camera sees directly, in pixels that show the edge of a lamp. One film sample
// meets it or does not: the largest error of a frame with a lamp in view. A camera ray is cheap
// beside a path, so such pixels take several.
//
// Edges of the sky keep the one: what stands before it is often as bright, and then it is best that
// light in view and the rest are of the same film sample. In a white furnace that is exact.

// Does the centre of a pixel show a lamp? `visible`: core/dialect/visible.h.
RL_FN bool lightsAtCentre(RL_IN(QuadRef) visible, uint x, uint y) {
  return visibleRead(visible, gFrame.camera, y * gFrame.width + x).emits != 0u;
}

// As far as the centres of the eight pixels around it tell. A light that no centre shows is missed:
// it keeps the path's one sample.
RL_FN bool lightsEndHere(RL_IN(QuadRef) visible, RL_IN(uvec2) pixel) {
  // Light is dimmed on its way in a body, and may pass surfaces that are none.
  if (gFrame.cameraMedia.x != 0u) return false;
  bool isLight = lightsAtCentre(visible, pixel.x, pixel.y);
  for (uint i = 0u; i < 9u; i = i + 1u) {
    // Left of column 0 and above row 0 the number wraps to the largest there is: outside, too.
    uint x = pixel.x + i % 3u - 1u;
    uint y = pixel.y + i / 3u - 1u;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    if (lightsAtCentre(visible, x, y) != isLight) return true;
  }
  return false;
}

// Radiance that the camera sees directly at a film sample.
RL_FN vec3 lightsAtFilm(RL_IN(uvec2) pixel, uint film) {
  Ray ray = cameraFilmRay(gFrame.camera, pixel, film);
  Hit hit = traceNoHit();
  traceRay(ray, RL_RAY_PATH, cameraAlphaKey(film), hit);
  if (hit.instance != RL_INVALID) return surfaceLoad(hit, ray.dir).emission;
  if (environmentExists()) return environmentRadiance(ray.dir);
  return vec3(0.0f, 0.0f, 0.0f);
}

// Its mean over the pixel's film samples of this frame and the next ones: what a still view would
// have averaged after so many frames.
RL_FN vec3 lightsInView(RL_IN(uvec2) pixel, uint samples) {
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < samples; i = i + 1u) {
    sum += lightsAtFilm(pixel, cameraFilmBitsOfFrame(pixel, gFrame.frame + i));
  }
  return sum * (1.0f / float(samples));
}
