// The pass core/reuse/cache_update.glsl over paths (shift.glsl).
#include "integrators/restir_pt/shift.glsl"
#include "core/reuse/cache_update.glsl"
