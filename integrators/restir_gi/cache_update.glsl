// The pass core/reuse/cache_update.glsl over paths (sample.glsl).
#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/cache_update.glsl"
