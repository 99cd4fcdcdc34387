#include "core/radiance_cache/cell.glsl"
#include "core/caches/entries/resolve_claims.glsl"
