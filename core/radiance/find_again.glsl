#include "core/radiance/cell.glsl"
#include "core/caches/entries/find_again.glsl"
