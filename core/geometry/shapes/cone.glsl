// The cone about z from a circle of radius 1 at z = 0 to its tip at z = 1. Parameter: x is 1 with a
// base, 0 without. An id holds the side (primitive 0: turn around z, height) or the base (1: x, y).
// Textures: u runs around z from x to y, v down; on the base as on a disk.

RL_FN float coneBase(RL_IN(Shape) shape) {
  return uintBitsToFloat(RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord).x);
}

RL_FN bool coneIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  bool found = false;
  float nearest = ray.tMax;
  // x^2 + y^2 = (1 - z)^2 with the tip as origin, from the point of the ray closest to the tip.
  float dir2 = dot(ray.dir, ray.dir);
  vec3 fromTip = ray.origin - vec3(0.0f, 0.0f, 1.0f);
  float middle = -dot(fromTip, ray.dir) / dir2;
  vec3 o = fromTip + ray.dir * middle;
  float a = ray.dir.x * ray.dir.x + ray.dir.y * ray.dir.y - ray.dir.z * ray.dir.z;
  float b = o.x * ray.dir.x + o.y * ray.dir.y - o.z * ray.dir.z;
  float c = o.x * o.x + o.y * o.y - o.z * o.z;
  float root = b * b - a * c;
  if (root >= 0.0f) {
    float q = -(b + (b < 0.0f ? -sqrt(root) : sqrt(root)));
    for (uint i = 0u; i < 2u; i = i + 1u) {
      float s = i == 0u ? q / a : c / q;
      float t = middle + s;
      vec3 at = o + ray.dir * s;
      if (!(t > ray.tMin) || !(t < nearest) || !(at.z <= 0.0f) || !(at.z >= -1.0f - RL_SHAPE_RIM))
        continue;
      nearest = t;
      hit.primitive = 0u;
      hit.bary = vec2(shapeDiamond(vec2(at.x, at.y)), max(at.z + 1.0f, 0.0f));
      found = true;
    }
  }
  if (coneBase(shape) > 0.0f) {
    float t = -ray.origin.z / ray.dir.z;
    vec2 at = vec2(ray.origin.x + t * ray.dir.x, ray.origin.y + t * ray.dir.y);
    if (t > ray.tMin && t < nearest && dot(at, at) <= 1.0f) {
      nearest = t;
      hit.primitive = 1u;
      hit.bary = at * 0.5f + vec2(0.5f, 0.5f);
      found = true;
    }
  }
  if (found) hit.t = nearest;
  return found;
}

RL_FN ShapePoint conePoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  if (id.primitive != 0u) {
    ShapePoint base = diskPoint(shape, id);
    base.normalL = vec3(0.0f, 0.0f, -1.0f);
    base.extent = vec3(1.0f, 1.0f, 1.0f);
    return base;
  }
  vec2 at = shapeFromDiamond(id.bary.x);
  float r = 1.0f - id.bary.y;
  ShapePoint p =
      shapePointOn(vec3(at.x * r, at.y * r, id.bary.y), vec3(at.x, at.y, 1.0f) * 0.70710678f);
  p.dpdu = vec3(-at.y, at.x, 0.0f);
  p.dpdv = vec3(at.x, at.y, -1.0f);
  p.uv = vec2(shapeTurn(at), r);
  return p;
}

// Probability that shapeDraw() takes the side: its share of the area.
RL_FN float coneSide(RL_IN(Shape) shape) {
  return coneBase(shape) > 0.0f ? 0.58578644f : 1.0f;  // sqrt(2) / (sqrt(2) + 1)
}

RL_FN SurfaceId coneDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  float side = coneSide(shape);
  if (u.x < side) {
    id.primitive = 0u;
    id.bary = vec2(shapeDiamond(rlCosSin2Pi(u.y)), 1.0f - sqrt(min(u.x / side, 1.0f)));
    return id;
  }
  id = diskAnywhere(vec2((u.x - side) / (1.0f - side), u.y));
  id.primitive = 1u;
  return id;
}

RL_FN float coneDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return coneSide(shape) / (RL_PI * 1.41421356f);
}
