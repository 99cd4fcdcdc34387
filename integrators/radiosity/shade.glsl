// radiosity: the light that diffuse surfaces exchange, solved for once; a frame costs one ray a
// pixel.
//
// The system: the irradiance of every vertex of a mesh of elements is that of the sources plus what
// elements reflect, by form factors with visibility (Goral et al. 1984; vertices: Max and Allison
// 1992). In between it is interpolated. Bias: every surface reflects as Lambert's with its own
// albedo, and light varies linearly within an element: shadows and corners are blurred by its size.
// Bodies neither absorb nor scatter. Jacobi's iteration k is what k + 1 scattering events make, and
// max_bounces ends it; the other solvers go on to the end.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  uint film = cameraFilmBits(pixel);
  Ray eye = cameraFilmRay(gFrame.camera, pixel, film);
  Hit hit = traceNoHit();
  traceRay(eye, RL_RAY_PATH, cameraAlphaKey(film), hit);
  bool wantsDirect = (gFrame.components & RL_COMPONENT_DIRECT) != 0u;
  vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
  uint seen = 0u;
  if (hit.instance == RL_INVALID) {
    if (wantsDirect && skyExists(true)) radiance = skyRadiance(eye.dir, true);
  } else {
    Surface s = surfaceLoad(hit, eye.dir);
    if (wantsDirect) radiance = s.emission;
    ElementPlace place = meshPlace(s.id);
    uint back = 1u - s.isFront;
    uint side = 2u * place.element + back;
    seen = 1u + side;
    if (gFrame.maxBounces > 0u && !bsdfIsBlack(s.bsdf)) {
      vec3 irradiance = meshIrradiance(side, place.weights);
      uvec4 corners = meshElementVertices(place.element);
      vec3 direct = place.weights.x * gBuffers.source.data[2u * corners.x + back] +
                    place.weights.y * gBuffers.source.data[2u * corners.y + back] +
                    place.weights.z * gBuffers.source.data[2u * corners.z + back];
      bool wantsIndirect =
          (gFrame.components & RL_COMPONENT_INDIRECT) != 0u && gFrame.maxBounces > 1u;
      if (!wantsDirect) irradiance = irradiance - direct;
      if (!wantsIndirect) irradiance = wantsDirect ? direct : vec3(0.0f, 0.0f, 0.0f);
      vec3 albedo = min(bsdfAlbedo(s.bsdf), vec3(1.0f, 1.0f, 1.0f));
      radiance += albedo * irradiance * RL_INV_PI;
    }
  }
  if (!rlIsFinite3(radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixelIndex] = radiance;
  gBuffers.seen.data[pixelIndex] = seen;
}
