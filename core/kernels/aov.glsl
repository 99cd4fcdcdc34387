// aov: first-hit attributes of the film samples that the frame used (same seed, same draws).

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
    gBuffers.emission.data[pixelIndex] = environmentExists() ? environmentRadiance(ray.dir) : zero;
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
}
