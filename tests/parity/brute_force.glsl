// traceRay() for the parity tests: every triangle of every instance, in order. No acceleration
// structure: the tests compare kernels, not traversals.

RL_FN bool bruteTriangle(RL_IN(Ray) ray, RL_IN(TriangleW) t, float tMax, RL_INOUT(Hit) hit) {
  vec3 p = cross(ray.dir, t.e2);
  float det = dot(t.e1, p);
  if (det == 0.0f) return false;
  float inverse = 1.0f / det;
  vec3 s = ray.origin - t.p0;
  float u = dot(s, p) * inverse;
  vec3 q = cross(s, t.e1);
  float v = dot(ray.dir, q) * inverse;
  float distance = dot(t.e2, q) * inverse;
  if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f && distance > ray.tMin && distance < tMax))
    return false;
  hit.bary = vec2(u, v);
  hit.t = distance;
  return true;
}

RL_FN float traceRay(RL_IN(Ray) ray, uint mode, uint alphaKey, RL_OUT(Hit) hit) {
  hit.instance = RL_INVALID;
  hit.primitive = RL_INVALID;
  hit.bary = vec2(0.0f, 0.0f);
  hit.t = 0.0f;
  float transmittance = 1.0f;
  float nearest = ray.tMax;
  for (uint i = 0u; i < gScene.instanceCount; i = i + 1u) {
    Instance inst = recordInstance(i);
    Geometry geometry = recordGeometry(inst.geometry);
    for (uint k = 0u; k < geometry.triangleCount; k = k + 1u) {
      TriangleW t = surfaceTriangle(inst, geometry,
                                    RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + k));
      Hit cand = hit;
      if (!bruteTriangle(ray, t, nearest, cand)) continue;
      cand.instance = i;
      cand.primitive = k;
      float alpha = 1.0f;
      if (RL_HAS(RL_FEATURE_ALPHA)) alpha = surfaceAlpha(cand);
      if (mode == RL_RAY_SHADOW) {
        transmittance *= 1.0f - alpha;
        if (transmittance == 0.0f) return 0.0f;
      } else if (!RL_HAS(RL_FEATURE_ALPHA) || traceAlphaAccepts(alphaKey, cand, alpha)) {
        hit = cand;
        nearest = cand.t;
      } else {
        transmittance *= 1.0f - alpha;
      }
    }
  }
  return transmittance;
}
