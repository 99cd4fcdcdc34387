// The pass core/reuse/initial.glsl over paths (candidate.glsl).
#include "integrators/restir_gi/candidate.glsl"
#include "core/reuse/initial.glsl"
