// The sample of restir_gi: a film sample, and a path that reconnects at x2 or at its light. The
// passes of core/reuse ask for these functions, and the initial pass for those of candidate.glsl.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/path_words.glsl"
#include "core/path_sample/sample.glsl"
#include "core/path_sample/path_shift.glsl"
#include "core/path_sample/sample_shift.glsl"
