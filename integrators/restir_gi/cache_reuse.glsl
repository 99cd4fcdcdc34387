#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/cache_reuse.glsl"
