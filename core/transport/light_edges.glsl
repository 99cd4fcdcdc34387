// Directly visible light in pixels at the edge of a lamp. A single film sample hits the lamp or
// misses it: the largest error of a frame with a lamp in view. Camera rays are cheap compared with
// paths, so such pixels take several.
//
// Edges of the sky keep one film sample. Objects before the sky are often as bright as the sky, and
// then directly visible and reflected light should come from the same film sample. In a white
// furnace that is exact.

// Returns whether the centre of a pixel shows a lamp. `gbuffer`: core/gbuffer/gbuffer.h.
RL_FN bool lightsAtCentre(RL_IN(Uvec4Ref) gbuffer, uint x, uint y) {
  return gbufferRead(gbuffer, gFrame.camera, y * gFrame.width + x).emits != 0u;
}

// Returns whether a lamp ends at this pixel, judged by its centre and those of the eight pixels
// around it. A light that no centre shows is missed and keeps the path's one sample.
RL_FN bool lightsEndHere(RL_IN(Uvec4Ref) gbuffer, RL_IN(uvec2) pixel) {
  // Skip cameras inside a body: lightsAtFilm() handles neither absorption nor overlapping bodies.
  if (gFrame.cameraMedia.x != 0u) return false;
  bool isLight = lightsAtCentre(gbuffer, pixel.x, pixel.y);
  for (uint i = 0u; i < 9u; i = i + 1u) {
    // Left of column 0 and above row 0 the index wraps to a large number: outside, too.
    uint x = pixel.x + i % 3u - 1u;
    uint y = pixel.y + i / 3u - 1u;
    if (x >= gFrame.width || y >= gFrame.height) continue;
    if (lightsAtCentre(gbuffer, x, y) != isLight) return true;
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

// Mean of the directly visible radiance over the pixel's film samples of this frame and the next
// ones: the average that a still view reaches after `samples` frames.
RL_FN vec3 lightEdges(RL_IN(uvec2) pixel, uint samples) {
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < samples; i = i + 1u) {
    sum += lightsAtFilm(pixel, cameraFilmBitsOfFrame(pixel, gFrame.frame + i));
  }
  return sum * (1.0f / float(samples));
}
