// Functions of a path sample that the passes of core/reuse ask for. The words of a reservoir are in
// path_words.glsl, direct_words.glsl and replay_words.glsl, of which a method includes one before.
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/caches/entries/entries.glsl"

// Copies the path of `from`. The merge has set the state (F, W, residual, confidence) of r already.
RL_FN void sampleCopyPath(RL_INOUT(PathReservoir) r, RL_IN(PathReservoir) from) {
  r.path = from.path;
}
// Updates the geometry term of the reconnection (0 of light samples), so that the next shift can
// form its Jacobian. `jacobian` is that of the shift that brought the path here.
RL_FN void sampleAfterShift(RL_INOUT(PathReservoir) r, float jacobian) {
  r.path.geometry *= jacobian;
}
RL_FN uint sampleFilm(RL_IN(PathReservoir) r) { return r.path.film; }
RL_FN void sampleSetFilm(RL_INOUT(PathReservoir) r, uint film) { r.path.film = film; }
