// The surface on which a function of the place is 0, cut off at a box; the outside is where it is
// above. An id: core/geometry/field/point.glsl. No light samples.
// Textures: u runs around z through the middle of the box from x to y, v from +z down.

RL_FN bool implicitIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  return fieldIntersect(shape, ray, hit);
}

RL_FN ShapePoint implicitPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  return fieldPoint(shape, id);
}

RL_FN SurfaceId implicitDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  return surfaceIdNone();
}

RL_FN float implicitDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 0.0f;
}
