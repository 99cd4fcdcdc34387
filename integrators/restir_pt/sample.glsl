// The sample of restir_pt: a film sample, the random numbers of a prefix, and a path that
// reconnects behind it, or none.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/replay_words.glsl"
#include "core/path_sample/sample.glsl"
