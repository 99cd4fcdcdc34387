// Shift maps.

// The geometry term of a vertex x_k seen from a point, without the cosine there: |cos| / d^2 with
// the geometric normal at x_k; 0 where they coincide. The solid-angle Jacobian of a reconnection at
// x_k is the destination's over the source's (GRIS eq. 52).
RL_FN real shiftGeometryTerm(RL_IN(real3) xk, RL_IN(real3) normalK, RL_IN(real3) from) {
  real3 d = from - xk;
  real d2 = dot(d, d);
  return d2 > real(0.0f) ? abs(dot(d, normalK)) / (d2 * sqrt(d2)) : real(0.0f);
}
