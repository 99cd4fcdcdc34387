// The pass core/reuse/initial.glsl over all paths of a pixel (candidate.glsl).
#include "integrators/restir_pt/candidate.glsl"
#include "core/reuse/initial.glsl"
