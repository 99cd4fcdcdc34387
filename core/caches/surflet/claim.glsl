#include "core/caches/surflet/disc.glsl"
#include "core/caches/entries/claim.glsl"
