// Cameras: pixel to ray and back. Film coordinates are in pixels, (0, 0) the upper left corner.

RL_FN Ray cameraRay(RL_IN(Camera) camera, RL_IN(vec2) film, RL_IN(vec2) resolution) {
  float x = (2.0f * film.x / resolution.x - 1.0f) * camera.halfWidth;
  float y = (1.0f - 2.0f * film.y / resolution.y) * camera.halfHeight;
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
  film = vec2((x / camera.halfWidth + 1.0f) * 0.5f * resolution.x,
              (1.0f - y / camera.halfHeight) * 0.5f * resolution.y);
  return true;
}

// Unit direction from a surface point to the camera.
RL_FN vec3 cameraDirectionFrom(RL_IN(Camera) camera, RL_IN(vec3) posW) {
  if (camera.kind == RL_CAMERA_ORTHOGRAPHIC) return -camera.forwardW;
  return normalize(camera.posW - posW);
}

// The film point of a pixel in this frame: uniform over the pixel (box filter) or its centre. It is
// kept for filmHold frames, pixels changing at different times: while it stays and the camera
// stands still, the first hit is the same point, and what was visible from it last frame is visible
// now. Over independent runs each frame's film point is uniform, so this changes no expectation.
RL_FN vec2 cameraFilmSample(RL_IN(uvec2) pixel) {
  vec2 offset = vec2(0.5f, 0.5f);
  if (gFrame.pixelFilter == RL_FILTER_BOX) {
    uint pixelIndex = pixel.y * gFrame.width + pixel.x;
    uint epoch = (gFrame.frame + rngHash(pixelIndex) % gFrame.filmHold) / gFrame.filmHold;
    Rng rng = rngInit(gFrame.seed ^ 0x5bd1e995u, pixelIndex, epoch);
    offset.x = rngDraw(rng, RL_DIM_FILTER_X);
    offset.y = rngDraw(rng, RL_DIM_FILTER_Y);
  }
  return vec2(float(pixel.x) + offset.x, float(pixel.y) + offset.y);
}
