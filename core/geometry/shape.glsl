// Shapes in world space. Instances of shapes always have a transform of their own.

RL_FN bool shapeIs(RL_IN(Geometry) geometry) {
  return RL_HAS_SHAPES && geometry.shape != RL_SHAPE_TRIANGLES;
}

RL_FN Shape shapeOf(RL_IN(Geometry) geometry) {
  Shape shape;
  shape.kind = geometry.shape;
  shape.firstWord = geometry.firstShapeWord;
  return shape;
}

RL_FN vec3 shapeToLocal(RL_IN(Instance) inst, RL_IN(vec3) posW) {
  vec4 h = vec4(posW, 1.0f);
  return vec3(dot(inst.worldToObjectRow0, h), dot(inst.worldToObjectRow1, h),
              dot(inst.worldToObjectRow2, h));
}

// Intersects a ray in world space with the shape of an instance, as shapeIntersect() does.
RL_FN_OUTLINE bool shapeTrace(RL_IN(Instance) inst, RL_IN(Geometry) geometry, RL_IN(Ray) ray,
                              RL_INOUT(Hit) hit) {
  vec4 d = vec4(ray.dir, 0.0f);
  Ray local;
  local.origin = shapeToLocal(inst, ray.origin);
  local.dir = vec3(dot(inst.worldToObjectRow0, d), dot(inst.worldToObjectRow1, d),
                   dot(inst.worldToObjectRow2, d));
  local.tMin = ray.tMin;
  local.tMax = ray.tMax;
  return shapeIntersect(shapeOf(geometry), local, hit);
}

RL_FN ShapePointW shapePointToWorld(RL_IN(Instance) inst, RL_IN(ShapePoint) p) {
  ShapePointW w;
  w.tangents.p0 = surfaceToWorldPoint(inst, p.posL);
  w.tangents.e1 = surfaceToWorldVector(inst, p.dpdu);
  w.tangents.e2 = surfaceToWorldVector(inst, p.dpdv);
  // |M| |p| + |T| bounds every intermediate of the transform.
  vec4 h = vec4(p.extent, 1.0f);
  w.tangents.magnitude =
      max(dot(abs(inst.objectToWorldRow0), h),
          max(dot(abs(inst.objectToWorldRow1), h), dot(abs(inst.objectToWorldRow2), h)));
  vec3 n = surfaceToWorldNormal(inst, p.normalL);
  w.normalW = normalize(n);
  w.uv = p.uv;
  vec3 a;
  vec3 b;
  frameFromNormal(p.normalL, a, b);
  vec3 area = cross(surfaceToWorldVector(inst, a), surfaceToWorldVector(inst, b));
  w.areaFactor = sqrt(dot(area, area));
  return w;
}

RL_FN_OUTLINE ShapePointW shapePointW(RL_IN(Instance) inst, RL_IN(Geometry) geometry,
                                      RL_IN(SurfaceId) id) {
  return shapePointToWorld(inst, shapePoint(shapeOf(geometry), id));
}

// Density per area, in world space, with which a light sample for a receiver finds a point of a
// shape that emits.
RL_FN_OUTLINE float shapeLightDensity(RL_IN(SurfaceId) id, RL_IN(vec3) receiverW) {
  Instance inst = recordInstance(id.instance);
  Shape shape = shapeOf(recordGeometry(inst.geometry));
  ShapePoint p = shapePoint(shape, id);
  float density = shapeDensity(shape, shapeToLocal(inst, receiverW), p);
  return rlSafeDivide(density, shapePointToWorld(inst, p).areaFactor);
}

// Draws a point of a shape that emits.
RL_FN_OUTLINE SurfaceId shapeLightDraw(uint instance, RL_IN(vec3) receiverW, RL_IN(vec2) u) {
  Instance inst = recordInstance(instance);
  Shape shape = shapeOf(recordGeometry(inst.geometry));
  SurfaceId id = shapeDraw(shape, shapeToLocal(inst, receiverW), u);
  id.instance = instance;
  return id;
}
