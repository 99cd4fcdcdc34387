// The pass core/reuse/temporal.glsl over paths (sample.glsl).
#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/temporal.glsl"
