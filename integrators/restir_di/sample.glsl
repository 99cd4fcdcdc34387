// The sample of restir_di: a film sample, and a point of a light. The shift keeps both, and x1 is
// traced anew: in the measure of the light its Jacobian is 1.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/path_shift.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/caches/entries/entries.glsl"

// Storage: the reservoir of an index.
RL_FN PathReservoir sampleRead(RL_IN(Uvec4Ref) words, uint index) {
  return directReservoirRead(words, index * RL_DIRECT_RESERVOIR_UVEC4S);
}
RL_FN void sampleWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  directReservoirWrite(words, index * RL_DIRECT_RESERVOIR_UVEC4S, r);
}
RL_FN ReservoirState sampleStateRead(RL_IN(Uvec4Ref) words, uint index) {
  return directStateRead(words, index * RL_DIRECT_RESERVOIR_UVEC4S);
}
RL_FN void sampleStateWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  directReservoirWrite(words, index * RL_DIRECT_RESERVOIR_UVEC4S, r);
}

// Copies the path of `from`. The merge has set the state (F, W, residual, confidence) of r already.
RL_FN void sampleCopyPath(RL_INOUT(PathReservoir) r, RL_IN(PathReservoir) from) {
  r.path = from.path;
}
RL_FN void sampleAfterShift(RL_INOUT(PathReservoir) r, float jacobian) {}
RL_FN uint sampleFilm(RL_IN(PathReservoir) r) { return r.path.film; }
RL_FN void sampleSetFilm(RL_INOUT(PathReservoir) r, uint film) { r.path.film = film; }

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
