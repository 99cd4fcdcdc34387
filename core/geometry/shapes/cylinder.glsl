// The cylinder of radius 1 about z, from z = 0 to z = 1. Parameter: x is 1 with ends, 0 without.
// An id holds the side (primitive 0: turn around z, height) or an end (1: z = 0, 2: z = 1; x, y).
// Textures: u runs around z from x to y, v along z; on the ends as on a disk.

RL_FN float cylinderEnds(RL_IN(Shape) shape) {
  return uintBitsToFloat(RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord).x);
}

RL_FN bool cylinderIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  bool found = false;
  float nearest = ray.tMax;
  float dir2 = ray.dir.x * ray.dir.x + ray.dir.y * ray.dir.y;
  float middle = -(ray.origin.x * ray.dir.x + ray.origin.y * ray.dir.y) / dir2;
  vec2 closest = vec2(ray.origin.x + ray.dir.x * middle, ray.origin.y + ray.dir.y * middle);
  float left = 1.0f - dot(closest, closest);
  if (dir2 > 0.0f && left >= 0.0f) {
    float reach = sqrt(left / dir2);
    for (uint i = 0u; i < 2u; i = i + 1u) {
      float t = i == 0u ? middle - reach : middle + reach;
      float z = ray.origin.z + t * ray.dir.z;
      if (!(t > ray.tMin) || !(t < nearest) || !(z >= -RL_SHAPE_RIM) || !(z <= 1.0f + RL_SHAPE_RIM))
        continue;
      float along = i == 0u ? -reach : reach;
      vec2 at = vec2(closest.x + ray.dir.x * along, closest.y + ray.dir.y * along);
      nearest = t;
      hit.primitive = 0u;
      hit.bary = vec2(shapeDiamond(at), clamp(z, 0.0f, 1.0f));
      found = true;
    }
  }
  if (cylinderEnds(shape) > 0.0f) {
    for (uint end = 1u; end <= 2u; end = end + 1u) {
      float t = ((end == 1u ? 0.0f : 1.0f) - ray.origin.z) / ray.dir.z;
      vec2 at = vec2(ray.origin.x + t * ray.dir.x, ray.origin.y + t * ray.dir.y);
      if (!(t > ray.tMin) || !(t < nearest) || !(dot(at, at) <= 1.0f)) continue;
      nearest = t;
      hit.primitive = end;
      hit.bary = at * 0.5f + vec2(0.5f, 0.5f);
      found = true;
    }
  }
  if (found) hit.t = nearest;
  return found;
}

RL_FN ShapePoint cylinderPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  if (id.primitive != 0u) {
    ShapePoint end = diskPoint(shape, id);
    if (id.primitive == 1u) {
      end.normalL = vec3(0.0f, 0.0f, -1.0f);
    } else {
      end.posL.z = 1.0f;
    }
    end.extent = vec3(1.0f, 1.0f, 1.0f);
    return end;
  }
  vec2 at = shapeFromDiamond(id.bary.x);
  ShapePoint p = shapePointOn(vec3(at.x, at.y, id.bary.y), vec3(at.x, at.y, 0.0f));
  p.dpdu = vec3(-at.y, at.x, 0.0f);
  p.dpdv = vec3(0.0f, 0.0f, 1.0f);
  p.uv = vec2(shapeTurn(at), id.bary.y);
  return p;
}

// Probability that shapeDraw() takes the side: its share of the area.
RL_FN float cylinderSide(RL_IN(Shape) shape) { return cylinderEnds(shape) > 0.0f ? 0.5f : 1.0f; }

RL_FN SurfaceId cylinderDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  float side = cylinderSide(shape);
  if (u.x < side) {
    id.primitive = 0u;
    id.bary = vec2(shapeDiamond(rlCosSin2Pi(u.y)), min(u.x / side, 1.0f));
    return id;
  }
  float rest = (u.x - side) / (1.0f - side) * 2.0f;
  id = diskAnywhere(vec2(rest < 1.0f ? rest : rest - 1.0f, u.y));
  id.primitive = rest < 1.0f ? 1u : 2u;
  return id;
}

RL_FN float cylinderDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return cylinderSide(shape) / (2.0f * RL_PI);
}
