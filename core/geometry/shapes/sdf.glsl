// A solid made of others: the program of its signed distance (core/scene/field/solid.h), for which
// rays and points are those of any function (implicit.glsl).

RL_FN bool sdfIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  return fieldIntersect(shape, ray, hit);
}

RL_FN ShapePoint sdfPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) { return fieldPoint(shape, id); }

RL_FN SurfaceId sdfDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  return surfaceIdNone();
}

RL_FN float sdfDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 0.0f;
}
