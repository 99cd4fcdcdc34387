// local: the lighting models of real-time graphics. Light that arrives from lamps and the sky, and
// ambient light in place of all other.
//
// Estimator: each surface that the eye sees, straight or in mirrors, is lit by light samples, each
// with a shadow ray or a look into a shadow map. There are no MIS weights, since no BSDF sample
// looks for a light: lamps are seen in mirrors alone. Rough reflections are followed where a glossy
// lobe was drawn, with the weight of all lobes: what they show depends on how lobes are drawn.
// Bias: most light that two rough surfaces scatter is left out, and so are mirrors and glass,
// unless they are asked for. Bodies neither absorb nor scatter, and each of their surfaces is one
// in air. No Russian roulette.
//
// Lighting is computed in each pixel, or at the three corners of a triangle and interpolated
// (Gouraud 1971), or once a triangle; a triangle may be divided for that. The material is that of
// the pixel: a texture is modulated by the light of the corners. Normal maps are read at the
// corners.
//
// All rays leave from one place of the code: GPU compilers write out each traversal. A `job` is one
// turn of that loop: the ray of the eye, the surface that it met, and then the rays of each point:
// light samples before occlusion, which takes a share of the ambient light that lamps gave.

#include "integrators/local/lamp_sample.glsl"
#include "integrators/local/occlusion.glsl"
#include "integrators/local/shadow_map.glsl"
#include "integrators/local/reflect.glsl"
#include "integrators/local/texture_combine.glsl"
#include "core/gbuffer/first_hit.glsl"

// Light after so many scattering events is asked for.
RL_FN bool localWants(uint events) {
  uint component = events >= 2u ? RL_COMPONENT_INDIRECT : RL_COMPONENT_DIRECT;
  return (gFrame.components & component) != 0u;
}

// Share of a point in the light of the pixel.
RL_FN float localShare(RL_IN(Surface) s, uint points, uint point) {
  if (points == 1u) return 1.0f;
  vec3 shares = localPartOf(s).shares;
  if (point == 0u) return shares.x;
  return point == 1u ? shares.y : shares.z;
}

// Shapes are lit in each pixel: they have no corners.
RL_FN bool localIsPerPixel(RL_IN(Surface) s) {
  if (gParams.shading == RL_LOCAL_PER_PIXEL) return true;
  return RL_HAS_SHAPES && shapeIs(recordGeometry(recordInstance(s.id.instance).geometry));
}

// Light samples of this surface were taken in the vertex stage.
RL_FN bool localIsVertexLit(RL_IN(Surface) s, uint events) {
  return gParams.isVertexLit != 0u && events == 0u && !localIsPerPixel(s);
}

