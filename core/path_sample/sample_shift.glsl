// Shifts of path samples, as the passes of core/reuse ask for them.

// Shifts, step by step, so that a kernel has one call of traceRay().
RL_FN PathShift shiftNone() { return pathShiftNone(); }
RL_FN PathShift shiftTo(RL_IN(PathReservoir) r, RL_IN(uvec2) pixel, bool isPrevious,
                        bool assumeVisible) {
  return pathShiftTo(r, pixel, isPrevious, assumeVisible);
}
RL_FN PathShift shiftToSurface(RL_IN(PathReservoir) r, RL_IN(Surface) x1) {
  return pathShiftToSurface(r, x1);
}
RL_FN void shiftTrace(RL_INOUT(PathShift) s, RL_IN(PathReservoir) r) { pathShiftTrace(s, r.path); }
RL_FN uint shiftRayKey(uint mode, uint film) { return pathShiftKey(mode, film); }
// Returns whether samples can be reused at a surface of this frame.
RL_FN bool shiftIsReusable(RL_IN(Bsdf) bsdf) { return pathIsReusable(bsdf); }
