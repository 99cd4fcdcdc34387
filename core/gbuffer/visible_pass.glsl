// visible: surfaces at pixel centres. One ray per pixel, in frames of a new view.

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec2 centre = vec2(float(pixel.x) + 0.5f, float(pixel.y) + 0.5f);
  Ray ray = cameraRay(gFrame.camera, centre, resolution);
  Hit hit = traceNoHit();
  // Key by the pixel: alpha tests are decided alike in every frame.
  traceRay(ray, RL_RAY_PATH, pixelIndex, hit);
  GBufferTexel v;
  v.isHit = 0u;
  v.emits = 0u;
  v.nGeoW = packNormal(-ray.dir);
  v.nShadeW = v.nGeoW;
  v.reflectance = vec3(0.0f, 0.0f, 0.0f);
  if (hit.instance != RL_INVALID) {
    Surface s = surfaceLoad(hit, ray.dir);
    v.isHit = 1u;
    v.emits = rlIsBlack(s.emission) ? 0u : 1u;
    v.nGeoW = packNormal(s.nGeoW);
    v.nShadeW = packNormal(s.nShadeW);
    v.reflectance = bsdfReflectance(s.bsdf);
  }
  visibleWrite(gBuffers.visible, pixelIndex, v, hit.t);
}
