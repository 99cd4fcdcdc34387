// The film as a light's path sees it: all light paths of a frame share the whole film.

// Returns whether a light's path may be joined to the camera: film samples without extent are never
// met.
RL_FN bool bdptSplats() { return gFrame.pixelFilter == RL_FILTER_BOX; }

// Density of camera rays over the whole film: per solid angle in a direction (unit, away from the
// camera), of an orthographic camera per area across it.
RL_FN float bdptFilmDensity(RL_IN(vec3) dirW) {
  float density = 0.25f / (gFrame.camera.halfWidth * gFrame.camera.halfHeight);
  if (gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC) return density;
  float cosine = dot(dirW, gFrame.camera.forwardW);
  return density / (cosine * cosine * cosine);
}

// The pixel that shows a point, and the place of the camera from which it does. Returns false
// outside of the film.
RL_FN bool bdptSeenBy(RL_IN(vec3) posW, RL_OUT(uint) pixel, RL_OUT(vec3) eyeW) {
  vec2 film;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  bool isBefore = cameraProject(gFrame.camera, posW, resolution, film);
  pixel = 0u;
  eyeW = gFrame.camera.posW;
  if (gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC) {
    float z = dot(posW - gFrame.camera.posW, gFrame.camera.forwardW);
    eyeW = posW - gFrame.camera.forwardW * z;
    isBefore = z > 0.0f;
  }
  if (!isBefore || !(film.x >= 0.0f) || !(film.y >= 0.0f)) return false;
  if (!(film.x < resolution.x) || !(film.y < resolution.y)) return false;
  pixel = pixelIndexOf(uvec2(uint(film.x), uint(film.y)));
  return true;
}