RL_FN LocalVertex localVertex(RL_IN(Surface) s, uint events) {
  LocalVertex v;
  v.events = events;
  v.points = 1u;
  v.lights = 0u;
  v.occlusion = 0u;
  if (events >= gFrame.maxBounces || !localWants(events + 1u) || bsdfIsBlack(s.bsdf)) return v;
  if (gParams.shading == RL_LOCAL_GOURAUD && !localIsPerPixel(s)) v.points = 3u;
  bool isOfLamps = gParams.ambientShare > 0.0f && lightExists();
  if (gParams.hasDirect != 0u || isOfLamps) v.lights = localLightCount(events);
  bool hasAmbient = rlIsBlack(s.emission) && (isOfLamps || !rlIsBlack(localAmbient(s)));
  bool isAsked = gParams.occlusion == RL_LOCAL_OCCLUSION_RAYS;
  // The screen knows of what the eye sees straight alone.
  if (gParams.occlusion == RL_LOCAL_OCCLUSION_SCREEN) isAsked = events == 0u;
  if (isAsked && hasAmbient) v.occlusion = events == 0u ? gParams.occlusionRays : 1u;
  if (localIsVertexLit(s, events)) {
    v.points = 1u;
    v.lights = 0u;
  }
  return v;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  uint film = cameraFilmBits(pixel);
  Ray eye = cameraFilmRay(gFrame.camera, pixel, film);
  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  vec3 throughput = vec3(1.0f, 1.0f, 1.0f);
  bool showsLamps = true;  // the last reflection was a mirror's: no light sample knows the lamps
  Surface s = surfaceNone();
  Surface at = s;                        // s, as it is lit at one of its points
  vec3 around = vec3(0.0f, 0.0f, 0.0f);  // ambient light that lamps gave the point
  Hit seen = traceNoHit();
  LocalVertex v = localVertex(s, 0u);
  uint job = 0u;
  for (;;) {
    uint rays = v.lights + v.occlusion;
    uint point = job > 1u ? (job - 2u) / max(rays, 1u) : 0u;
    uint ray = job > 1u ? (job - 2u) % max(rays, 1u) : 0u;
    bool isOcclusion = job > 1u && ray >= v.lights;
    if (job == 1u || (job > 1u && ray == 0u && !localIsPerPixel(s))) {
      Hit load = seen;
      if (job > 1u) load = localPointHit(s, point);
      at = surfaceLoad(load, eye.dir);
      if (job == 1u) localRecolour(at);
    }
    if (ray == 0u) around = vec3(0.0f, 0.0f, 0.0f);
    if (job == 1u) {
      s = at;
      v = localVertex(s, v.events);
      rays = v.lights + v.occlusion;
      // Light samples know nothing of surfaces without a record of a light.
      if ((showsLamps || s.light == RL_INVALID) && localWants(v.events))
        radiance += throughput * s.emission;
      if (v.events >= gFrame.maxBounces || bsdfIsBlack(s.bsdf)) break;
      if (v.occlusion == 0u && localWants(v.events + 1u) && rlIsBlack(s.emission))
        radiance += throughput * localAmbient(s);
      if (localIsVertexLit(s, v.events) && localWants(1u)) {
        vec4 diffuse = recordVec4(RL_EARLIER_UVEC4(gBuffers.raster.diffuse, pixelIndex));
        vec4 highlight = recordVec4(RL_EARLIER_UVEC4(gBuffers.raster.highlight, pixelIndex));
        radiance += localModelAlbedo(s) * vec3(diffuse.x, diffuse.y, diffuse.z);
        radiance += vec3(highlight.x, highlight.y, highlight.z);
      }
    } else if (job > 1u && ray == 0u && !localIsPerPixel(s)) {
      bool isParallel = v.events == 0u && gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC;
      at.wo = localToEye(at.posW, eye.origin, eye.dir, isParallel);
      at.bsdf = s.bsdf;
      if (gParams.shading == RL_LOCAL_FLAT) at.nShadeW = at.nGeoW;
    }

    // The ray of this job, and what it brings if nothing is in its way.
    Ray traced = eye;
    uint mode = RL_RAY_PATH;
    uint key = v.events == 0u ? cameraAlphaKey(film) : rng.key.x + v.events * 0x632be59bu;
    bool traces = job == 0u;
    vec3 unshadowed = vec3(0.0f, 0.0f, 0.0f);
    float passed = 1.0f;
    if (job > 1u) {
      mode = RL_RAY_SHADOW;
      key = 0u;
      Rng own = localRng(rng, v.events, point, isOcclusion ? ray - v.lights : ray, isOcclusion);
      if (isOcclusion) {
        vec2 u;
        u.x = rngDraw(own, RL_DIM_BSDF_U);
        u.y = rngDraw(own, RL_DIM_BSDF_V);
        traced.dir = frameToWorld(at.nShadeW, warpCosineHemisphere(u));
        traced.origin = surfaceOffset(at.posW, at.nGeoW, at.posError, traced.dir);
        traced.tMin = 0.0f;
        traced.tMax = gParams.occlusionRadius > 0.0f ? gParams.occlusionRadius : 3.0e38f;
        // A smooth normal's hemisphere reaches below the face.
        traces = dot(traced.dir, at.nGeoW) > 0.0f;
        vec3 arrives = localAmbient(s) + around * localAlbedo(s);
        if (traces) unshadowed = arrives * (1.0f / float(v.occlusion));
        if (gParams.occlusion == RL_LOCAL_OCCLUSION_SCREEN) {
          traces = false;
          float reach = rngDraw(own, RL_DIM_BSDF_LOBE) * gParams.occlusionRadius;
          if (localIsHidden(at, traced.dir, reach)) passed = 0.0f;
        }
      } else {
        LightSample light = localLightSample(own, ray, lightReceiverAt(at));
        LightConnection c = lightConnect(light, at.posW);
        vec3 arrives = localArrives(light, c, v.lights);
        if (!rlIsBlack(arrives)) {
          if (gParams.hasDirect != 0u) unshadowed = localReflect(at, c.dirW) * arrives;
          traced = lightShadowRay(light, c, at.posW, at.nGeoW, at.posError);
          if (rlIsBlack(s.emission)) around += arrives * (gParams.ambientShare * RL_INV_PI);
        }
        if (!rlIsBlack(unshadowed)) passed = localMapShadow(light, at);
        traces = passed < 0.0f;
      }
    }
    if (job == 0u && v.events == 0u && gParams.isRaster != 0u) {
      seen = firstHitRead(gBuffers.raster.hits, pixelIndex);
      traces = false;
    }
    if (traces) {
      Hit hit = traceNoHit();
      passed = traceRay(traced, mode, key, hit);
      if (job == 0u) seen = hit;
    }
    if (job > 1u) {
      float share = localShare(s, v.points, point);
      radiance += throughput * unshadowed * (passed * share);
      bool isLastLight = v.occlusion == 0u && ray + 1u == v.lights;
      if (isLastLight) radiance += throughput * around * localAlbedo(s) * share;
    }
    if (job == 0u && seen.instance == RL_INVALID) {
      bool isInView = v.events == 0u;
      if (showsLamps && skyExists(isInView) && localWants(v.events))
        radiance += throughput * skyRadiance(eye.dir, isInView);
      break;
    }
    job = job + 1u;
    if (job < 2u + v.points * rays || job == 1u) continue;

    // The surface is lit: on to what it mirrors.
    if (gParams.reflections == 0u) break;
    rng.vertex = v.events + 1u;
    float uLobe = rngDraw(rng, RL_DIM_BSDF_LOBE);
    vec2 u;
    u.x = rngDraw(rng, RL_DIM_BSDF_U);
    u.y = rngDraw(rng, RL_DIM_BSDF_V);
    BsdfSample draw = bsdfSample(s.bsdf, s.nGeoW, s.nShadeW, s.wo, uLobe, u);
    showsLamps = (draw.lobe & RL_LOBE_ANY_DELTA) != 0u;
    bool goesOn = showsLamps;
    if (gParams.reflections == RL_LOCAL_GLOSSY)
      goesOn = showsLamps || (draw.lobe & (RL_LOBE_SPECULAR | RL_LOBE_TRANSMISSION)) != 0u;
    if (!goesOn || rlIsBlack(draw.weight)) break;
    throughput *= draw.weight;
    eye.origin = surfaceOffset(s.posW, s.nGeoW, s.posError, draw.wi);
    eye.dir = draw.wi;
    eye.tMin = 0.0f;
    eye.tMax = 3.0e38f;
    v.events = v.events + 1u;
    job = 0u;
  }
  if (!rlIsFinite3(radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixelIndex] = radiance;
}
