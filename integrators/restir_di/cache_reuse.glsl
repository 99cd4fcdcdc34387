// The pass core/reuse/cache_reuse.glsl over points of lights (sample.glsl).
#include "integrators/restir_di/sample.glsl"
#include "core/reuse/cache_reuse.glsl"
