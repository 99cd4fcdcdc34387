// traceRay() by ray queries (GL_EXT_ray_query), for devices that have them: GLSL alone, not the
// dialect. The acceleration structure (core/backend/vulkan_acceleration.h) flags opaque instances:
// the loop below only sees instances that may be transparent in part.
float traceRay(in Ray ray, uint mode, uint key, out Hit hit) {
  RL_COUNT_RAY(mode);
  hit.instance = RL_INVALID;
  hit.primitive = RL_INVALID;
  hit.bary = vec2(0.0f, 0.0f);
  hit.t = 0.0f;
  // An empty or NaN interval contains nothing, and a ray query must not get one.
  if (!(ray.tMin <= ray.tMax)) return 1.0f;
  AlphaPassed passed = traceAlphaNone();
  uint flags = mode == RL_RAY_SHADOW ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
  bool asksBodies = RL_HAS(RL_FEATURE_VOLUME) && gScene.bodiesMeet != 0u && mode != RL_RAY_PATH;
  if (asksBodies) {
    flags |= gl_RayFlagsNoOpaqueEXT;
  } else if (!RL_HAS(RL_FEATURE_ALPHA)) {
    flags |= gl_RayFlagsOpaqueEXT;
  }
  rayQueryEXT query;
  rayQueryInitializeEXT(query, accelerationStructureEXT(gScene.accelerationStructure), flags, 0xffu,
                        ray.origin, ray.tMin, ray.dir, ray.tMax);
  while (rayQueryProceedEXT(query)) {
    if (RL_HAS(RL_FEATURE_ALPHA | RL_FEATURE_VOLUME)) {
      Hit cand;
      cand.instance = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
      cand.primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
      cand.bary = rayQueryGetIntersectionBarycentricsEXT(query, false);
      cand.t = rayQueryGetIntersectionTEXT(query, false);
      if (asksBodies && mode == RL_RAY_BODIES) {
        if (traceIsNextBody(hit, cand, key)) hit = cand;
        continue;
      }
      if (asksBodies && mediaPasses(key, cand)) continue;
      float alpha = 1.0f;
      if (RL_HAS(RL_FEATURE_ALPHA)) alpha = surfaceAlpha(cand);
      bool accepts = alpha >= 1.0f;
      if (!accepts && mode == RL_RAY_PATH) accepts = traceAlphaAccepts(key, cand, alpha);
      if (accepts) {
        rayQueryConfirmIntersectionEXT(query);
      } else {
        traceAlphaPass(passed, cand, alpha);
      }
    }
  }
  if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT)
    return passed.transmittance;
  if (mode == RL_RAY_SHADOW) return 0.0f;
  if (mode == RL_RAY_BODIES) return passed.transmittance;
  hit.instance = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true));
  hit.primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
  hit.bary = rayQueryGetIntersectionBarycentricsEXT(query, true);
  hit.t = rayQueryGetIntersectionTEXT(query, true);
  return passed.transmittance;
}
