// Shifts of samples between anchors. Included once per payload type with RL_RESERVOIR (a struct
// with a ReservoirState `state`) and RL_ANCHOR (where a sample is evaluated) defined. The bridge,
// per payload:
// - bridgeShift(reservoir, from, to, J): integrand of the shifted sample at `to` without
// visibility;
//   zero where the shift is undefined, by a predicate that is the same in both directions;
// - bridgeVisibility(reservoir, at): transmittance between a sample and an anchor;
// and for all of them bridgeTarget(F), the scalar target.

// The sample of a reservoir that lives at `from`, as `to` sees it.
RL_FN Shifted reuseShift(RL_IN(RL_RESERVOIR) r, RL_IN(RL_ANCHOR) from, RL_IN(RL_ANCHOR) to,
                         bool assumeVisible) {
  Shifted s;
  s.F = real3(real(0.0f));
  s.jacobian = real(1.0f);
  if (!(r.state.W > real(0.0f))) return s;
  real jacobian = real(1.0f);
  s.F = bridgeShift(r, from, to, jacobian);
  s.jacobian = jacobian;
  if (!assumeVisible && bridgeTarget(s.F) > real(0.0f)) s.F *= bridgeVisibility(r, to);
  return s;
}
