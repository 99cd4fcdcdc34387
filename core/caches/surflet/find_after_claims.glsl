#include "core/caches/surflet/disc.glsl"
#include "core/caches/entries/find_after_claims.glsl"
