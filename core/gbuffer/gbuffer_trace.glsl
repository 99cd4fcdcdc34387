// Traces the centre of a pixel in the view of a camera.

// `distanceToCamera`: along the ray, in metres.
RL_FN GBufferTexel gbufferTrace(RL_IN(Camera) camera, uint pixelIndex,
                                RL_OUT(float) distanceToCamera) {
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec2 centre =
      vec2(float(pixelIndex % gFrame.width) + 0.5f, float(pixelIndex / gFrame.width) + 0.5f);
  Ray ray = cameraRay(camera, centre, resolution);
  Hit hit = traceNoHit();
  // Key by the pixel: alpha tests are decided alike in every frame.
  traceRay(ray, RL_RAY_PATH, pixelIndex, hit);
  GBufferTexel v;
  v.posW = ray.dir;
  v.isHit = 0u;
  v.emits = 0u;
  v.isMirror = 0u;
  v.nGeoW = packNormal(-ray.dir);
  v.nShadeW = v.nGeoW;
  v.reflectance = vec3(0.0f, 0.0f, 0.0f);
  if (hit.instance != RL_INVALID) {
    Surface s = surfaceLoad(hit, ray.dir);
    v.posW = ray.origin + ray.dir * hit.t;
    v.isHit = 1u;
    v.emits = rlIsBlack(s.emission) ? 0u : 1u;
    v.isMirror = bsdfIsMirror(s.bsdf, RL_MIRROR_ALPHA) ? 1u : 0u;
    v.nGeoW = packNormal(s.nGeoW);
    v.nShadeW = packNormal(s.nShadeW);
    v.reflectance = bsdfReflectance(s.bsdf);
  }
  distanceToCamera = hit.t;
  return v;
}
