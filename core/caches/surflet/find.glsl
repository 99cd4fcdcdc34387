#include "core/caches/surflet/disc.glsl"
#include "core/caches/entries/find.glsl"
