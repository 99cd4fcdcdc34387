#include "core/radiance/cell.glsl"
#include "core/caches/entries/settle.glsl"
