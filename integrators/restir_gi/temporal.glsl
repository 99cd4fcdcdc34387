#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/temporal.glsl"
