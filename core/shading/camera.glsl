// Cameras: pixel to ray and back. Film coordinates are in pixels, (0, 0) the upper left corner.

RL_FN Ray cameraRay(RL_IN(Camera) camera, RL_IN(vec2) film, RL_IN(vec2) resolution) {
  float x = (2.0f * film.x / resolution.x - 1.0f) * camera.halfWidth + camera.shiftX;
  float y = (1.0f - 2.0f * film.y / resolution.y) * camera.halfHeight + camera.shiftY;
  Ray ray;
  ray.tMin = 0.0f;
  ray.tMax = 3.0e38f;
  if (camera.kind == RL_CAMERA_ORTHOGRAPHIC) {
    ray.origin = camera.posW + camera.rightW * x + camera.upW * y;
    ray.dir = camera.forwardW;
  } else {
    ray.origin = camera.posW;
    ray.dir = normalize(camera.forwardW + camera.rightW * x + camera.upW * y);
  }
  return ray;
}

// Film coordinates of a world position; false behind a perspective camera.
RL_FN bool cameraProject(RL_IN(Camera) camera, RL_IN(vec3) posW, RL_IN(vec2) resolution,
                         RL_OUT(vec2) film) {
  vec3 d = posW - camera.posW;
  float z = dot(d, camera.forwardW);
  float x = dot(d, camera.rightW);
  float y = dot(d, camera.upW);
  film = vec2(0.0f, 0.0f);
  if (camera.kind != RL_CAMERA_ORTHOGRAPHIC) {
    if (!(z > 0.0f)) return false;
    x /= z;
    y /= z;
  }
  film = vec2(((x - camera.shiftX) / camera.halfWidth + 1.0f) * 0.5f * resolution.x,
              (1.0f - (y - camera.shiftY) / camera.halfHeight) * 0.5f * resolution.y);
  return true;
}

// Film sample of a pixel in a frame: a fraction of the pixel's width in the low half word, of its
// height in the high one. Each sample is uniform. A pixel's samples follow the R2 sequence over the
// frames from a random start, so that few frames cover the pixel evenly and any average over frames
// antialiases edges. Rasterisers look at one place in all pixels of a frame
// (FrameData::sharesFilm): the sample of the first pixel, but for low bits, which decide alpha
// tests of each pixel for itself and move its point by less than 2^-12 of its width.
RL_FN uint cameraFilmOfStart(uint pixelIndex, uint frame) {
  uint x = rngFilmStart(pixelIndex, RL_DIM_FILTER_X) + frame * RL_R2_STEP_X;
  uint y = rngFilmStart(pixelIndex, RL_DIM_FILTER_Y) + frame * RL_R2_STEP_Y;
  return (x >> 16u) | (y & 0xffff0000u);
}
RL_FN uint cameraFilmBitsOfFrame(RL_IN(uvec2) pixel, uint frame) {
  // The start does not depend on the frame, nor on the numbers that the path draws in frame 0.
  uint film = cameraFilmOfStart(pixel.y * gFrame.width + pixel.x, frame);
  if (gFrame.sharesFilm != 0u)
    film = (cameraFilmOfStart(0u, frame) & 0xfff0fff0u) | (film & 0x000f000fu);
  return film;
}
RL_FN uint cameraFilmBits(RL_IN(uvec2) pixel) { return cameraFilmBitsOfFrame(pixel, gFrame.frame); }

// Film coordinates of a film sample: anywhere in the pixel (box filter), or its centre.
RL_FN vec2 cameraFilmPoint(RL_IN(uvec2) pixel, uint film) {
  vec2 offset = vec2(0.5f, 0.5f);
  if (gFrame.pixelFilter == RL_FILTER_BOX) {
    offset.x = (float(film & 0xffffu) + 0.5f) * 1.52587890625e-5f;
    offset.y = (float(film >> 16u) + 0.5f) * 1.52587890625e-5f;
  }
  return vec2(float(pixel.x) + offset.x, float(pixel.y) + offset.y);
}

// Ray through a film sample, and the key that decides its alpha tests. The key is part of the film
// sample, so that tracing the ray again hits the same surface.
RL_FN Ray cameraFilmRay(RL_IN(Camera) camera, RL_IN(uvec2) pixel, uint film) {
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  return cameraRay(camera, cameraFilmPoint(pixel, film), resolution);
}
RL_FN uint cameraAlphaKey(uint film) { return rngHash(film ^ 0x27d4eb2fu); }
