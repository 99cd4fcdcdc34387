// The sample of restir_pt: a film sample, the random numbers of a prefix, and a path that
// reconnects behind it, or none.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/replay_sample.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/caches/entries/entries.glsl"

// Storage: the reservoir of an index.
RL_FN PathReservoir sampleRead(RL_IN(Uvec4Ref) words, uint index) {
  return replayReservoirRead(words, index * RL_PATH_RESERVOIR_UVEC4S);
}
RL_FN void sampleWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  replayReservoirWrite(words, index * RL_PATH_RESERVOIR_UVEC4S, r);
}
RL_FN ReservoirState sampleStateRead(RL_IN(Uvec4Ref) words, uint index) {
  return replayStateRead(words, index * RL_PATH_RESERVOIR_UVEC4S);
}
RL_FN void sampleStateWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  replayStateWrite(words, index * RL_PATH_RESERVOIR_UVEC4S, r);
}

// Copies the path of `from`. The merge has set the state (F, W, residual, confidence) of r already.
RL_FN void sampleCopyPath(RL_INOUT(PathReservoir) r, RL_IN(PathReservoir) from) {
  r.path = from.path;
}
// Updates the geometry term of the reconnection, so that the next shift can form its Jacobian.
RL_FN void sampleAfterShift(RL_INOUT(PathReservoir) r, float jacobian) {
  r.path.geometry *= jacobian;
}
RL_FN uint sampleFilm(RL_IN(PathReservoir) r) { return r.path.film; }
RL_FN void sampleSetFilm(RL_INOUT(PathReservoir) r, uint film) { r.path.film = film; }
