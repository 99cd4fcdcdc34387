// Media: list of the bodies that a point lies in, the greatest rank first. A body is an instance
// whose material lets light in (core/scene/compiled/bodies.h ranks bodies; no two ranks are equal).
// If bodies overlap, the one with the greatest rank fills the space, and a surface exists only
// where that body changes (Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images",
// 2002).
//
// A list holds four bodies; of more, those of the least rank are dropped. Thin sheets and opaque
// surfaces do not change the list. Two bodies of the same medium have a surface where one ends: the
// surface may have a colour or an emission of its own, and shadow rays stop there.

RL_FN uvec4 mediaNone() { return uvec4(0u, 0u, 0u, 0u); }

// Extinction (m^-1) and index of refraction of the body of a rank; 0: air.
RL_FN vec4 mediaOfRank(uint rank) {
  if (rank == 0u) return vec4(0.0f, 0.0f, 0.0f, 1.0f);
  return recordVec4(RL_SCENE_UVEC4(gScene.bodies, 2u * rank));
}
// Its scattering (m^-1), and the mean cosine of the angles that it scatters by.
RL_FN vec4 mediaScattering(uint rank) {
  if (rank == 0u) return vec4(0.0f, 0.0f, 0.0f, 0.0f);
  return recordVec4(RL_SCENE_UVEC4(gScene.bodies, 2u * rank + 1u));
}

RL_FN bool mediaContains(RL_IN(uvec4) media, uint rank) {
  return media.x == rank || media.y == rank || media.z == rank || media.w == rank;
}

RL_FN uvec4 mediaEnter(RL_IN(uvec4) media, uint rank) {
  if (rank >= media.x) return uvec4(rank, media.x, media.y, media.z);
  if (rank >= media.y) return uvec4(media.x, rank, media.y, media.z);
  if (rank >= media.z) return uvec4(media.x, media.y, rank, media.z);
  return uvec4(media.x, media.y, media.z, max(media.w, rank));
}

// Removes one entry of a rank, if there is one.
RL_FN uvec4 mediaLeave(RL_IN(uvec4) media, uint rank) {
  if (media.x == rank) return uvec4(media.y, media.z, media.w, 0u);
  if (media.y == rank) return uvec4(media.x, media.z, media.w, 0u);
  if (media.z == rank) return uvec4(media.x, media.y, media.w, 0u);
  if (media.w == rank) return uvec4(media.x, media.y, media.z, 0u);
  return media;
}

// Returns for a hit: x: cosine between the ray back and the surface's outside, above 0 from
// outside; y: error bound of the position, metres.
RL_FN vec2 mediaFacing(RL_IN(Hit) hit, RL_IN(vec3) dirW) {
  Instance inst = recordInstance(hit.instance);
  Geometry geometry = recordGeometry(inst.geometry);
  if (RL_HAS_SHAPES && shapeIs(geometry)) {
    SurfaceId id;
    id.instance = hit.instance;
    id.primitive = hit.primitive;
    id.bary = hit.bary;
    ShapePointW shape = shapePointW(inst, geometry, id);
    return vec2(-dot(shape.normalW, dirW), RL_HIT_ERROR * shape.tangents.magnitude);
  }
  uvec3 corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + hit.primitive);
  TriangleW t = surfaceTriangle(inst, geometry, corners);
  vec3 area = cross(t.e1, t.e2);
  float cosine = -dot(area, dirW) * rlSafeDivide(1.0f, sqrt(dot(area, area)));
  if ((inst.flags & RL_INSTANCE_FLIPPED) != 0u) cosine = -cosine;
  return vec2(cosine, RL_HIT_ERROR * t.magnitude);
}

// Media list behind a body's surface.
RL_FN uvec4 mediaBehind(RL_IN(uvec4) media, uint rank, bool isFront) {
  if (isFront) return mediaEnter(media, rank);
  return mediaLeave(media, rank);
}

