// The shift of restir_pt: replays the prefix from another pixel, then reconnects (Lin et al. 2022).
#include "integrators/restir_pt/sample.glsl"
#include "core/path_sample/path_connect.glsl"
#include "core/path_sample/path_replay.glsl"
#include "core/path_sample/path_shift.glsl"
#include "core/path_sample/sample_shift.glsl"
