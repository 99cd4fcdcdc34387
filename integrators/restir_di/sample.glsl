// The sample of restir_di: a film sample, and a point of a light. The shift keeps both, and x1 is
// traced anew: in the measure of the light its Jacobian is 1.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/direct_words.glsl"
#include "core/path_sample/sample.glsl"
#include "core/path_sample/path_shift.glsl"
#include "core/path_sample/sample_shift.glsl"

// With an unshadowed target, traces the sample that is shown. Nothing else is shown then, so that
// the reservoir has no residual.
RL_FN void sampleShade(RL_IN(uvec2) pixel, RL_INOUT(PathReservoir) r, RL_INOUT(vec3) estimate) {
  if (!pathHasUnshadowedTarget()) return;
  PathShift s = pathShiftTo(r, pixel, false, false);
  s.assumesVisible = 0u;
  pathShiftTrace(s, r.path);
  estimate = s.shifted.F * r.state.W;
  r.state.residual = vec3(0.0f, 0.0f, 0.0f);
}