// Interval around a hit in which surfaces of other bodies count as being at the same place. facing:
// mediaFacing() of the hit.
RL_FN Ray mediaProbe(RL_IN(Ray) ray, RL_IN(Hit) hit, RL_IN(vec2) facing) {
  float reach = 2.0f * facing.y / max(abs(facing.x), 1.0f / 64.0f);
  Ray probe = ray;
  probe.tMin = max(hit.t - reach, 0.0f);
  probe.tMax = hit.t + reach;
  return probe;
}

RL_FN uint mediaRank(RL_IN(Hit) hit) {
  return recordInstance(hit.instance).flags >> RL_INSTANCE_RANK_SHIFT;
}

// Finds the media on both sides of a path ray's hit, before the surface is loaded. Touching bodies
// are crossed together, so that there is no air between them; `hit` becomes the hit of the body
// with the greatest rank, whichever body the ray met first.
RL_FN MediaCrossing mediaCross(RL_IN(uvec4) media, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  MediaCrossing c;
  c.behind = media;
  c.contrast = 0.0f;
  c.isSurface = 1u;
  c.isTouching = 0u;
  uint rank = mediaRank(hit);
  if (rank == 0u) return c;
  vec2 facing = mediaFacing(hit, ray.dir);
  bool isFront = facing.x > 0.0f;
  c.behind = mediaBehind(media, rank, isFront);
  // A body that is left but was never entered (open mesh): assume that the path was inside it.
  uint here = media.x;
  if (!isFront && !mediaContains(media, rank)) here = max(here, rank);
  if (gScene.bodiesMeet != 0u) {
    uint first = hit.instance;
    Ray probe = mediaProbe(ray, hit, facing);
    uint key = first + 1u;
    for (uint i = 0u; i < RL_MEDIA_TOUCHING; i = i + 1u) {
      Hit other = traceNoHit();
      traceRay(probe, RL_RAY_BODIES, key, other);
      if (other.instance == RL_INVALID || other.instance == first) break;
      key = other.instance + 1u;
      c.isTouching = 1u;
      uint otherRank = mediaRank(other);
      bool isOtherFront = mediaFacing(other, ray.dir).x > 0.0f;
      c.behind = mediaBehind(c.behind, otherRank, isOtherFront);
      if (otherRank > rank) {
        rank = otherRank;
        isFront = isOtherFront;
        other.t = hit.t;
        hit = other;
      }
    }
  }
  c.isSurface = rank >= here ? 1u : 0u;  // same rule as mediaPasses() for shadow rays
  uint outside = isFront ? here : c.behind.x;
  if (outside != 0u) {
    float iorHere = mediaOfRank(here).w;
    float iorBehind = mediaOfRank(c.behind.x).w;
    c.contrast = isFront ? iorBehind / iorHere : iorHere / iorBehind;
  }
  return c;
}

// Returns whether a shadow ray in the body of rank `rank` passes this hit: bodies of lower rank
// have no surface in that body. The ray ends where the body ends.
RL_FN bool mediaPasses(uint rank, RL_IN(Hit) hit) {
  if (rank == 0u) return false;
  uint other = mediaRank(hit);
  return other != 0u && other < rank;
}

// A direction that light from `dirW` is scattered to, with the density of the phase function of
// Henyey and Greenstein (1941). g: mean cosine, -1 to 1.
RL_FN vec3 mediaPhaseDraw(RL_IN(vec3) dirW, float g, RL_IN(vec2) u) {
  float cosTheta = 1.0f - 2.0f * u.x;
  if (abs(g) > 1.0e-3f) {
    float ratio = (1.0f - g * g) / (1.0f + g - 2.0f * g * u.x);
    cosTheta = clamp((1.0f + g * g - ratio * ratio) / (2.0f * g), -1.0f, 1.0f);
  }
  float sinTheta = sqrt(1.0f - cosTheta * cosTheta);
  vec2 cs = rlCosSin2Pi(u.y);
  return frameToWorld(dirW, vec3(sinTheta * cs.x, sinTheta * cs.y, cosTheta));
}
