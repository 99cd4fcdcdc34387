// local_corners: the vertex stage of Gouraud shading (Gouraud 1971). Light samples of each corner
// of each triangle, by a model that is a formula; the pixel multiplies by its own albedo.
#include "core/gbuffer/first_hit.glsl"
#include "core/raster/raster.glsl"
#include "integrators/local/lamp_sample.glsl"
#include "integrators/local/shadow_map.glsl"
#include "integrators/local/reflect.glsl"

RL_FN RasterCorner rasterCorner(uint instance, uint part, uint corner) {
  RasterCorner place = rasterPlace(instance, part, corner);
  bool isShape = RL_HAS_SHAPES && shapeIs(recordGeometry(recordInstance(instance).geometry));
  if (isShape || gFrame.maxBounces == 0u) return place;
  Hit hit = localHitAt(instance, place.primitive, place.bary);
  vec3 eyeW = gFrame.camera.posW;
  SurfacePoint point = firstHitPoint(hit);
  vec3 wo = localToEye(point.posW, eyeW, gFrame.camera.forwardW, rasterIsParallel());
  Surface at = surfaceLoad(hit, -wo);
  Rng rng = rngInit(gFrame.seed, rngHash(rngHash(instance) + part), gFrame.frame);
  uint lights = localLightCount(0u);
  for (uint ray = 0u; ray < lights; ray = ray + 1u) {
    Rng own = localRng(rng, 0u, corner, ray, false);
    LightSample light = localLightSample(own, ray, lightReceiverAt(at));
    LightConnection c = lightConnect(light, at.posW);
    vec3 arrives = localArrives(light, c, lights);
    float diffuse;
    float highlight;
    localModelParts(at, c.dirW, diffuse, highlight);
    if (rlIsBlack(arrives) || !(diffuse > 0.0f)) continue;
    float passed = localMapShadow(light, at);
    if (passed < 0.0f) {
      Hit shadow = traceNoHit();
      passed = traceRay(lightShadowRay(light, c, at.posW, at.nGeoW, at.posError), RL_RAY_SHADOW, 0u,
                        shadow);
    }
    arrives *= passed * RL_INV_PI;
    place.diffuse += arrives * diffuse;
    place.highlight += arrives * highlight;
  }
  return place;
}

#include "core/raster/corners.glsl"
