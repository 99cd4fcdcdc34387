// aov: first-hit attributes of the film samples that the frame used (same seed, same draws).

// Returns the motion in pixels from the film sample to the same point on the last frame's film, and
// the point's depth there. Two images away if the point was behind the camera. The background is
// infinitely far: only the direction counts.
RL_FN vec3 aovMotion(RL_IN(uvec2) pixel, uint film, RL_IN(vec3) posW, bool isHit) {
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec2 before;
  vec2 motion = resolution * 2.0f;
  if (cameraProject(gFrame.previousCamera, posW, resolution, before))
    motion = before - cameraFilmPoint(pixel, film);
  // An orthographic camera sees one direction in every pixel.
  if (!isHit && gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC) motion = vec2(0.0f, 0.0f);
  vec3 fromCamera = posW - gFrame.previousCamera.posW;
  // Measure along the ray, as in the layer `depth`: rays of an orthographic camera are parallel.
  float depthBefore = gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC
                          ? dot(fromCamera, gFrame.previousCamera.forwardW)
                          : length(fromCamera);
  return vec3(motion.x, motion.y, isHit ? depthBefore : 0.0f);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  Ray ray = cameraFilmRay(gFrame.camera, pixel, film);
  Hit hit;
  traceRay(ray, RL_RAY_PATH, cameraAlphaKey(film), hit);
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  if (hit.instance == RL_INVALID) {
    gBuffers.positionW.data[pixelIndex] = zero;
    gBuffers.normalW.data[pixelIndex] = zero;
    gBuffers.albedo.data[pixelIndex] = zero;
    gBuffers.depth.data[pixelIndex] = zero;
    gBuffers.object.data[pixelIndex] = zero;
    gBuffers.ambient.data[pixelIndex] = zero;
    gBuffers.motion.data[pixelIndex] =
        aovMotion(pixel, film, ray.dir + gFrame.previousCamera.posW, false);
    gBuffers.emission.data[pixelIndex] = skyExists(true) ? skyRadiance(ray.dir, true) : zero;
    return;
  }
  Surface s = surfaceLoad(hit, ray.dir);
  gBuffers.positionW.data[pixelIndex] = s.posW;
  gBuffers.normalW.data[pixelIndex] = s.nShadeW;
  gBuffers.albedo.data[pixelIndex] = bsdfAlbedo(s.bsdf);
  gBuffers.depth.data[pixelIndex] = vec3(hit.t, hit.t, hit.t);
  float object = float(hit.instance + 1u);
  gBuffers.object.data[pixelIndex] = vec3(object, object, object);
  gBuffers.emission.data[pixelIndex] = s.emission;
  bool isLit = RL_HAS(RL_FEATURE_AMBIENT) && rlIsBlack(s.emission) && gFrame.maxBounces > 0u &&
               (gFrame.components & RL_COMPONENT_DIRECT) != 0u;
  gBuffers.ambient.data[pixelIndex] = isLit ? surfaceAmbient(s) : zero;
  gBuffers.motion.data[pixelIndex] = aovMotion(pixel, film, s.posW, true);
}
