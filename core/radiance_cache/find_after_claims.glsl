#include "core/radiance_cache/cell.glsl"
#include "core/caches/entries/find_after_claims.glsl"
