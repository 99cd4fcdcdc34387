// First hits that a raster pass found (core/raster/raster.h).

// Without the distance (hit.t).
RL_FN Hit firstHitRead(RL_IN(Uvec4Ref) hits, uint pixelIndex) {
  uvec4 q = RL_EARLIER_UVEC4(hits, pixelIndex);
  Hit hit = traceNoHit();
  hit.instance = q.x;
  hit.primitive = q.y;
  hit.bary = vec2(uintBitsToFloat(q.z), uintBitsToFloat(q.w));
  return hit;
}

RL_FN SurfacePoint firstHitPoint(RL_IN(Hit) hit) {
  SurfaceId id;
  id.instance = hit.instance;
  id.primitive = hit.primitive;
  id.bary = hit.bary;
  return surfacePointAt(id);
}

// Distance to the hit along the ray of the pixel, in metres; 0: the background.
RL_FN float firstHitDistance(RL_IN(Ray) ray, RL_IN(Hit) hit) {
  if (hit.instance == RL_INVALID) return 0.0f;
  return dot(firstHitPoint(hit).posW - ray.origin, ray.dir);
}
