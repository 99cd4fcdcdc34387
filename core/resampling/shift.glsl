// Shift maps.

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
