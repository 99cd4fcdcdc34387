#include "core/caches/surflet/disc.glsl"
#include "core/caches/entries/resolve_claims.glsl"
