#include "core/caches/surflet/disc.glsl"
#include "core/caches/entries/find_again.glsl"
