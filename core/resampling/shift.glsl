// Shift maps.

// The geometry term of a vertex x_k seen from a point, without the cosine there: |cos| / d^2 with
// the geometric normal at x_k; 0 where they coincide. The solid-angle Jacobian of a reconnection at
// x_k is the destination's over the source's (GRIS eq. 52).
RL_FN real shiftGeometryTerm(RL_IN(real3) xk, RL_IN(real3) normalK, RL_IN(real3) from) {
  real3 d = from - xk;
  real d2 = dot(d, d);
  return d2 > real(0.0f) ? abs(dot(d, normalK)) / (d2 * sqrt(d2)) : real(0.0f);
}

// Reconnection at x_k from a source vertex x_{k-1} to a destination y_{k-1}: the solid-angle
// Jacobian (GRIS eq. 52), with the geometric normal at x_k. It multiplies the resampling weight.
RL_FN real shiftReconnectionJacobian(RL_IN(real3) xk, RL_IN(real3) normalK, RL_IN(real3) source,
                                     RL_IN(real3) destination) {
  real3 toSource = source - xk;
  real3 toDestination = destination - xk;
  real d2Source = dot(toSource, toSource);
  real d2Destination = dot(toDestination, toDestination);
  real cosSource = abs(dot(toSource, normalK));
  real cosDestination = abs(dot(toDestination, normalK));
  if (!(cosSource > real(0.0f)) || !(d2Destination > real(0.0f))) return real(0.0f);
  // |cos| / d^2 with unnormalised directions: |d.n| / |d|^3.
  real ratio = d2Source / d2Destination;
  return cosDestination / cosSource * ratio * sqrt(ratio);
}
