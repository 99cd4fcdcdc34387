#include "integrators/restir_gi/candidate.glsl"
#include "core/reuse/initial.glsl"
