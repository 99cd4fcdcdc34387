#include "core/radiance_cache/cell.glsl"
#include "core/caches/entries/claim.glsl"
