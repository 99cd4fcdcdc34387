// Surfaces at the centres of pixels, in the view of a camera.

RL_FN Ray gbufferRay(RL_IN(Camera) camera, uint pixelIndex) {
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  vec2 centre =
      vec2(float(pixelIndex % gFrame.width) + 0.5f, float(pixelIndex / gFrame.width) + 0.5f);
  return cameraRay(camera, centre, resolution);
}

// By pixel: alpha tests are decided alike in every frame.
RL_FN uint gbufferAlphaKey(uint pixelIndex) { return pixelIndex; }

// The surface that a pixel's ray hits.
RL_FN GBufferTexel gbufferOf(RL_IN(Ray) ray, RL_IN(Hit) hit) {
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
  return v;
}

// `distanceToCamera`: along the ray, in metres.
RL_FN GBufferTexel gbufferTrace(RL_IN(Camera) camera, uint pixelIndex,
                                RL_OUT(float) distanceToCamera) {
  Ray ray = gbufferRay(camera, pixelIndex);
  Hit hit = traceNoHit();
  traceRay(ray, RL_RAY_PATH, gbufferAlphaKey(pixelIndex), hit);
  distanceToCamera = hit.t;
  return gbufferOf(ray, hit);
}
