// The pass core/reuse/spatial.glsl over paths (sample.glsl).
#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/spatial.glsl"
