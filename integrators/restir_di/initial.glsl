// The pass core/reuse/initial.glsl over direct light (candidate.glsl).
#include "integrators/restir_di/candidate.glsl"
#include "core/reuse/initial.glsl"
