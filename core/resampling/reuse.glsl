// Shifts of samples between anchors. Included once per payload type with RL_RESERVOIR (a struct
// with a ReservoirState `state`) and RL_ANCHOR (where a sample is evaluated) defined. The bridge,
// per payload:
// - bridgeShift(reservoir, from, to, J): integrand of the shifted sample at `to` without
//   visibility; zero where the shift is undefined, by a predicate that is the same in both
//   directions;
// and for all of them bridgeTarget(F), the scalar target.

// The sample of a reservoir that lives at `from`, as `to` sees it, without visibility: where
// reuseAsksVisibility() says so, the caller multiplies F by the transmittance between the sample
// and `to`. The rays of several shifts can then be traced by one call.
RL_FN Shifted reuseShift(RL_IN(RL_RESERVOIR) r, RL_IN(RL_ANCHOR) from, RL_IN(RL_ANCHOR) to) {
  Shifted s;
  s.F = real3(real(0.0f));
  s.jacobian = real(1.0f);
  if (!(r.state.W > real(0.0f))) return s;
  real jacobian = real(1.0f);
  s.F = bridgeShift(r, from, to, jacobian);
  s.jacobian = jacobian;
  return s;
}
